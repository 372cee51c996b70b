// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "eval/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nvm::eval {

namespace {

// Room for the labels around the plotting area [px].
constexpr double kLeft = 56.0;
constexpr double kRight = 12.0;
constexpr double kTop = 26.0;
constexpr double kBottom = 40.0;

/// A step of 1, 2 or 5 times a power of ten that divides `range` into 4 to 10 parts.
double tick_step(const AxisRange& range) {
  const double rough = (range.max - range.min) / 4.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= rough) {
      return factor * power;
    }
  }
  return power;
}

std::vector<double> ticks(const AxisRange& range) {
  const double step = tick_step(range);
  std::vector<double> result;
  for (double k = std::ceil(range.min / step); k * step <= range.max; ++k) {
    result.push_back(k * step + 0.0);  // turns -0 into 0
  }
  return result;
}

std::string text(double x, double y, const std::string& attributes, const std::string& content) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, attributes, escaped(content));
}

std::string svg_open(double width, double height) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"11\">\n",
      width,
      height);
}

void widen(AxisRange& range, double length) {
  const double extra = 0.5 * (length - (range.max - range.min));
  range.min -= extra;
  range.max += extra;
}

}  // namespace

AxisRange range_of(const std::vector<double>& values) {
  if (values.empty()) {
    return {};
  }
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  const double margin = std::max(0.05 * (*max - *min), 1e-9);
  return {*min - margin, *max + margin};
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

Chart::Chart(const ChartLayout& layout) : layout_(layout) {
  if (layout_.is_metric) {
    equalize_scales();
  }
}

void Chart::equalize_scales() {
  const double plot_width = layout_.width - kLeft - kRight;
  const double plot_height = layout_.height - kTop - kBottom;
  const double metres_per_pixel = std::max(
      (layout_.x.max - layout_.x.min) / plot_width, (layout_.y.max - layout_.y.min) / plot_height);
  widen(layout_.x, metres_per_pixel * plot_width);
  widen(layout_.y, metres_per_pixel * plot_height);
}

double Chart::pixel_x(double x) const {
  const double share = (x - layout_.x.min) / (layout_.x.max - layout_.x.min);
  return kLeft + share * (layout_.width - kLeft - kRight);
}

double Chart::pixel_y(double y) const {
  const double share = (y - layout_.y.min) / (layout_.y.max - layout_.y.min);
  return layout_.height - kBottom - share * (layout_.height - kTop - kBottom);
}

void Chart::add_line(const std::vector<ChartPoint>& points, const SeriesStyle& style) {
  std::string path;
  for (const ChartPoint& point : points) {
    path += fmt::format(
        "{}{:.1f} {:.1f}", path.empty() ? "M" : "L", pixel_x(point.x), pixel_y(point.y));
  }
  add_path(path, style);
}

void Chart::add_dots(const std::vector<ChartPoint>& points, const SeriesStyle& style) {
  std::string path;  // of lines without length, whose round caps are the dots
  for (const ChartPoint& point : points) {
    path += fmt::format("M{:.1f} {:.1f}h0", pixel_x(point.x), pixel_y(point.y));
  }
  add_path(path, style);
}

void Chart::add_path(const std::string& path, const SeriesStyle& style) {
  if (!path.empty()) {
    series_ += fmt::format(
        "<path class=\"{}\" d=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
        escaped(style.css_class),
        path,
        style.color,
        style.width);
  }
}

std::string Chart::x_axis() const {
  std::string axis;
  const double bottom = layout_.height - kBottom;
  for (const double tick : ticks(layout_.x)) {
    axis += fmt::format(
        "<path d=\"M{:.1f} {:.1f}V{:.1f}\" stroke=\"#e4e4e4\"/>\n", pixel_x(tick), bottom, kTop);
    axis +=
        text(pixel_x(tick), bottom + 14.0, "text-anchor=\"middle\"", fmt::format("{:.6g}", tick));
  }
  const double middle = 0.5 * (kLeft + layout_.width - kRight);
  return axis + text(middle, layout_.height - 8.0, "text-anchor=\"middle\"", layout_.x_label);
}

std::string Chart::y_axis() const {
  std::string axis;
  for (const double tick : ticks(layout_.y)) {
    axis += fmt::format(
        "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#e4e4e4\"/>\n",
        kLeft,
        pixel_y(tick),
        layout_.width - kRight);
    axis +=
        text(kLeft - 5.0, pixel_y(tick) + 4.0, "text-anchor=\"end\"", fmt::format("{:.6g}", tick));
  }
  const double middle = 0.5 * (kTop + layout_.height - kBottom);
  const std::string turn =
      fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 12 {:.1f})\"", middle);
  return axis + text(12.0, middle, turn, layout_.y_label);
}

std::string Chart::svg() const {
  std::string svg = svg_open(layout_.width, layout_.height);
  svg += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  svg += x_axis() + y_axis();
  svg += text(kLeft, 16.0, R"(font-size="13" font-weight="bold")", layout_.title);
  // A nested picture clips the series to the plotting area.
  svg += fmt::format(
      "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\" "
      "fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
      kLeft,
      kTop,
      layout_.width - kLeft - kRight,
      layout_.height - kTop - kBottom);
  return svg + series_ + "</svg>\n</svg>\n";
}

std::string side_by_side(const std::vector<Chart>& charts) {
  double width = 0.0;
  double height = 0.0;
  std::string content;
  for (const Chart& chart : charts) {
    content += fmt::format("<svg x=\"{:.0f}\">\n{}</svg>\n", width, chart.svg());
    width += chart.width();
    height = std::max(height, chart.height());
  }
  return svg_open(width, height) + content + "</svg>\n";
}

}  // namespace nvm::eval
