// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// From here on kernels (nvm/core/target.hpp) are compiled for what the translation unit is compiled
// for. Without a guard: it comes after each kernels_for_avx2.hpp.
#undef NVM_KERNEL_AVX
#undef NVM_KERNEL_AVX2
#undef NVM_KERNEL_FMA
#undef NVM_BEGIN_KERNELS
#undef NVM_END_KERNELS
#undef NVM_BEGIN_DETAIL_KERNELS
#undef NVM_END_DETAIL_KERNELS

#ifdef __AVX__
#define NVM_KERNEL_AVX
#endif
#ifdef __AVX2__
#define NVM_KERNEL_AVX2
#endif
#ifdef __FMA__
#define NVM_KERNEL_FMA
#endif

#define NVM_BEGIN_KERNELS \
  namespace nvm {         \
  inline namespace NVM_TARGET {
#define NVM_END_KERNELS \
  }                     \
  }
#define NVM_BEGIN_DETAIL_KERNELS \
  namespace nvm {                \
  namespace detail {             \
  inline namespace NVM_TARGET {
#define NVM_END_DETAIL_KERNELS \
  }                            \
  }                            \
  }
