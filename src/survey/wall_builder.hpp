// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <vector>

#include "survey/edge_snapper.hpp"
#include "survey/face.hpp"
#include "survey/pairing.hpp"
#include "survey/survey.hpp"
#include "survey/wall_thickness.hpp"

namespace nvm::survey {

/// Makes what a survey lists of faces and pairs.
class WallBuilder {
 public:
  /// The ranges must outlive it. `up`: unit vector.
  WallBuilder(
      const SurveyCloud& cloud,
      const std::vector<Face>& faces,
      const std::vector<FacePair>& pairs,
      const Eigen::Vector3d& up,
      const SurveyOptions& options);

  /// The wall that pair `index` is, all but its uncertainty.
  Wall wall(std::size_t index, const WallThickness& measured) const;

  /// What is seen of faces beyond their walls.
  std::vector<SurveyFace> single_faces() const;

 private:
  Mask on_second(const FacePair& pair, const Mask& on_first) const;
  SurveyFace face(std::size_t index, const Mask& region) const;
  std::vector<Opening> openings(const FacePair& pair, const Mask& shown) const;
  /// How high `side` of a pair is seen over the length that both sides show [m].
  double shown_height(const FacePair& pair, const Face& side) const;
  WallKind kind(std::size_t index, const Wall& wall) const;
  bool is_before_a_wall(std::size_t index) const;
  Polygon in_map(const Face& face, const Loop& loop) const;
  bool is_upright(const Face& face) const;
  int gap_cells(const Mask& mask) const;

  const SurveyCloud& cloud_;
  const std::vector<Face>& faces_;
  const std::vector<FacePair>& pairs_;
  Eigen::Vector3d up_;
  SurveyOptions options_;
  EdgeSnapper snapper_;
  std::vector<Mask> rest_;  ///< of each face: what no pair covers
};

}  // namespace nvm::survey
