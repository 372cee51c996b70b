// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <string>

#include "io/sequence/sequence_reader.hpp"

namespace nvm::io {

/// Opens a folder of .pcd, .ply or .bin scans (find_scans), or one such file, in the order of their
/// times: those of their points, when absolute, else as date_scans() finds them. Scans that cannot
/// be read or do not begin after the one before are left out and counted in a note. Throws
/// std::runtime_error, naming the file, when there are no scans or no scan can be read.
std::unique_ptr<SequenceReader> open_scan_folder(
    const std::string& path, const SequenceOptions& options);

}  // namespace nvm::io
