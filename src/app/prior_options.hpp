// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "lio/pipeline/pipeline_options.hpp"

namespace CLI {
class App;
}

namespace nvm::app {

/// What the command line says about a prior map.
struct PriorArguments {
  std::string map;            ///< a map.nvm file, or the folder of one; empty: none
  std::vector<double> start;  ///< x y z [m] yaw [rad], or x y z qx qy qz qw; or none
  bool extends = false;
};

/// Adds --map, --start and --extend to `command`.
void add_prior_options(CLI::App& command, PriorArguments& arguments);

/// Throws std::invalid_argument when the arguments do not go together, std::runtime_error when
/// results in `folder` would replace the prior map.
void check(const PriorArguments& arguments, const std::string& folder);

/// Where the prior map's own coordinates begin, in those of its trajectory [m].
Eigen::Vector3d origin_of(const PriorArguments& arguments);

/// A pipeline in the prior map. The options of that map count, and it is said where those of
/// `options` differ. Throws std::exception with one line about what is wrong.
std::unique_ptr<lio::Pipeline> make_prior_pipeline(
    const PriorArguments& arguments, const lio::PipelineOptions& options);

}  // namespace nvm::app
