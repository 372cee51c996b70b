// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/scene_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "io/file/file.hpp"
#include "io/file/stays_below.hpp"
#include "sim/scene_reader.hpp"
#include "sim/shipped_files.hpp"

namespace nvm::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtension = ".yaml";
constexpr std::string_view kLibraryPrefix = "_";  ///< of shipped files that are no scenes
constexpr int kMaxIncludeDepth = 8;               ///< more is taken for a circle

/// A scene file before it is parsed.
struct SceneText {
  std::string text;
  std::string source;
};

/// The file at `path`, or else the shipped file called `name`.
std::optional<SceneText> find_file(const fs::path& path, const std::string& name) {
  if (fs::is_regular_file(path)) {
    return SceneText{io::read_file(path.string()), path.string()};
  }
  for (const ShippedFile& file : shipped_files()) {
    if (file.name == name) {
      return SceneText{std::string(file.text), std::string(file.name)};
    }
  }
  return std::nullopt;
}

config::Value parse_yaml(const SceneText& scene) {
  try {
    return {YAML::Load(scene.text), "", scene.source};
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(
        scene.source + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
}

/// Adds what `scene` describes, and first what the files that it includes describe.
void add_file(const SceneText& scene, int depth, SceneReader& reader) {
  Fields document(parse_yaml(scene));
  const fs::path folder = fs::path(scene.source).parent_path();
  const std::vector<std::string> none;
  for (const std::string& name : document.optional("include", none)) {
    if (depth == kMaxIncludeDepth) {
      document.fail("the included \"" + name + "\" includes itself");
    }
    if (!io::stays_below(name)) {
      document.fail("the included \"" + name + "\" lies outside the folder of the scene");
    }
    const auto included = find_file(folder / name, name);
    if (!included) {
      document.fail("the included \"" + name + "\" is neither a file nor shipped with nvm");
    }
    add_file(*included, depth + 1, reader);
  }
  reader.add(document, folder.string());
  document.finish();
}

std::string unknown_scene(const std::string& scene) {
  std::string message = "no scene \"" + scene + "\": give the path of a scene file or one of";
  for (const std::string& name : shipped_scenes()) {
    message += " " + name;
  }
  return message;
}

}  // namespace

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  for (const ShippedFile& file : shipped_files()) {
    if (file.name.substr(0, kLibraryPrefix.size()) != kLibraryPrefix) {
      names.emplace_back(file.name.substr(0, file.name.size() - kExtension.size()));
    }
  }
  return names;
}

Scene parse_scene(const std::string& text, const std::string& source) {
  SceneReader reader;
  add_file({text, source}, 0, reader);
  Scene scene = reader.take();
  scene.name = fs::path(source).stem().string();
  if (scene.boxes.empty() && scene.cylinders.empty() && scene.meshes.empty()) {
    throw std::invalid_argument(source + ": the scene is empty");
  }
  return scene;
}

Scene load_scene(const std::string& scene) {
  const std::vector<std::string> shipped = shipped_scenes();
  const bool is_shipped = std::find(shipped.begin(), shipped.end(), scene) != shipped.end();
  const auto file = find_file(scene, is_shipped ? scene + std::string(kExtension) : "");
  if (!file) {
    throw std::runtime_error(unknown_scene(scene));
  }
  return parse_scene(file->text, file->source);
}

}  // namespace nvm::sim
