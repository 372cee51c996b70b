// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <string>
#include <vector>

namespace nvm::eval {

/// An interval of an axis.
struct AxisRange {
  double min = 0.0;
  double max = 1.0;
};

/// The smallest range that holds all `values` and a margin of 5 %; [0, 1] without values.
AxisRange range_of(const std::vector<double>& values);

/// What a chart shows and how large it is drawn.
struct ChartLayout {
  std::string title;
  std::string x_label;
  std::string y_label;
  AxisRange x;
  AxisRange y;
  double width = 640.0;  ///< [px]
  double height = 360.0;
  bool is_metric = false;  ///< widens an axis so that both have the same scale
};

/// How a series is drawn.
struct SeriesStyle {
  std::string color = "#000000";
  double width = 1.5;  ///< of the line, or diameter of the dots [px]
  std::string css_class;
};

/// A point of a chart, in the units of its axes.
struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
};

/// A chart with two linear axes as an SVG picture that stands alone.
class Chart {
 public:
  explicit Chart(const ChartLayout& layout);

  /// A line through `points`; what is outside of the axes is clipped.
  void add_line(const std::vector<ChartPoint>& points, const SeriesStyle& style);
  void add_dots(const std::vector<ChartPoint>& points, const SeriesStyle& style);

  /// The `<svg>` element.
  std::string svg() const;

  double width() const { return layout_.width; }
  double height() const { return layout_.height; }

 private:
  double pixel_x(double x) const;
  double pixel_y(double y) const;
  void equalize_scales();
  std::string x_axis() const;
  std::string y_axis() const;
  void add_path(const std::string& path, const SeriesStyle& style);

  ChartLayout layout_;
  std::string series_;
};

/// The charts one beside the other, as one `<svg>` element.
std::string side_by_side(const std::vector<Chart>& charts);

/// `text` with the characters that XML and HTML keep for themselves escaped.
std::string escaped(const std::string& text);

}  // namespace nvm::eval
