// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <vector>

#include "sim/fields.hpp"
#include "sim/scene.hpp"

namespace nvm::sim {

/// Solids from their fields in a scene file, without name and material, in the frame of the mapping
/// that they belong to.

/// "min" and "max", or "center" and "size"; "rotation_deg".
Box read_box(Fields& item);

/// "min" and "max" of a room, "thickness" of the six boxes around it: -x, +x, -y, +y, -z, +z.
std::vector<Box> read_hull(Fields& item);

/// "bottom", "radius", "height" and "rotation_deg".
Cylinder read_cylinder(Fields& item);

/// "at" and "yaw_deg", or "rotation_deg" for all three angles.
Pose read_placement(Fields& item);

/// Boxes for what the openings leave of a wall: "from", "to", "thickness", "bottom", "height" and
/// "openings". Axis y is across the wall.
std::vector<Box> read_wall(Fields& item);

/// Boxes for what the openings leave of a slab: "min", "max", "top", "thickness" and "openings".
/// Axis z is across the slab.
std::vector<Box> read_slab(Fields& item);

}  // namespace nvm::sim
