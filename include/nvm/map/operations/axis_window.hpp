// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "nvm/core/target.hpp"
#include "nvm/map/storage/brick.hpp"

namespace nvm::detail {
inline namespace NVM_TARGET {

/// What lies next to a voxel along one axis, in its own brick (0) and in the one beside it (1).
struct AxisWindow {
  bool is_wide = false;  // reaches into the brick beside
  // Per axis that it may be used for, and brick: the cells in the window, and the way to the brick
  // in Brick::around.
  std::array<std::array<std::uint64_t, 2>, 3> cells{};
  std::array<std::array<int, 2>, 3> around_step{};
};

/// The window from place `first` to `last` of the brick that holds the voxel: -1 and 4 lie in the
/// brick beside it.
constexpr AxisWindow axis_window(int first, int last) {
  constexpr std::array<int, 3> kStride{1, kBrickEdge, kBrickEdge * kBrickEdge};
  constexpr std::array<int, 3> kAroundStride{1, 3, 9};
  // The cells at place 0 along each axis.
  constexpr std::array<std::uint64_t, 3> kFirstCells{
      0x1111111111111111U, 0x000f000f000f000fU, 0x000000000000ffffU};
  AxisWindow window;
  window.is_wide = first < 0 || last >= kBrickEdge;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    window.around_step[axis][1] = first < 0 ? -kAroundStride[axis] : kAroundStride[axis];
    for (int place = first; place <= last; ++place) {
      const std::size_t brick = place < 0 || place >= kBrickEdge ? 1 : 0;
      const int inside = place & (kBrickEdge - 1);
      window.cells[axis][brick] |= kFirstCells[axis] << inside * kStride[axis];
    }
  }
  return window;
}

/// Windows by the voxel's place in its brick (0 to 3) and by which neighbours are wanted (bit 0:
/// the lower, bit 1: the upper).
inline constexpr auto kAxisWindows = [] {
  std::array<std::array<AxisWindow, 4>, kBrickEdge> windows{};
  for (int place = 0; place < kBrickEdge; ++place) {
    for (int wanted = 0; wanted < 4; ++wanted) {
      windows[static_cast<std::size_t>(place)][static_cast<std::size_t>(wanted)] =
          axis_window(place - (wanted & 1), place + (wanted >> 1));
    }
  }
  return windows;
}();

/// The bricks that windows reach into, by which of them are wide (bit 0: x, 1: y, 2: z): bit b is
/// set for brick b, whose own bits say along which axes it lies beside.
inline constexpr std::array<std::uint8_t, 8> kWindowBricks{
    0x01, 0x03, 0x05, 0x0f, 0x11, 0x33, 0x55, 0xff};

}  // namespace NVM_TARGET
}  // namespace nvm::detail
