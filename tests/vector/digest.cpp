// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors

// Fills a map, asks it and writes it, and prints a hash of every bit of the results: the same for
// each set of vector instructions that this file is compiled for.
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include "nvm/geometry/pose.hpp"
#include "nvm/map/serialization.hpp"
#include "nvm/map/voxel_map.hpp"

namespace {

/// FNV-1a.
class Hash {
 public:
  template <class T>
  void add(const T& value) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      hash_ = (hash_ ^ bytes[i]) * 0x100000001b3ULL;
    }
  }
  void add(const Eigen::Vector3d& v) {
    for (const double coordinate : {v.x(), v.y(), v.z()}) {
      add(coordinate);
    }
  }
  unsigned long long value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

struct Scan {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;
};

float coordinate(std::mt19937_64& rng, int millimetres) {
  return static_cast<float>(static_cast<int>(rng() % (2 * millimetres)) - millimetres) * 1e-3F;
}

/// A room of 8 x 6 x 4 m with a thin wall in the middle, and noise of 2 cm.
Scan room_scan(std::mt19937_64& rng) {
  const std::array<float, 3> half{4.0F, 3.0F, 2.0F};
  Scan scan;
  for (int i = 0; i < 3000; ++i) {
    Eigen::Vector3f point;
    Eigen::Vector3f normal;
    for (int k = 0; k < 3; ++k) {
      point[k] = half[static_cast<std::size_t>(k)] * coordinate(rng, 1000);
      normal[k] = 0.2F * coordinate(rng, 1000);
    }
    const auto axis = static_cast<int>(rng() % 4);
    const float side = rng() % 2 == 0 ? 1.0F : -1.0F;
    const int normal_axis = axis % 3;
    point[normal_axis] =
        axis < 3 ? side * half[static_cast<std::size_t>(axis)] : side * 0.03F;  // 3: the thin wall
    point[normal_axis] += coordinate(rng, 20);
    normal[normal_axis] = axis < 3 ? -side : side;
    scan.points.push_back(point);
    const float sq_length =
        normal.x() * normal.x() + normal.y() * normal.y() + normal.z() * normal.z();
    scan.normals.push_back(normal / std::sqrt(sq_length));
  }
  return scan;
}

/// A quarter turn: neither the mathematical library nor the rounding of this file is tested.
nvm::Pose pose(int step) {
  nvm::Pose T = nvm::Pose::Identity();
  T.linear() << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  T.translation() = Eigen::Vector3d(31.7 + 0.1 * step, -12.3, 4.1 - 0.05 * step);
  return T;
}

unsigned long long map_hash() {
  std::mt19937_64 rng(1);
  nvm::MapOptions options;
  options.capacity = 3000;  // evicts
  nvm::VoxelMap map(options);
  Hash hash;
  nvm::VoxelMap::QueryContext context;
  std::array<nvm::Neighbor, 20> found;
  for (int step = 0; step < 20; ++step) {
    const Scan scan = room_scan(rng);
    map.insert(scan.points, scan.normals, pose(step));
    for (std::size_t i = 0; i < scan.points.size(); i += 3) {
      const Eigen::Vector3f& p = scan.points[i];
      const Eigen::Vector3f& n = scan.normals[i];
      const Eigen::Vector3d t = pose(step).translation();
      const Eigen::Vector3d point(t.x() - p.y(), t.y() + p.x(), t.z() + p.z());
      const Eigen::Vector3f normal(-n.y(), n.x(), n.z());
      for (const std::size_t wanted : {1, 5, 20}) {
        for (const nvm::Gate gate : {nvm::Gate::kSurfaces, nvm::Gate::kPoints}) {
          const std::size_t count =
              map.nearest(point, normal, {wanted, 1.0, gate}, found.data(), context);
          for (std::size_t k = 0; k < count; ++k) {
            hash.add(found[k].position);
            hash.add(found[k].sq_distance);
            hash.add(found[k].id);
          }
        }
      }
    }
  }
  for (const std::uint8_t byte : nvm::MapArchive::write(map)) {
    hash.add(byte);
  }
  return hash.value();
}

/// Whether this processor knows the instructions that this file is compiled for.
bool can_run() {
#if defined(__AVX512VL__)
  return __builtin_cpu_supports("avx512vl") != 0;
#elif defined(__AVX2__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return true;
#endif
}

}  // namespace

int main() {
  if (!can_run()) {
    std::printf("this processor cannot run it\n");
    return 77;
  }
  std::printf("%016llx\n", map_hash());
}
