// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "nvm/registration/scan_aligner.hpp"

nvm::ScanAligner<std::vector<Eigen::Vector3d>> aligner;
