// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "survey/survey_files.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "io/file/pending_path.hpp"
#include "survey/dxf.hpp"
#include "survey/plan.hpp"
#include "survey/plan_drawing.hpp"
#include "survey/survey_html.hpp"
#include "survey/survey_json.hpp"
#include "survey/survey_table.hpp"

namespace nvm::survey {

namespace {

/// Polygons as Wavefront OBJ with a colour at each vertex, as MeshLab and CloudCompare read it.
class ObjWriter {
 public:
  void add(const std::string& name, const SurveyFace& face, const std::string& color) {
    add_polygon(name, face.polygon, color);
    for (const Polygon& part : face.parts) {
      add_polygon(name, part, color);
    }
  }

  const std::string& text() const { return text_; }

 private:
  void add_polygon(const std::string& name, const Polygon& polygon, const std::string& color) {
    std::string indices;
    text_ += "g " + name + "\n";
    for (const Eigen::Vector3d& p : polygon) {
      text_ += fmt::format("v {:.4f} {:.4f} {:.4f} {}\n", p.x(), p.y(), p.z(), color);
      indices += fmt::format(" {}", ++vertices_);
    }
    text_ += "f" + indices + "\n";
  }

  std::string text_;
  std::size_t vertices_ = 0;
};

std::string faces_obj(const Survey& survey) {
  const std::array<std::string, 2> colors{"0.12 0.47 0.71", "0.84 0.37 0.05"};
  ObjWriter writer;
  const auto add_all = [&](const std::vector<Wall>& walls, const std::string& prefix) {
    for (std::size_t i = 0; i < walls.size(); ++i) {
      for (std::size_t side = 0; side < 2; ++side) {
        writer.add(fmt::format("{}_{}_{}", prefix, i, side), walls[i].faces[side], colors[side]);
      }
    }
  };
  add_all(survey.walls, "wall");
  add_all(survey.bodies, "body");
  for (std::size_t i = 0; i < survey.faces.size(); ++i) {
    writer.add(fmt::format("face_{}", i), survey.faces[i], "0.7 0.7 0.7");
  }
  return writer.text();
}

}  // namespace

void write_survey(const Survey& survey, double plan_height, const std::string& folder) {
  const Plan plan = make_plan(survey, plan_height);
  const std::string svg = plan_svg(survey, plan);
  const std::vector<std::array<std::string, 2>> files{
      {"walls.json", survey_json(survey)},
      {"walls.csv", survey_csv(survey)},
      {"plan.svg", svg},
      {"plan.dxf", plan_dxf(survey, plan)},
      {"walls.html", survey_html(survey, svg)},
      {"faces.obj", faces_obj(survey)}};
  std::filesystem::create_directories(folder);
  std::vector<std::unique_ptr<io::AtomicFile>> written;
  for (const auto& [name, content] : files) {
    written.push_back(std::make_unique<io::AtomicFile>(folder + "/" + name));
    written.back()->stream() << content;
  }
  for (const auto& file : written) {
    file->commit();
  }
}

}  // namespace nvm::survey
