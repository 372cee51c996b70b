// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nanobind/nanobind.h>

namespace nvm::python {

// Each adds its part to the module.
void bind_voxel_map(nanobind::module_& module);
void bind_map_stats(nanobind::module_& module);
void bind_normals(nanobind::module_& module);
void bind_odometry(nanobind::module_& module);
void bind_registration(nanobind::module_& module);
void bind_scan_stream(nanobind::module_& module);
void bind_survey(nanobind::module_& module);

}  // namespace nvm::python
