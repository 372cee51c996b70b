// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "survey/face.hpp"
#include "survey/outline.hpp"

namespace nvm::survey {

/// Sharpens outlines that were traced over cells.
class EdgeSnapper {
 public:
  /// `faces` must outlive it.
  EdgeSnapper(const SurveyCloud& cloud, const std::vector<Face>& faces);

  /// `loop` on face `index`, each edge moved to the line in which another face cuts the plane of
  /// this one, where one runs along it nearby, the nearest to where its points end: corners of
  /// rooms then are where three planes meet. Other edges go to the outermost of the face's points,
  /// or, where the loop bounds a hole, to the first of those around it. A corner is where its edges
  /// meet.
  Loop snap(std::size_t index, const Loop& loop, bool is_hole = false) const;

 private:
  /// {p : a u + b v = c}, (a, b) a unit vector to the right of the edge: outwards.
  struct Line {
    double a;
    double b;
    double c;
    bool is_cut = false;  ///< by another face
  };

  struct Edge {
    PlanePoint from;
    PlanePoint to;
    bool is_of_hole;
  };

  /// What the edges of a face may belong to.
  struct Surroundings {
    const Face& face;
    std::vector<const Face*> neighbors;
    Loop points;  ///< the face's own, in no order
  };

  Surroundings surroundings(std::size_t index) const;
  /// The lines in which other faces cut the plane along an edge, within reach of its middle.
  static std::vector<Line> cuts_along(
      const Surroundings& around, const Edge& loop_edge, const Line& edge);
  static Line edge_line(const Surroundings& around, const Edge& edge);
  static double end_of_points(const Surroundings& around, const Line& line, const Edge& edge);

  const SurveyCloud& cloud_;
  const std::vector<Face>& faces_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< around the faces
};

}  // namespace nvm::survey
