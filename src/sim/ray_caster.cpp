// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/solid_intersection.hpp"

namespace nvm::sim {
namespace {

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
  const Eigen::Vector3d signs(
      (corner & 1U) != 0 ? 1.0 : -1.0,
      (corner & 2U) != 0 ? 1.0 : -1.0,
      (corner & 4U) != 0 ? 1.0 : -1.0);
  return box.T_world_box * signs.cwiseProduct(box.half_size);
}

/// What a call of `cast` hands through Embree to the filters.
struct RayContext {
  RTCIntersectContext base{};
  double pass = 1.0;
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

RayContext& context_of(RTCIntersectContext* context) {
  return *reinterpret_cast<RayContext*>(context);
}

/// A plane in double precision.
struct Plane {
  Eigen::Vector3d normal;
  double offset = 0.0;
};

struct Triangles {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> indices;
};

Triangles triangulate(const std::vector<Box>& boxes) {
  Triangles all;
  for (const Box& box : boxes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      all.vertices.push_back(box_corner(box, corner));
    }
    for (const auto& triangle : kBoxTriangles) {
      all.indices.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
    }
  }
  return all;
}

Plane triangle_plane(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const Eigen::Vector3d& a = mesh.vertices[triangle[0]];
  const Eigen::Vector3d normal =
      (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a).normalized();
  return {normal, normal.dot(a)};
}

}  // namespace

/// The scene in Embree: geometry 0 holds all boxes, 1 all cylinders, each further one a mesh.
struct RayCaster::Embree {
  explicit Embree(const Scene& source);
  ~Embree();

  static constexpr unsigned kBoxes = 0;
  static constexpr unsigned kCylinders = 1;
  static constexpr unsigned kFirstMesh = 2;

  SurfaceId surface(unsigned geometry, unsigned primitive) const;
  void add_triangles(
      const std::vector<Eigen::Vector3d>& vertices,
      const std::vector<std::array<std::uint32_t, 3>>& indices,
      RTCFilterFunctionN filter,
      unsigned id);
  void add_cylinders();

  static void filter_box(const RTCFilterFunctionNArguments* arguments);
  static void filter_mesh(const RTCFilterFunctionNArguments* arguments);
  static void bound_cylinder(const RTCBoundsFunctionArguments* arguments);
  static void intersect_cylinder(const RTCIntersectFunctionNArguments* arguments);

  const Scene& scene;
  RTCDevice device;
  RTCScene embree_scene;
  std::vector<Plane> box_planes;                ///< six per box
  std::vector<std::vector<Plane>> mesh_planes;  ///< one per triangle
};

RayCaster::Embree::Embree(const Scene& source)
    : scene(source),
      device(rtcNewDevice("threads=1")),  // the same tree, hence the same choice between ties
      embree_scene(rtcNewScene(device)) {
  rtcSetSceneFlags(embree_scene, RTC_SCENE_FLAG_ROBUST);
  const Triangles boxes = triangulate(scene.boxes);
  add_triangles(boxes.vertices, boxes.indices, &filter_box, kBoxes);
  add_cylinders();
  for (const Box& box : scene.boxes) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        const Face face = box_face(box, axis, side);
        box_planes.push_back({face.normal, face.offset});
      }
    }
  }
  for (const Mesh& mesh : scene.meshes) {
    const auto id = kFirstMesh + static_cast<unsigned>(mesh_planes.size());
    add_triangles(mesh.vertices, mesh.triangles, &filter_mesh, id);
    std::vector<Plane>& planes = mesh_planes.emplace_back();
    for (const auto& triangle : mesh.triangles) {
      planes.push_back(triangle_plane(mesh, triangle));
    }
  }
  rtcCommitScene(embree_scene);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree cannot build scene " + scene.name);
  }
}

RayCaster::Embree::~Embree() {
  rtcReleaseScene(embree_scene);
  rtcReleaseDevice(device);
}

void RayCaster::Embree::add_triangles(
    const std::vector<Eigen::Vector3d>& vertices,
    const std::vector<std::array<std::uint32_t, 3>>& indices,
    RTCFilterFunctionN filter,
    unsigned id) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex_buffer = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices.size()));
  for (const Eigen::Vector3d& vertex : vertices) {
    for (const double coordinate : vertex) {
      *vertex_buffer++ = static_cast<float>(coordinate);
    }
  }
  auto* index_buffer = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry,
      RTC_BUFFER_TYPE_INDEX,
      0,
      RTC_FORMAT_UINT3,
      3 * sizeof(std::uint32_t),
      indices.size()));
  for (const auto& triangle : indices) {
    index_buffer = std::copy(triangle.begin(), triangle.end(), index_buffer);
  }
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryIntersectFilterFunction(geometry, filter);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree_scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

void RayCaster::Embree::add_cylinders() {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.cylinders.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, &bound_cylinder, nullptr);
  rtcSetGeometryIntersectFunction(geometry, &intersect_cylinder);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree_scene, geometry, kCylinders);
  rtcReleaseGeometry(geometry);
}

SurfaceId RayCaster::Embree::surface(unsigned geometry, unsigned primitive) const {
  const auto boxes = static_cast<std::uint32_t>(scene.boxes.size());
  const auto cylinders = static_cast<std::uint32_t>(scene.cylinders.size());
  if (geometry == kBoxes) {
    return {primitive / kTrianglesPerBox, primitive % kTrianglesPerBox / 2};
  }
  if (geometry == kCylinders) {
    return {boxes + primitive, 0};
  }
  return {boxes + cylinders + geometry - kFirstMesh, primitive};
}

/// Refuses hits from inside the box, and those of rays that go through its glass.
void RayCaster::Embree::filter_box(const RTCFilterFunctionNArguments* arguments) {
  const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
  const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  const float cosine = hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z;
  const Material& material = self.scene.boxes[hit.primID / kTrianglesPerBox].material;
  if (cosine >= 0.0F || material.transmission > context_of(arguments->context).pass) {
    arguments->valid[0] = 0;
  }
}

/// Refuses the hits of rays that go through glass. Meshes need not be closed: both sides count.
void RayCaster::Embree::filter_mesh(const RTCFilterFunctionNArguments* arguments) {
  const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  const Material& material = self.scene.meshes[hit.geomID - kFirstMesh].material;
  if (material.transmission > context_of(arguments->context).pass) {
    arguments->valid[0] = 0;
  }
}

void RayCaster::Embree::bound_cylinder(const RTCBoundsFunctionArguments* arguments) {
  const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
  const Cylinder& cylinder = self.scene.cylinders[arguments->primID];
  constexpr double kMargin = 1e-3;  // covers the rounding to float
  const Eigen::Vector3d half_size =
      Eigen::Vector3d::Constant(kMargin) +
      cylinder.T_world_cylinder.linear().cwiseAbs() *
          Eigen::Vector3d(cylinder.radius, cylinder.radius, cylinder.half_height);
  const Eigen::Vector3f lower = (cylinder.T_world_cylinder.translation() - half_size).cast<float>();
  const Eigen::Vector3f upper = (cylinder.T_world_cylinder.translation() + half_size).cast<float>();
  *arguments->bounds_o = {
      lower.x(), lower.y(), lower.z(), 0.0F, upper.x(), upper.y(), upper.z(), 0.0F};
}

void RayCaster::Embree::intersect_cylinder(const RTCIntersectFunctionNArguments* arguments) {
  const auto& self = *static_cast<const Embree*>(arguments->geometryUserPtr);
  const Cylinder& cylinder = self.scene.cylinders[arguments->primID];
  const RayContext& context = context_of(arguments->context);
  auto& ray_hit = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  if (arguments->valid[0] == 0 || cylinder.material.transmission > context.pass) {
    return;
  }
  const auto entry = enter_cylinder(cylinder, context.origin, context.direction);
  if (entry && entry->range < static_cast<double>(ray_hit.ray.tfar)) {
    ray_hit.ray.tfar = static_cast<float>(entry->range);
    ray_hit.hit.geomID = kCylinders;
    ray_hit.hit.primID = arguments->primID;
    ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  }
}

RayCaster::RayCaster(const Scene& scene)
    : scene_(scene), embree_(std::make_unique<Embree>(scene)) {}
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster::~RayCaster() = default;

std::optional<RayHit> RayCaster::cast(
    const Eigen::Vector3d& origin,
    const Eigen::Vector3d& direction,
    double max_range,
    double pass) const {
  RayContext context;
  rtcInitIntersectContext(&context.base);
  context.pass = pass;
  context.origin = origin;
  context.direction = direction;
  const Eigen::Vector3f o = origin.cast<float>();
  const Eigen::Vector3f d = direction.cast<float>();
  RTCRayHit ray_hit{};
  ray_hit.ray.org_x = o.x();
  ray_hit.ray.org_y = o.y();
  ray_hit.ray.org_z = o.z();
  ray_hit.ray.dir_x = d.x();
  ray_hit.ray.dir_y = d.y();
  ray_hit.ray.dir_z = d.z();
  ray_hit.ray.tfar = static_cast<float>(max_range);
  ray_hit.ray.mask = ~0U;
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->embree_scene, &context.base, &ray_hit);

  const unsigned geometry = ray_hit.hit.geomID;
  const unsigned primitive = ray_hit.hit.primID;
  if (geometry == RTC_INVALID_GEOMETRY_ID) {
    return std::nullopt;
  }
  RayHit hit;
  hit.surface = embree_->surface(geometry, primitive);
  if (geometry == Embree::kCylinders) {
    const auto entry = enter_cylinder(scene_.cylinders[primitive], origin, direction);
    hit.range = entry->range;
    hit.normal = entry->normal;
    hit.surface.face = entry->face;
    return hit;
  }
  const Plane& plane = geometry == Embree::kBoxes
                           ? embree_->box_planes[primitive / 2]
                           : embree_->mesh_planes[geometry - Embree::kFirstMesh][primitive];
  const double exact = plane_range(origin, direction, plane.normal, plane.offset);
  const auto approximate = static_cast<double>(ray_hit.ray.tfar);
  // The two differ by more only when the ray runs along the face, where the exact plane says
  // little.
  constexpr double kMaxCorrection = 1e-3;
  hit.range = std::abs(exact - approximate) < kMaxCorrection ? exact : approximate;
  hit.normal = plane.normal.dot(direction) < 0.0 ? plane.normal : Eigen::Vector3d(-plane.normal);
  return hit;
}

const Material& RayCaster::material(const SurfaceId& surface) const {
  const std::size_t boxes = scene_.boxes.size();
  const std::size_t cylinders = scene_.cylinders.size();
  if (surface.object < boxes) {
    return scene_.boxes[surface.object].material;
  }
  if (surface.object < boxes + cylinders) {
    return scene_.cylinders[surface.object - boxes].material;
  }
  return scene_.meshes[surface.object - boxes - cylinders].material;
}

}  // namespace nvm::sim
