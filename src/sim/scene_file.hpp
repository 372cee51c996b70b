// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

#include "sim/scene.hpp"

namespace nvm::sim {

/// Reads a scene in the YAML format of docs/simulation.md. `scene` is the path of a file, or the
/// name of a shipped scene. Throws std::invalid_argument or std::runtime_error with the file, the
/// line and the problem; an unknown name is answered with the list of known ones.
Scene load_scene(const std::string& scene);

/// The scene that is written in `text`. `source` is named in errors; relative paths of included
/// files and meshes start at its folder.
Scene parse_scene(const std::string& text, const std::string& source);

/// The names of the shipped scenes.
std::vector<std::string> shipped_scenes();

}  // namespace nvm::sim
