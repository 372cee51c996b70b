// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/walls/wall.hpp"

#include <cmath>
#include <stdexcept>

#include "io/file/file.hpp"
#include "io/file/json_file.hpp"

namespace nvm::eval {

namespace {

using json = nlohmann::ordered_json;

Eigen::Vector3d read_vector(const json& value) {
  const auto numbers = value.get<std::array<double, 3>>();
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::Vector3d read_direction(const json& value) {
  const Eigen::Vector3d direction = read_vector(value);
  if (!(std::abs(direction.norm() - 1.0) < 1e-3)) {
    throw std::runtime_error("a direction is not of unit length");
  }
  return direction.normalized();
}

double read_positive(const json& value) {
  const auto number = value.get<double>();
  if (!(number > 0.0)) {
    throw std::runtime_error("a length is not positive");
  }
  return number;
}

WallFace read_face(const json& value) {
  WallFace face;
  face.center = read_vector(value.at("center"));
  face.plane.normal = read_direction(value.at("normal"));
  face.plane.offset = value.at("d").get<double>();
  face.u = read_direction(value.at("u"));
  face.v = read_direction(value.at("v"));
  face.half_u = read_positive(value.at("half_u"));
  face.half_v = read_positive(value.at("half_v"));
  face.hits = value.at("hits").get<std::size_t>();
  if (!(std::abs(face.plane.distance(face.center)) < 1e-3)) {
    throw std::runtime_error("the centre of a face is not on its plane");
  }
  return face;
}

WallPiece read_piece(const json& value) {
  const json& faces = value.at("faces");
  if (faces.size() != 2) {
    throw std::runtime_error("a wall piece has two faces");
  }
  WallPiece piece;
  piece.wall = value.at("wall").get<std::string>();
  piece.piece = value.at("piece").get<int>();
  piece.thickness = read_positive(value.at("thickness"));
  piece.faces = {read_face(faces[0]), read_face(faces[1])};
  if (!(piece.faces[0].plane.normal.dot(piece.faces[1].plane.normal) < 0.0)) {
    throw std::runtime_error("the faces of a wall piece do not look away from each other");
  }
  return piece;
}

}  // namespace

std::vector<WallPiece> read_walls(const std::string& path) {
  const json scene = io::read_json(path);
  if (!scene.is_object() || !scene.contains("walls") || !scene["walls"].is_array()) {
    io::fail(path, "has no list 'walls'");
  }
  std::vector<WallPiece> walls;
  for (const json& value : scene["walls"]) {
    try {
      walls.push_back(read_piece(value));
    } catch (const std::exception& error) {
      io::fail(path, "walls[" + std::to_string(walls.size()) + "]: " + error.what());
    }
  }
  return walls;
}

}  // namespace nvm::eval
