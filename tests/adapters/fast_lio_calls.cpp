// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/fast_lio_calls.hpp"

#include <omp.h>

KD_TREE<PointType> ikdtree;  // constructed before main

namespace {

constexpr int kMatches = 5;
constexpr float kFilterSize = 0.2F;
int points_added = 0;
int points_deleted = 0;
PointVector featured_points;

bool initialize(const PointVector& scan_world) {
  if (ikdtree.Root_Node != nullptr) {
    return false;
  }
  if (scan_world.size() > 5) {
    ikdtree.set_downsample_param(kFilterSize);
    ikdtree.Build(scan_world);
  }
  return true;
}

void search(const PointVector& scan_world, vector<PointVector>& nearest_points) {
  const int size = static_cast<int>(scan_world.size());
#pragma omp parallel for num_threads(3)
  for (int i = 0; i < size; i++) {
    vector<float> sq_distances(kMatches);
    auto& points_near = nearest_points[static_cast<size_t>(i)];
    ikdtree.Nearest_Search(scan_world[static_cast<size_t>(i)], kMatches, points_near, sq_distances);
  }
}

}  // namespace

vector<PointVector> map_one_scan(
    const PointVector& scan_world, vector<BoxPointType>& boxes_to_delete) {
  vector<PointVector> nearest_points(scan_world.size());
  PointVector points_history;
  ikdtree.acquire_removed_points(points_history);
  if (!boxes_to_delete.empty()) {
    points_deleted = ikdtree.Delete_Point_Boxes(boxes_to_delete);
  }
  if (initialize(scan_world)) {
    return nearest_points;
  }
  const int valid = ikdtree.validnum();
  const int before = ikdtree.size();
  PointVector().swap(ikdtree.PCL_Storage);
  ikdtree.flatten(ikdtree.Root_Node, ikdtree.PCL_Storage, NOT_RECORD);
  featured_points.clear();
  featured_points = ikdtree.PCL_Storage;
  search(scan_world, nearest_points);
  PointVector to_add(scan_world.begin(), scan_world.begin() + 1);
  PointVector no_need_downsample(scan_world.begin() + 1, scan_world.begin() + 2);
  points_added = ikdtree.Add_Points(to_add, true);
  ikdtree.Add_Points(no_need_downsample, false);
  points_added += static_cast<int>(to_add.size() + no_need_downsample.size());
  return valid == before ? nearest_points : vector<PointVector>();
}
