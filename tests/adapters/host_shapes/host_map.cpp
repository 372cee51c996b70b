// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "adapters/host_shapes/host_map.hpp"

#include "adapters/common/point_fields.hpp"
#include "adapters/ct_lio/ct_lio_map.hpp"
#include "adapters/ikd_tree/ikd_tree.hpp"
#include "adapters/ivox/ivox.hpp"

namespace nvm::test {
namespace {

class FastLioMap final : public HostShapeMap {
 public:
  explicit FastLioMap(HostMapKind kind) {
    if (kind == HostMapKind::kOwn) {
      tree_.make_transparent();
    }
  }
  void start(double filter_size) override {
    tree_.set_downsample_param(static_cast<float>(filter_size));
  }
  void set_view_point(const Eigen::Vector3d& p) override {
    tree_.set_view_point(p.x(), p.y(), p.z());
  }
  void build(const HostPoints& points) override { tree_.Build(points); }
  void add(const HostPoints& crowded, const HostPoints& alone) override {
    tree_.Add_Points(crowded, true);
    tree_.Add_Points(alone, false);
  }
  void search(const HostPoint& point, int count, HostPoints& found) const override {
    std::vector<float> sq_distances;
    tree_.Nearest_Search(point, count, found, sq_distances);
  }
  std::size_t size() const override { return static_cast<std::size_t>(tree_.size()); }

 private:
  adapters::IkdTree<HostPoint> tree_;
};

class FasterLioMap final : public HostShapeMap {
 public:
  explicit FasterLioMap(HostMapKind kind) { options_.transparent = kind == HostMapKind::kOwn; }
  void start(double filter_size) override {
    options_.resolution_ = static_cast<float>(filter_size);
    options_.nearby_type_ = Map::NearbyType::NEARBY18;
    map_ = std::make_unique<Map>(options_);
  }
  void set_view_point(const Eigen::Vector3d& p) override {
    map_->set_view_point(p.x(), p.y(), p.z());
  }
  void build(const HostPoints& points) override { map_->AddPoints(points); }
  void add(const HostPoints& crowded, const HostPoints& alone) override {
    map_->AddPoints(crowded);
    map_->AddPoints(alone);
  }
  void search(const HostPoint& point, int count, HostPoints& found) const override {
    map_->GetClosestPoint(point, found, count);
  }
  std::size_t size() const override { return map_->NumPoints(); }

 private:
  using Map = faster_lio::IVox<3, faster_lio::IVoxNodeType::DEFAULT, HostPoint>;
  Map::Options options_;
  std::unique_ptr<Map> map_;
};

class CtLioShapeMap final : public HostShapeMap {
 public:
  explicit CtLioShapeMap(HostMapKind kind) : kind_(kind) {}
  void start(double /*filter_size*/) override {
    constexpr double kVoxel = 0.2, kMinDistance = 0.05;  // [m], as the host has them
    adapters::HostOptions options = adapters::CtLioMap::defaults();
    options.map.min_point_distance = kMinDistance;
    map_.configure(
        kind_ == HostMapKind::kOwn ? adapters::CtLioMap::transparent(kVoxel, kMinDistance, 20)
                                   : options);
  }
  void set_view_point(const Eigen::Vector3d& p) override { map_.set_view_point(p); }
  void build(const HostPoints& points) override { add(points, {}); }
  void add(const HostPoints& crowded, const HostPoints& /*none*/) override {
    std::vector<Eigen::Vector3d> points, normals;
    for (const HostPoint& point : crowded) {
      points.push_back(position(point));
      normals.push_back(adapters::normal_field(point).cast<double>());
    }
    map_.add(points, normals);
  }
  void search(const HostPoint& point, int count, HostPoints& found) const override {
    const Eigen::Vector3d normal = adapters::normal_field(point).cast<double>();
    found = host_points(map_.search(position(point), normal, count));
  }
  std::size_t size() const override { return map_.size(); }

 private:
  HostMapKind kind_;
  adapters::CtLioMap map_;
};

}  // namespace

const char* name(HostFamily family) {
  constexpr std::array kNames{"FAST_LIO", "faster-lio", "ct-lio"};
  return kNames[static_cast<std::size_t>(family)];
}

const char* name(HostMapKind kind) {
  constexpr std::array kNames{"own map", "patch A", "patch B"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::unique_ptr<HostShapeMap> make_host_map(HostFamily family, HostMapKind kind) {
  switch (family) {
    case HostFamily::kFastLio:
      return std::make_unique<FastLioMap>(kind);
    case HostFamily::kFasterLio:
      return std::make_unique<FasterLioMap>(kind);
    case HostFamily::kCtLio:
      return std::make_unique<CtLioShapeMap>(kind);
  }
  return nullptr;
}

}  // namespace nvm::test
