// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "config/codec.hpp"
#include "config/nearest_name.hpp"
#include "config/value.hpp"

namespace nvm::sim {

/// The fields of one mapping of a scene file. Every member throws std::invalid_argument that names
/// the file, the line, the field and what is allowed.
class Fields {
 public:
  explicit Fields(config::Value mapping)
      : mapping_(std::move(mapping)), members_(mapping_.members()) {}

  bool has(const std::string& name) const { return find(name) != nullptr; }

  /// The value of a field that must be there.
  template <class T>
  T required(const std::string& name, const config::Range& range = {}) {
    if (!has(name)) {
      mapping_.fail_here("\"" + name + "\" is missing");
    }
    return optional<T>(name, T(), range);
  }

  /// The value of a field, or `otherwise` when it is not there.
  template <class T>
  T optional(const std::string& name, T otherwise, const config::Range& range = {}) {
    const config::Value* value = take(name);
    if (value != nullptr && !config::Codec<T>::parse(*value, range, otherwise)) {
      value->fail("must be " + config::Codec<T>::allowed(range));
    }
    return otherwise;
  }

  /// The value of a field itself; null when it is not there.
  const config::Value* take(const std::string& name) {
    taken_.insert(name);
    return find(name);
  }

  /// A point [x, y] or [x, y, z] that must be there; a missing z is `z`.
  Eigen::Vector3d point(const std::string& name, double z) {
    const config::Value* value = take(name);
    if (value == nullptr) {
      fail("\"" + name + "\" is missing");
    }
    return to_point(*value, z);
  }

  static Eigen::Vector3d to_point(const config::Value& value, double z) {
    std::vector<double> numbers;
    const bool is_list = config::Codec<std::vector<double>>::parse(value, {}, numbers);
    if (!is_list || numbers.size() < 2 || numbers.size() > 3) {
      value.fail("must be a list [x, y] or [x, y, z] of numbers");
    }
    return {numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : z};
  }

  /// The elements of a list of mappings; none when the field is not there.
  std::vector<Fields> items(const std::string& name) {
    const config::Value* value = take(name);
    if (value == nullptr) {
      return {};
    }
    const auto items = value->items();
    if (!items) {
      value->fail("must be a list");
    }
    return {items->begin(), items->end()};
  }

  /// The names and values of a mapping; none when the field is not there.
  std::vector<std::pair<std::string, config::Value>> members(const std::string& name) {
    const config::Value* value = take(name);
    return value == nullptr ? std::vector<std::pair<std::string, config::Value>>()
                            : value->members();
  }

  /// Refuses the fields that nobody has asked for.
  void finish() const {
    for (const auto& [name, value] : members_) {
      if (taken_.count(name) == 0) {
        const auto nearest = config::nearest_name(name, {taken_.begin(), taken_.end()});
        value.fail(nearest ? "unknown field; did you mean \"" + *nearest + "\"?" : "unknown field");
      }
    }
  }

  [[noreturn]] void fail(const std::string& problem) const { mapping_.fail_here(problem); }

 private:
  const config::Value* find(const std::string& name) const {
    const auto member = std::find_if(members_.begin(), members_.end(), [&](const auto& candidate) {
      return candidate.first == name;
    });
    return member == members_.end() ? nullptr : &member->second;
  }

  config::Value mapping_;
  std::vector<std::pair<std::string, config::Value>> members_;
  std::set<std::string> taken_;
};

}  // namespace nvm::sim
