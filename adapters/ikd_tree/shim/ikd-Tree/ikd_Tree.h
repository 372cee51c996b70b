// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#if __cplusplus < 201703L
#error \
    "nvm needs C++17: change -std=c++14 in the host's CMakeLists.txt; see docs/adapters/ikd_tree.md"
#endif

// Stands in for the header of the same name that FAST_LIO and its relatives include: put this
// folder's parent first among the include directories. docs/adapters/ikd_tree.md
#include "adapters/ikd_tree/ikd_tree.hpp"

using BoxPointType = nvm::adapters::IkdBox;

// The host names a kind of storage when it calls flatten(); the map has one.
enum delete_point_storage_set { NOT_RECORD, DELETE_POINTS_REC, MULTI_THREAD_REC };

template <class Point>
using KD_TREE = nvm::adapters::IkdTree<Point>;
