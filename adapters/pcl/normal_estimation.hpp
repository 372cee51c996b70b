// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <pcl/console/print.h>
#include <pcl/features/normal_3d.h>

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <stdexcept>

#include "adapters/pcl/cloud.hpp"
#ifdef _OPENMP
#include <omp.h>

#include "nvm/core/executor_openmp.hpp"
#endif

namespace nvm::adapters {

/// Takes the place of pcl::NormalEstimationOMP: same calls, and the same normals for
/// setRadiusSearch(). Without a radius, the neighbourhood grows with the distance to the view
/// point, as options() say.
///
/// Differences: setKSearch() is refused; setSearchMethod() is ignored, the estimator has a search
/// of its own; the curvature is NaN. options() may make it tell lines and corners from planes,
/// whose normals are then NaN.
template <class PointInT, class PointOutT>
class NormalEstimation : public ::pcl::NormalEstimation<PointInT, PointOutT> {
  using Base = ::pcl::NormalEstimation<PointInT, PointOutT>;
  using Base::fake_surface_;
  using Base::indices_;
  using Base::input_;
  using Base::k_;
  using Base::search_radius_;
  using Base::surface_;

 public:
  using Ptr = ::pcl::shared_ptr<NormalEstimation>;
  using PointCloudOut = typename Base::PointCloudOut;

  /// `threads` 0: as OpenMP decides. Without OpenMP there is one.
  explicit NormalEstimation(unsigned int threads = 0) : threads_(threads) {
    this->feature_name_ = "nvm::NormalEstimation";
    options_.min_range = 0.0;
    options_.max_range = 1e4;
    options_.min_neighbors = 3;
    options_.max_linearity = 1.0;
    options_.max_surface_variation = 1.0 / 3.0;
  }

  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }
  /// By default every point with three neighbours gets a normal, as in PCL.
  NormalOptions& options() noexcept { return options_; }

 protected:
  /// False, with PCL's error message, when the input or the parameters are bad.
  bool initCompute() override {
    if (!::pcl::PCLBase<PointInT>::initCompute()) {
      return false;
    }
    if (k_ != 0) {
      PCL_ERROR("[nvm::NormalEstimation::compute] setKSearch is not supported, set a radius.\n");
      return false;
    }
    if (search_radius_ > 0.0) {
      options_.min_radius = options_.max_radius = search_radius_;
    }
    try {
      options_.validate();
    } catch (const std::invalid_argument& error) {
      PCL_ERROR("[nvm::NormalEstimation::compute] %s\n", error.what());
      return false;
    }
    if (!surface_) {
      fake_surface_ = true;
      surface_ = input_;
    }
    return true;
  }

  void computeFeature(PointCloudOut& output) override {
    NormalEstimator estimator(options_);
    const Eigen::Vector3d viewpoint =
        Eigen::Vector3f(this->vpx_, this->vpy_, this->vpz_).cast<double>();
    const Queries queries{*input_, *indices_};
    const NormalResult& result = estimate(estimator, queries, viewpoint);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      set_pcl_normal(output[i], result, i);
    }
    output.is_dense = result.stats.valid == queries.size();
  }

 private:
  /// The points to estimate at.
  struct Queries {
    const ::pcl::PointCloud<PointInT>& cloud;
    const ::pcl::Indices& indices;
    std::size_t size() const { return indices.size(); }
    const PointInT& operator[](std::size_t i) const {
      return cloud[static_cast<std::size_t>(indices[i])];
    }
  };

  const NormalResult& estimate(
      NormalEstimator& estimator, const Queries& queries, const Eigen::Vector3d& viewpoint) const {
#ifdef _OPENMP
    const int threads_before = omp_get_max_threads();
    if (threads_ > 0) {
      omp_set_num_threads(static_cast<int>(threads_));
    }
    const NormalResult& result =
        estimator.estimate_at(queries, *surface_, viewpoint, OpenMpExecutor{});
    omp_set_num_threads(threads_before);
    return result;
#else
    return estimator.estimate_at(queries, *surface_, viewpoint);
#endif
  }

  unsigned int threads_;
  NormalOptions options_;
};

}  // namespace nvm::adapters
