// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <string>

#include "io/sequence_reader.hpp"

namespace nvm::io {

/// Opens a folder of .pcd, .ply or KITTI .bin scans, which are in the folder itself or in its
/// subfolder "scans" or "velodyne", in the order of their names (numbers in names by their value).
///
/// The time of a scan is, in this order: that of its points, when absolute; of `timestamps.txt`
/// (lines "file t", [s]); of `times.txt` (one time per line, as in KITTI); the file's name, when it
/// is a number with a point or at least ten digits ([s], or [ms], [us], [ns] by its size); else the
/// scans follow each other at `options.scan_rate`. The text files stand beside the scans or one
/// folder above. Throws std::runtime_error, naming the file, when there are no scans or when the
/// times do not fit them.
std::unique_ptr<SequenceReader> open_scan_folder(
    const std::string& path, const SequenceOptions& options);

}  // namespace nvm::io
