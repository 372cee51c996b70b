// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/embree_scene.hpp"

#include <algorithm>
#include <stdexcept>

#include "sim/solid_intersection.hpp"

namespace nvm::sim {
namespace {

// Geometry ids: all boxes are one geometry and all cylinders another; each mesh is one.
constexpr unsigned kBoxes = 0;
constexpr unsigned kCylinders = 1;
constexpr unsigned kFirstMesh = 2;

constexpr std::uint32_t kTrianglesPerBox = 12;
constexpr std::array<std::array<std::uint32_t, 3>, kTrianglesPerBox> kBoxTriangles{{
    {0, 4, 6},
    {0, 6, 2},  // -x: two triangles per face, counter-clockwise from outside
    {1, 3, 7},
    {1, 7, 5},  // +x
    {0, 1, 5},
    {0, 5, 4},  // -y
    {2, 6, 7},
    {2, 7, 3},  // +y
    {0, 2, 3},
    {0, 3, 1},  // -z
    {4, 5, 7},
    {4, 7, 6},  // +z
}};

/// Corner 0 to 7 of a box; bits 0, 1, 2 choose the upper side in x, y, z.
Eigen::Vector3d box_corner(const Box& box, std::uint32_t corner) {
  Eigen::Vector3d p = box.half_size;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    p[axis] *= (corner >> axis & 1U) != 0 ? 1.0 : -1.0;
  }
  return box.T_world_box * p;
}

/// What `nearest` hands through Embree to the filters.
struct Context {
  EmbreeQuery base = make_embree_query();
  const Ray* ray = nullptr;
};

const Ray& ray_of(const EmbreeQuery* context) {
  return *reinterpret_cast<const Context*>(context)->ray;
}

RTCRayHit to_embree(const Ray& ray) {
  const Eigen::Vector3f o = ray.origin.cast<float>();
  const Eigen::Vector3f d = ray.direction.cast<float>();
  RTCRayHit ray_hit{};
  ray_hit.ray.org_x = o.x();
  ray_hit.ray.org_y = o.y();
  ray_hit.ray.org_z = o.z();
  ray_hit.ray.dir_x = d.x();
  ray_hit.ray.dir_y = d.y();
  ray_hit.ray.dir_z = d.z();
  ray_hit.ray.tfar = static_cast<float>(ray.max_range);
  ray_hit.ray.mask = ~0U;
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray_hit;
}

}  // namespace

EmbreeScene::EmbreeScene(const Scene& scene)
    : scene_(scene),
      device_(rtcNewDevice("threads=1")),  // the same tree, hence the same choice between ties
      embree_scene_(rtcNewScene(device_)) {
  rtcSetSceneFlags(embree_scene_, RTC_SCENE_FLAG_ROBUST);
  add_boxes();
  add_cylinders();
  unsigned id = kFirstMesh;
  for (const Mesh& mesh : scene_.meshes) {
    add_triangles(mesh.vertices, mesh.triangles, &filter_mesh, id);
    ++id;
  }
  rtcCommitScene(embree_scene_);
  if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree cannot build scene " + scene.name);
  }
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(embree_scene_);
  rtcReleaseDevice(device_);
}

void EmbreeScene::add_boxes() {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
  for (const Box& box : scene_.boxes) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      vertices.push_back(box_corner(box, corner));
    }
    for (const Triangle& t : kBoxTriangles) {
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  add_triangles(vertices, triangles, &filter_box, kBoxes);
}

void EmbreeScene::add_cylinders() {
  if (scene_.cylinders.empty()) {
    return;
  }
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene_.cylinders.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, &bound_cylinder, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &intersect_cylinder);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree_scene_, geometry, kCylinders);
  rtcReleaseGeometry(geometry);
}

void EmbreeScene::add_triangles(
    const std::vector<Eigen::Vector3d>& vertices,
    const std::vector<Triangle>& triangles,
    RTCFilterFunctionN filter,
    unsigned id) {
  if (triangles.empty()) {
    return;
  }
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* coordinate = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size()));
  for (const Eigen::Vector3d& vertex : vertices) {
    coordinate = std::copy_n(vertex.cast<float>().eval().data(), 3, coordinate);
  }
  auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), triangles.size()));
  for (const Triangle& triangle : triangles) {
    index = std::copy(triangle.begin(), triangle.end(), index);
  }
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryIntersectFilterFunction(geometry, filter);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree_scene_, geometry, id);
  rtcReleaseGeometry(geometry);
}

std::optional<EmbreeScene::Candidate> EmbreeScene::nearest(const Ray& ray) const {
  Context context;
  context.ray = &ray;
  RTCRayHit ray_hit = to_embree(ray);
  intersect(embree_scene_, context.base, ray_hit);

  const auto [geometry, primitive] = std::pair(ray_hit.hit.geomID, ray_hit.hit.primID);
  const auto range = static_cast<double>(ray_hit.ray.tfar);
  const auto boxes = static_cast<std::uint32_t>(scene_.boxes.size());
  const auto cylinders = static_cast<std::uint32_t>(scene_.cylinders.size());
  switch (geometry) {
    case RTC_INVALID_GEOMETRY_ID:
      return std::nullopt;
    case kBoxes:
      return Candidate{{primitive / kTrianglesPerBox, primitive % kTrianglesPerBox / 2}, range};
    case kCylinders:
      return Candidate{{boxes + primitive, 0}, range};
    default:
      return Candidate{{boxes + cylinders + geometry - kFirstMesh, primitive}, range};
  }
}

/// Refuses hits from inside the box, and those of rays that go through its glass.
void EmbreeScene::filter_box(const RTCFilterFunctionNArguments* arguments) {
  const auto& self = *static_cast<const EmbreeScene*>(arguments->geometryUserPtr);
  const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  const float cosine = hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z;
  const Material& material = self.scene_.boxes[hit.primID / kTrianglesPerBox].material;
  if (cosine >= 0.0F || material.transmission > ray_of(arguments->context).pass) {
    arguments->valid[0] = 0;
  }
}

/// Refuses the hits of rays that go through glass. Meshes need not be closed: both sides count.
void EmbreeScene::filter_mesh(const RTCFilterFunctionNArguments* arguments) {
  const auto& self = *static_cast<const EmbreeScene*>(arguments->geometryUserPtr);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  const Material& material = self.scene_.meshes[hit.geomID - kFirstMesh].material;
  if (material.transmission > ray_of(arguments->context).pass) {
    arguments->valid[0] = 0;
  }
}

void EmbreeScene::bound_cylinder(const RTCBoundsFunctionArguments* arguments) {
  const auto& self = *static_cast<const EmbreeScene*>(arguments->geometryUserPtr);
  const Cylinder& cylinder = self.scene_.cylinders[arguments->primID];
  constexpr double kMargin = 1e-3;  // covers the rounding to float [m]
  const Eigen::Vector3d size(cylinder.radius, cylinder.radius, cylinder.half_height);
  const Eigen::Vector3d reach =
      cylinder.T_world_cylinder.linear().cwiseAbs() * size + Eigen::Vector3d::Constant(kMargin);
  const Eigen::Vector3d center = cylinder.T_world_cylinder.translation();
  const Eigen::Vector3f lower = (center - reach).cast<float>();
  const Eigen::Vector3f upper = (center + reach).cast<float>();
  *arguments->bounds_o = {
      lower.x(), lower.y(), lower.z(), 0.0F, upper.x(), upper.y(), upper.z(), 0.0F};
}

void EmbreeScene::intersect_cylinder(const RTCIntersectFunctionNArguments* arguments) {
  const auto& self = *static_cast<const EmbreeScene*>(arguments->geometryUserPtr);
  const Cylinder& cylinder = self.scene_.cylinders[arguments->primID];
  const Ray& ray = ray_of(arguments->context);
  auto& ray_hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  if (arguments->valid[0] == 0 || cylinder.material.transmission > ray.pass) {
    return;
  }
  const auto entry = enter_cylinder(cylinder, ray.origin, ray.direction);
  if (entry && entry->range < static_cast<double>(ray_hit.ray.tfar)) {
    ray_hit.ray.tfar = static_cast<float>(entry->range);
    ray_hit.hit.geomID = kCylinders;
    ray_hit.hit.primID = arguments->primID;
    ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  }
}

}  // namespace nvm::sim
