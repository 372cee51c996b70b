// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

// A host that uses every name of ikd-Tree that FAST_LIO uses, in the forms in which it does:
// through the angle include, at global scope, under `using namespace std` and Eigen, from OpenMP.
#include <ikd-Tree/ikd_Tree.h>

#include <string>
#include <vector>

#include "adapters/host_point.hpp"

using namespace std;    // NOLINT: as the host does
using namespace Eigen;  // NOLINT

using PointType = nvm::test::HostPoint;
using PointVector = vector<PointType, Eigen::aligned_allocator<PointType>>;

extern KD_TREE<PointType> ikdtree;

/// What FAST_LIO does with its map in one scan; returns the nearest points of each point.
vector<PointVector> map_one_scan(
    const PointVector& scan_world, vector<BoxPointType>& boxes_to_delete);
