// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lio/scan/deskew.hpp"
#include "nvm/normal/normal_result.hpp"

namespace nvm::lio {

/// Moves each point of `scan` onto the plane of its neighbourhood in the scan, which `estimated`
/// tells: a return errs by the range noise, the plane through its neighbours by a fraction of it. A
/// scan sees one side of a thin wall only, so the other side cannot pull.
///
/// Returns the normals: zero where the neighbours of a point are no plane but a volume, as in
/// foliage, and a sighting (nvm/map/sighting.hpp) where they are too few or a line, or their plane
/// is not to be trusted: its neighbours scatter more than the noise of the ranges explains at that
/// incidence, as they do near an edge, which would pull the point (in a concave corner towards the
/// sensor, so that walls come out too thick; at a convex one away from it); or the point is farther
/// than `max_offset` [m] from it, and so lies on something else; or the beam all but grazes it, so
/// that a small error would turn the side. The noise is that of the scan itself: the median over
/// its planes. Those points stay where they are. With `max_offset` zero all points stay, and the
/// normals are those estimated.
std::vector<Eigen::Vector3f> project_to_planes(
    const NormalResult& estimated, double max_offset, DeskewedScan& scan);

}  // namespace nvm::lio
