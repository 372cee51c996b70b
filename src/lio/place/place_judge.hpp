// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "lio/place/place.hpp"
#include "lio/place/scan_witness.hpp"

namespace nvm::lio {

/// The one of `places`, which are not the same and the best fits of a scan, that the scan's points
/// speak for. Found only when it is clearly better than each of the others, which rooms that look
/// alike are not: better no place than a wrong one.
Place judged(const std::vector<Place>& places, const VoxelMap& map, const ScanWitness& witness);

/// "60 % of the scan fit the map there, and 75 % must".
std::string misfit(double share, double min_share);

}  // namespace nvm::lio
