// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/core/target.hpp"
#include "nvm/map/operations/gated_nearest.hpp"
#include "nvm/map/operations/insertion.hpp"
#include "nvm/map/operations/point_block.hpp"

#ifdef NVM_CHOOSES_KERNELS
#undef NVM_MAP_STORAGE_LANES_HPP
#undef NVM_MAP_OPERATIONS_CANDIDATES_HPP
#undef NVM_MAP_OPERATIONS_ANSWER_HPP
#undef NVM_MAP_OPERATIONS_NEAREST_QUERY_HPP
#undef NVM_MAP_OPERATIONS_GATED_NEAREST_HPP
#undef NVM_MAP_OPERATIONS_ADMISSION_HPP
#undef NVM_MAP_OPERATIONS_POINT_MERGER_HPP
#undef NVM_MAP_OPERATIONS_INSERTION_HPP
// The order counts.
// clang-format off
#include "nvm/core/kernels_for_avx2.hpp"
#include "nvm/map/operations/gated_nearest.hpp"
#include "nvm/map/operations/insertion.hpp"
#include "nvm/core/kernels_for_unit.hpp"
// clang-format on
#endif
