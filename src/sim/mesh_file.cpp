// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/mesh_file.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <stdexcept>

#include "io/file/file.hpp"
#include "sim/ply_check.hpp"

namespace nvm::sim {
namespace {

void append(const aiMesh& part, double scale, const Pose& T_world_mesh, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.vertices.push_back(T_world_mesh * (scale * Eigen::Vector3d(v.x, v.y, v.z)));
    if (!mesh.vertices.back().allFinite()) {
      throw std::runtime_error(mesh.file + ": has a vertex that is not finite");
    }
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices == 3) {  // points and lines have fewer
      mesh.triangles.push_back(
          {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
  }
}

}  // namespace

Mesh read_mesh(const std::string& path, double scale, const Pose& T_world_mesh) {
  if (io::extension_of(path) == ".ply") {
    check_ply(path);
  }
  Assimp::Importer importer;
  const aiScene* file = importer.ReadFile(
      path,
      aiProcess_Triangulate | aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices);
  if (file == nullptr) {
    throw std::runtime_error(path + ": " + importer.GetErrorString());
  }
  Mesh mesh;
  mesh.file = path;
  for (unsigned i = 0; i < file->mNumMeshes; ++i) {
    append(*file->mMeshes[i], scale, T_world_mesh, mesh);
  }
  if (mesh.triangles.empty()) {
    throw std::runtime_error(path + ": has no triangles");
  }
  return mesh;
}

}  // namespace nvm::sim
