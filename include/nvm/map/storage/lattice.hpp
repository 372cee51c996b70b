// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "nvm/core/finite.hpp"
#include "nvm/core/target.hpp"
#include "nvm/geometry/coordinates.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

// Positions are kept on a lattice of 2^13 steps per voxel (37 um at 0.3 m), so that distances are
// exact integers: the same on every processor, whatever its vector width, and for any number of
// threads. Only the lowest 16 bits of a coordinate are stored: two points less than 4 voxels apart
// differ by the wrapped 16-bit difference, and no query looks farther. That makes eight points
// three 16-byte vectors, at any distance from the origin.
inline constexpr int kStepBits = 13;
inline constexpr int kStepsPerVoxel = 1 << kStepBits;

/// Voxel indices are floor(p / d) (Eq. 4) within [-2^20, 2^20).
inline constexpr std::int32_t kMaxVoxelIndex = 1 << 20;

/// One for each axis, of a voxel or of steps inside it. No Eigen::Vector3i, which is one more of
/// Eigen's types for the compiler to make (coordinates.hpp).
struct VoxelIndex {
  std::int32_t axes[3];

  VoxelIndex() = default;
  VoxelIndex(std::int32_t x, std::int32_t y, std::int32_t z) noexcept : axes{x, y, z} {}

  std::int32_t& operator[](int axis) noexcept { return axes[axis]; }
  std::int32_t operator[](int axis) const noexcept { return axes[axis]; }
  std::int32_t x() const noexcept { return axes[0]; }
  std::int32_t y() const noexcept { return axes[1]; }
  std::int32_t z() const noexcept { return axes[2]; }
};
using VoxelStep = VoxelIndex;

inline bool operator==(const VoxelIndex& a, const VoxelIndex& b) noexcept {
  return a.x() == b.x() && a.y() == b.y() && a.z() == b.z();
}

inline VoxelIndex truncated(const Eigen::Vector3d& v) noexcept {
  return {
      static_cast<std::int32_t>(v.x()),
      static_cast<std::int32_t>(v.y()),
      static_cast<std::int32_t>(v.z())};
}

/// A position on the lattice: the voxel, and the steps inside it, 0 to 2^13 - 1 per axis.
struct LatticePoint {
  VoxelIndex voxel;
  VoxelStep step;
};

/// The coordinate of a point modulo 8 voxels, as stored.
struct WrappedPoint {
  std::int16_t x, y, z;
};

template <class Integer = std::int32_t>
Integer floor_to_int(double value) {
  const auto truncated = static_cast<Integer>(value);
  return truncated - static_cast<Integer>(value < static_cast<double>(truncated));
}

/// One coordinate of a point modulo 8 voxels.
inline std::int16_t wrap(std::int32_t voxel, std::int32_t step) {
  return static_cast<std::int16_t>(
      (static_cast<std::uint32_t>(voxel) << kStepBits) + static_cast<std::uint32_t>(step));
}

enum class LatticeStatus : std::uint8_t { kInside, kNonFinite, kOutOfRange };

/// Converts between the map frame [m] and the lattice.
class Lattice {
 public:
  explicit Lattice(double voxel_size)
      : voxels_per_meter_(1.0 / voxel_size),
        meters_per_step_(voxel_size / kStepsPerVoxel),
        steps_per_meter_(kStepsPerVoxel / voxel_size),
        sq_meters_per_sq_step_(static_cast<float>(meters_per_step_ * meters_per_step_)) {}

  /// Whether the lattice holds a position given in voxels.
  static LatticeStatus judge(const Eigen::Vector3d& scaled) noexcept {
    if (is_inside(scaled.x()) && is_inside(scaled.y()) && is_inside(scaled.z())) {
      return LatticeStatus::kInside;
    }
    return all_finite(scaled) ? LatticeStatus::kOutOfRange : LatticeStatus::kNonFinite;
  }
  /// The same for one coordinate. False for NaN.
  static bool is_inside(double scaled) noexcept { return magnitude(scaled) < kEndOfLattice; }

  /// The lattice point of `position` [m]; `out` is written only when the result is kInside.
  LatticeStatus locate(const Eigen::Vector3d& position, LatticePoint& out) const noexcept {
    const LatticeStatus status =
        judge(per_axis([&](int axis) { return position[axis] * voxels_per_meter_; }));
    if (status != LatticeStatus::kInside) {
      return status;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const auto steps = floor_to_int<std::int64_t>(position[axis] * steps_per_meter_);
      out.voxel[axis] = static_cast<std::int32_t>(steps >> kStepBits);
      out.step[axis] = static_cast<std::int32_t>(steps & (kStepsPerVoxel - 1));
    }
    return LatticeStatus::kInside;
  }

  /// The middle of a lattice cell, in steps from the origin.
  static Eigen::Vector3d steps(const LatticePoint& point) noexcept {
    return per_axis([&](int axis) {
      return static_cast<double>(point.voxel[axis]) * kStepsPerVoxel + point.step[axis] + 0.5;
    });
  }
  /// The middle of a lattice cell [m].
  Eigen::Vector3d position(const VoxelIndex& voxel, const VoxelStep& step) const noexcept {
    const Eigen::Vector3d middle = steps({voxel, step});
    return per_axis([&](int axis) { return middle[axis] * meters_per_step_; });
  }

  double meters_per_step() const noexcept { return meters_per_step_; }
  double voxels_per_meter() const noexcept { return voxels_per_meter_; }

  float sq_meters(std::int32_t sq_steps) const noexcept {
    return static_cast<float>(sq_steps) * sq_meters_per_sq_step_;
  }

  /// The square of `meters` (not NaN) in lattice steps, rounded down, but less than the farthest
  /// that the 27 voxels around a query reach: 2 voxels along each axis.
  std::int32_t sq_steps(double meters) const noexcept {
    const double steps = meters * steps_per_meter_;
    constexpr double kReach = 12.0 * kStepsPerVoxel * kStepsPerVoxel;
    return static_cast<std::int32_t>(std::min(steps * steps, kReach - 1.0));
  }

 private:
  static constexpr std::uint64_t kEndOfLattice = 0x4130000000000000U;  // magnitude(kMaxVoxelIndex)

  double voxels_per_meter_;
  double meters_per_step_;
  double steps_per_meter_;
  float sq_meters_per_sq_step_;
};

inline WrappedPoint wrap(const LatticePoint& point) {
  return {
      wrap(point.voxel.x(), point.step.x()),
      wrap(point.voxel.y(), point.step.y()),
      wrap(point.voxel.z(), point.step.z())};
}

/// From `b` to `a` in steps; right when they are less than 4 voxels apart.
inline std::int32_t wrapped_difference(std::int16_t a, std::int16_t b) {
  return static_cast<std::int16_t>(a - b);
}

/// The steps inside its voxel of a stored coordinate.
inline std::int32_t step_in_voxel(std::int16_t wrapped) {
  return static_cast<std::uint16_t>(wrapped) & (kStepsPerVoxel - 1);
}

}  // namespace NVM_TARGET
}  // namespace nvm::detail
