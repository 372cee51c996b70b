// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include "nvm/core/target.hpp"
#include "nvm/normal/plane_solver.hpp"

#ifdef NVM_CHOOSES_KERNELS
#undef NVM_GEOMETRY_FLOAT_LANES_HPP
#undef NVM_GEOMETRY_MOMENTS_HPP
#undef NVM_GEOMETRY_SYMMETRIC_EIGEN_HPP
#undef NVM_NORMAL_QUERY_BLOCK_HPP
#undef NVM_NORMAL_LANE_SUMS_HPP
#undef NVM_NORMAL_TREE_ITEMS_HPP
#undef NVM_NORMAL_BLOCK_SEARCH_HPP
#undef NVM_NORMAL_PLANE_JUDGE_HPP
#undef NVM_NORMAL_PLANE_SOLVER_HPP
// The order counts.
// clang-format off
#include "nvm/core/kernels_for_avx2.hpp"
#include "nvm/normal/plane_solver.hpp"
#include "nvm/core/kernels_for_unit.hpp"
// clang-format on
#endif
