// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// From here on kernels (nvm/core/target.hpp) are compiled for AVX2, into nvm::for_avx2_kernels,
// whose detail sees what nvm::detail has besides them. Without a guard: it comes before each second
// compilation. The map's do without fused multiply-add, which rounds otherwise: a map has the same
// bits whichever kernels made it.
#undef NVM_KERNEL_AVX
#undef NVM_KERNEL_AVX2
#undef NVM_KERNEL_FMA
#undef NVM_BEGIN_KERNELS
#undef NVM_END_KERNELS
#undef NVM_BEGIN_DETAIL_KERNELS
#undef NVM_END_DETAIL_KERNELS

#define NVM_KERNEL_AVX
#define NVM_KERNEL_AVX2

#ifdef __clang__
// One literal: _Pragma takes no two.
// clang-format off
#define NVM_BEGIN_AVX2 \
  _Pragma("clang attribute push(__attribute__((target(\"avx2,bmi,bmi2,popcnt\"))), apply_to=function)")
// clang-format on
#define NVM_END_AVX2 _Pragma("clang attribute pop")
#else
#define NVM_BEGIN_AVX2 _Pragma("GCC push_options") _Pragma("GCC target(\"avx2,bmi,bmi2,popcnt\")")
#define NVM_END_AVX2 _Pragma("GCC pop_options")
#endif

#define NVM_BEGIN_KERNELS       \
  namespace nvm {               \
  inline namespace NVM_TARGET { \
  namespace for_avx2_kernels {  \
  NVM_BEGIN_AVX2
#define NVM_END_KERNELS \
  NVM_END_AVX2          \
  }                     \
  }                     \
  }
#define NVM_BEGIN_DETAIL_KERNELS \
  namespace nvm {                \
  inline namespace NVM_TARGET {  \
  namespace for_avx2_kernels {   \
  namespace detail {             \
  using namespace nvm::detail;   \
  NVM_BEGIN_AVX2
#define NVM_END_DETAIL_KERNELS \
  NVM_END_AVX2                 \
  }                            \
  }                            \
  }                            \
  }
