// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/survey.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>

#include "arrays.hpp"
#include "bind.hpp"
#include "io/result/map_origin.hpp"
#include "options.hpp"
#include "survey/keyframes_beside.hpp"
#include "survey/survey_files.hpp"
#include "survey/survey_json.hpp"

namespace nvm::python {

namespace {

using namespace nb::literals;

constexpr char kSurveyDoc[] = R"(The walls of a cloud, as the text of walls.json: see `nvm.survey`.

Parameters
----------
points : (N, 3) float
    [m], in the map's frame.
normals : (N, 3) float
    Unit vectors that look at where a point was seen from; zero where unknown.
out : str
    Folder for the files of ``nvm walls``; none when it is empty.
map : str
    The map.nvm that the points are of, for the keyframes beside it; empty when they are of no run.)";

io::MapCloud cloud_from(nb::handle points, nb::handle normals) {
  const Vectors positions(points, "points");
  const Vectors directions(normals, "normals");
  require_same_size(directions.size(), "normals", positions.size(), "points");
  io::MapCloud cloud;
  cloud.positions.reserve(positions.size());
  cloud.normals.reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    cloud.positions.push_back(positions[i]);
    cloud.normals.push_back(directions[i].cast<float>());
  }
  return cloud;
}

std::string survey(
    nb::handle points,
    nb::handle normals,
    const std::string& out,
    const std::string& map,
    const nb::kwargs& keywords) {
  const auto options = options_from<survey::SurveyOptions>(keywords);
  io::MapCloud cloud = cloud_from(points, normals);
  survey::KeyframeSource keyframes;
  if (!map.empty()) {
    const Eigen::Vector3d origin = io::read_origin(map);
    for (Eigen::Vector3d& position : cloud.positions) {
      position += origin;
    }
    keyframes = survey::keyframes_beside(map, origin);
  }
  const nb::gil_scoped_release no_gil;
  const survey::Survey found = survey::survey_walls(cloud, options, keyframes);
  if (!out.empty()) {
    survey::write_survey(found, options.plan_height, out);
  }
  return survey::survey_json(found);
}

}  // namespace

void bind_survey(nb::module_& module) {
  module.def(
      "survey",
      &survey,
      "points"_a.none(),
      "normals"_a.none(),
      "out"_a,
      "map"_a,
      "options"_a,
      documented<survey::SurveyOptions>(kSurveyDoc));
}

}  // namespace nvm::python
