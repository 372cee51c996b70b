// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/survey_json.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace nvm::survey {

namespace {

using json = nlohmann::ordered_json;

constexpr double kDegrees = 57.29577951308232;

json vector_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

json polygon_of(const Polygon& polygon) {
  json points = json::array();
  for (const Eigen::Vector3d& p : polygon) {
    points.push_back(vector_of(p));
  }
  return points;
}

json face_of(const SurveyFace& face) {
  json result;
  result["normal"] = vector_of(face.plane.normal);
  result["d"] = face.plane.offset;
  result["polygon"] = polygon_of(face.polygon);
  result["points"] = face.points;
  result["rms"] = face.rms;
  result["bow"] = face.bow;
  result["area"] = face.area;
  result["parts"] = json::array();
  for (const Polygon& part : face.parts) {
    result["parts"].push_back(polygon_of(part));
  }
  return result;
}

json wall_of(const Wall& wall) {
  json result;
  result["thickness"] = wall.thickness;
  result["thickness_std"] = wall.thickness_std;
  result["kind"] = kind_name(wall.kind);
  result["bent"] = wall.is_bent;
  result["passes"] = passes_name(wall.passes);
  result["time_between"] = wall.passes == Passes::kUnknown ? json() : json(wall.time_between);
  result["angle_deg"] = kDegrees * wall.angle;
  result["area"] = wall.area;
  result["length"] = wall.length;
  result["height"] = wall.height;
  result["faces"] = {face_of(wall.faces[0]), face_of(wall.faces[1])};
  result["openings"] = json::array();
  for (const Opening& opening : wall.openings) {
    json entry;
    entry["kind"] = opening.kind;
    entry["width"] = opening.width;
    entry["height"] = opening.height;
    entry["polygon"] = polygon_of(opening.polygon);
    result["openings"].push_back(entry);
  }
  return result;
}

json walls_of(const std::vector<Wall>& walls) {
  json result = json::array();
  for (const Wall& wall : walls) {
    result.push_back(wall_of(wall));
  }
  return result;
}

}  // namespace

std::string survey_json(const Survey& survey) {
  json result;
  result["walls"] = walls_of(survey.walls);
  result["faces"] = json::array();
  for (const SurveyFace& face : survey.faces) {
    result["faces"].push_back(face_of(face));
  }
  result["bodies"] = walls_of(survey.bodies);
  result["up"] = vector_of(survey.up);
  result["floor"] = survey.floor;
  result["noise"] = survey.noise;
  result["inflation"] = survey.inflation;
  result["bend"] = survey.bend;
  result["jitter"] = survey.jitter;
  result["drift"] = survey.drift;
  result["patch_size"] = survey.patch_size;
  result["rounding"] = survey.rounding;
  result["inside_out"] = survey.is_inside_out;
  result["left_out"] = survey.left_out;
  return result.dump(1) + "\n";
}

}  // namespace nvm::survey
