// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "given_values.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace nvm::python {

namespace {

void require_kept(bool is_kept, const std::string& name) {
  if (!is_kept) {
    throw std::invalid_argument(
        "nvm: this map keeps no " + name + ": make it with VoxelMap(" + name + "=True)");
  }
}

/// Throws unless all are whole numbers of type Whole.
template <class Whole>
void require_whole(const ArrayView& array, std::size_t width, const char* name) {
  for (std::size_t i = 0; i < array.size(); ++i) {
    for (std::size_t axis = 0; axis < width; ++axis) {
      const double value = array.value(i, axis);
      if (!(value >= 0.0) || value > std::numeric_limits<Whole>::max() ||
          value != std::floor(value)) {
        throw std::invalid_argument(
            std::string("nvm: ") + name + " must be whole numbers from 0 to " +
            std::to_string(std::numeric_limits<Whole>::max()));
      }
    }
  }
}

template <class Number>
nb::object array_of(const std::vector<PointValues>& values, Number PointValues::*member) {
  std::vector<Number> numbers;
  numbers.reserve(values.size());
  for (const PointValues& of_point : values) {
    numbers.push_back(of_point.*member);
  }
  return nb::cast(to_array(std::move(numbers)));
}
nb::object array_of(const std::vector<PointValues>& values, Color PointValues::*member) {
  std::vector<std::uint8_t> parts;
  parts.reserve(3 * values.size());
  for (const PointValues& of_point : values) {
    const Color& color = of_point.*member;
    parts.insert(parts.end(), {color.red, color.green, color.blue});
  }
  return nb::cast(to_array(std::move(parts), 3));
}

}  // namespace

GivenValues::GivenValues(
    nb::handle intensity,
    nb::handle time,
    nb::handle color,
    nb::handle label,
    const MapColumns& columns,
    std::size_t size)
    : size_(size) {
  const auto take = [&](nb::handle given, const char* name, bool is_kept, auto& array) {
    if (!given.is_none()) {
      require_kept(is_kept, name);
      array.emplace(given, name);
      require_same_size(array->size(), name, size_, "points");
    }
  };
  take(intensity, "intensity", columns.intensity, intensity_);
  take(time, "time", columns.time, time_);
  take(color, "color", columns.color, color_);
  take(label, "label", columns.label, label_);
  if (color_) {
    require_whole<std::uint8_t>(*color_, 3, "color");
  }
  if (label_) {
    require_whole<std::uint16_t>(*label_, 1, "label");
  }
}

PointValues GivenValues::operator[](std::size_t i) const {
  PointValues values;
  if (intensity_) {
    values.intensity = static_cast<float>((*intensity_)[i]);
  }
  if (time_) {
    values.time = (*time_)[i];
  }
  if (color_) {
    const Eigen::Vector3d color = (*color_)[i];
    values.color = {
        static_cast<std::uint8_t>(color.x()),
        static_cast<std::uint8_t>(color.y()),
        static_cast<std::uint8_t>(color.z())};
  }
  if (label_) {
    values.label = static_cast<std::uint16_t>((*label_)[i]);
  }
  return values;
}

nb::object column_array(
    const std::vector<PointValues>& values, const MapColumns& columns, const std::string& name) {
  nb::object array;
  visit_columns([&](const OptionInfo& info, auto kept, auto value) {
    if (name == info.name) {
      require_kept(columns.*kept, name);
      array = array_of(values, value);
    }
  });
  if (!array.is_valid()) {
    throw std::invalid_argument("nvm: there is no column " + name);
  }
  return array;
}

}  // namespace nvm::python
