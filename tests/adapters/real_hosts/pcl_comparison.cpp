// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// pcl_comparison SEQUENCE: PCL's normal estimation and k-d tree against nvm's classes in their
// place, on one scan of an nvm sequence: how long they take on one thread and how far they agree.
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "adapters/pcl/cloud.hpp"
#include "adapters/pcl/map_search.hpp"
#include "adapters/pcl/normal_estimation.hpp"
#include "nvm/map/view_direction.hpp"
#include "nvm_sequence.hpp"

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;
constexpr double kRadius = 0.3;  // [m]

/// The shortest of five runs [ms].
template <class Work>
double time_of(const Work& work) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> taken =
        std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count());
  }
  return best;
}

template <class Estimator>
double estimate(const Cloud::ConstPtr& cloud, Normals& normals) {
  return time_of([&] {
    Estimator estimator;
    estimator.setNumberOfThreads(1);
    estimator.setInputCloud(cloud);
    estimator.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    estimator.setRadiusSearch(kRadius);
    estimator.compute(normals);
  });
}

void compare_normals(const Cloud::ConstPtr& cloud) {
  Normals theirs, ours;
  const double their_ms =
      estimate<pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal>>(cloud, theirs);
  const double our_ms =
      estimate<nvm::adapters::NormalEstimation<pcl::PointXYZ, pcl::Normal>>(cloud, ours);
  std::size_t both = 0, one = 0, agree = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const float dot =
        nvm::adapters::normal_field(theirs[i]).dot(nvm::adapters::normal_field(ours[i]));
    const bool has_theirs = std::isfinite(theirs[i].normal_x);
    const bool has_ours = std::isfinite(ours[i].normal_x);
    both += has_theirs && has_ours ? 1U : 0U;
    one += has_theirs != has_ours ? 1U : 0U;
    agree += dot > 0.99985F ? 1U : 0U;  // 1 degree
  }
  std::printf(
      "normals of %zu points: PCL %.1f ms, nvm %.1f ms; %zu have both, %zu only one, %zu within 1 "
      "degree\n",
      cloud->size(),
      their_ms,
      our_ms,
      both,
      one,
      agree);
}

template <class Search>
void compare_search(
    const char* name,
    const Search& search,
    const nvm::adapters::MapSearch<pcl::PointXYZ>& ours,
    const pcl::search::KdTree<pcl::PointXYZ>& theirs,
    const Cloud& queries) {
  std::vector<std::vector<float>> our_answers(queries.size()), their_answers(queries.size());
  pcl::Indices indices;
  const double our_ms = time_of([&] {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      search(ours, queries[i], indices, our_answers[i]);
    }
  });
  const double their_ms = time_of([&] {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      search(theirs, queries[i], indices, their_answers[i]);
    }
  });
  std::size_t same = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    same += std::equal(
                our_answers[i].begin(),
                our_answers[i].end(),
                their_answers[i].begin(),
                their_answers[i].end(),
                [](float a, float b) { return std::abs(std::sqrt(a) - std::sqrt(b)) < 1e-4F; })
                ? 1U
                : 0U;
  }
  const double per_query = 1e3 / static_cast<double>(queries.size());
  std::printf(
      "%s: PCL %.2f us, nvm %.2f us per query; the same answer to %zu of %zu\n",
      name,
      their_ms * per_query,
      our_ms * per_query,
      same,
      queries.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: pcl_comparison SEQUENCE\n");
    return 2;
  }
  const std::vector<real_hosts::Scan> scans = real_hosts::read_scans(argv[1]);
  const auto cloud = pcl::make_shared<Cloud>();
  for (const real_hosts::Point& p : scans.at(scans.size() / 2).points) {
    cloud->push_back({p.x, p.y, p.z});
  }
  compare_normals(cloud);
  nvm::MapOptions options;
  options.min_point_distance = 0.05;
  nvm::VoxelMap map(options);
  map.insert(*cloud, nvm::view_directions(*cloud, Eigen::Vector3d(0, 0, 0)));
  const nvm::adapters::MapSearch<pcl::PointXYZ> ours(map);
  pcl::search::KdTree<pcl::PointXYZ> theirs;
  theirs.setInputCloud(ours.getInputCloud());
  std::printf("a map of %zu points:\n", map.size());
  const auto nearest = [](const auto& search, const auto& point, auto& indices, auto& distances) {
    search.nearestKSearch(point, 5, indices, distances);
  };
  const auto within = [](const auto& search, const auto& point, auto& indices, auto& distances) {
    search.radiusSearch(point, kRadius, indices, distances);
  };
  compare_search("5 nearest", nearest, ours, theirs, *cloud);
  compare_search("within 0.3 m", within, ours, theirs, *cloud);
}
