// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/normal/normal_estimator.hpp"

auto normals = nvm::estimate_normals(std::vector<Eigen::Vector3d>{}, 0.0);
