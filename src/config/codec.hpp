// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "config/value.hpp"

namespace nvm::config {

/// The numbers that a key allows, both ends included.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();

  bool contains(double number) const { return number >= min && number <= max; }
};

/// " from 1 to 3", " of at least 1", " of at most 3" or nothing.
std::string describe(const Range& range);

/// The shortest text that reads back as the same number.
std::string print_number(double number);

/// How a type of option is read and printed:
///   bool parse(value, range, target)   false, and no change, when the value is not allowed
///   std::string print(target)          as YAML
///   std::string allowed(range)         what parse accepts, for messages and comments
template <class T, class = void>
struct Codec;

template <>
struct Codec<bool> {
  static bool parse(const Value& value, const Range&, bool& target) {
    const auto boolean = value.boolean();
    target = boolean.value_or(target);
    return boolean.has_value();
  }
  static std::string print(bool target) { return target ? "true" : "false"; }
  static std::string allowed(const Range&) { return "true or false"; }
};

template <>
struct Codec<std::string> {
  static bool parse(const Value& value, const Range&, std::string& target) {
    const auto text = value.text();
    target = text.value_or(target);
    return text.has_value();
  }
  static std::string print(const std::string& target);
  static std::string allowed(const Range&) { return "text"; }
};

template <class Number>
struct Codec<Number, std::enable_if_t<std::is_floating_point_v<Number>>> {
  static bool parse(const Value& value, const Range& range, Number& target) {
    const auto number = value.number();
    constexpr Range kFinite{
        std::numeric_limits<Number>::lowest(), std::numeric_limits<Number>::max()};
    if (!number || !kFinite.contains(*number) || !range.contains(*number)) {
      return false;
    }
    target = static_cast<Number>(*number);
    return true;
  }
  static std::string print(Number target) { return print_number(target); }
  static std::string allowed(const Range& range) { return "a number" + describe(range); }
};

/// Whole numbers of a magnitude up to 2^53; "1e6" counts as one.
template <class Number>
struct Codec<Number, std::enable_if_t<std::is_integral_v<Number>>> {
  static bool parse(const Value& value, const Range& range, Number& target) {
    const auto number = value.number();
    if (!number || std::trunc(*number) != *number || !limits(range).contains(*number)) {
      return false;
    }
    target = static_cast<Number>(*number);
    return true;
  }
  static std::string print(Number target) { return std::to_string(target); }
  static std::string allowed(const Range& range) {
    return "a whole number" + describe(limits(range));
  }

 private:
  static Range limits(const Range& range) {
    constexpr double kMaxExact = 9007199254740992.0;
    using Limits = std::numeric_limits<Number>;
    return {
        std::max({range.min, -kMaxExact, static_cast<double>(Limits::min())}),
        std::min({range.max, kMaxExact, static_cast<double>(Limits::max())})};
  }
};

template <class T>
struct Codec<std::vector<T>> {
  static bool parse(const Value& value, const Range& range, std::vector<T>& target) {
    const auto items = value.items();
    if (!items) {
      return false;
    }
    std::vector<T> parsed(items->size());
    for (std::size_t i = 0; i < parsed.size(); ++i) {
      if (!Codec<T>::parse((*items)[i], range, parsed[i])) {
        (*items)[i].fail("must be " + Codec<T>::allowed(range));
      }
    }
    target = std::move(parsed);
    return true;
  }
  static std::string print(const std::vector<T>& target) {
    std::string text;
    for (const T& item : target) {
      text += (text.empty() ? "" : ", ") + Codec<T>::print(item);
    }
    return "[" + text + "]";
  }
  static std::string allowed(const Range& range) {
    return "a list [...] with each element " + Codec<T>::allowed(range);
  }
};

/// Three numbers, [x, y, z].
template <class Scalar>
struct Codec<Eigen::Matrix<Scalar, 3, 1>> {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  static bool parse(const Value& value, const Range& range, Vector& target) {
    std::vector<Scalar> numbers;
    if (!Codec<std::vector<Scalar>>::parse(value, range, numbers) || numbers.size() != 3) {
      return false;
    }
    target = Vector(numbers[0], numbers[1], numbers[2]);
    return true;
  }
  static std::string print(const Vector& target) {
    return Codec<std::vector<Scalar>>::print({target.x(), target.y(), target.z()});
  }
  static std::string allowed(const Range& range) {
    return "a list [x, y, z] with each element " + Codec<Scalar>::allowed(range);
  }
};

}  // namespace nvm::config
