// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace YAML {
class Node;
}

namespace nvm::config {

/// A YAML value that knows its dotted key and where it was written, for error messages.
class Value {
 public:
  /// `source`: the file that the value comes from, named with the line in errors; empty for none.
  Value(const YAML::Node& node, std::string key, std::string source);

  bool is_empty() const;

  /// The text of a scalar; nothing for a list, a mapping and an empty value.
  std::optional<std::string> text() const;
  /// A number, infinite and NaN ones included; nothing when the value is something else.
  std::optional<double> number() const;
  std::optional<bool> boolean() const;
  /// The elements of a list; nothing when the value is something else.
  std::optional<std::vector<Value>> items() const;

  /// The values of a mapping with their names. Throws std::invalid_argument when the value is not
  /// a mapping or has a name twice.
  std::vector<std::pair<std::string, Value>> members() const;

  /// Throws std::invalid_argument: "file:line: key = value: problem".
  [[noreturn]] void fail(const std::string& problem) const;
  /// Throws std::invalid_argument: "file:line: problem".
  [[noreturn]] void fail_here(const std::string& problem) const;

  /// The dotted key of this value's member `name`.
  std::string key_of(const std::string& name) const;

 private:
  Value child(const YAML::Node& node, std::string key) const;

  std::shared_ptr<const YAML::Node> node_;
  std::string key_;
  std::string source_;
};

/// The number that all of `text` spells in the usual ways ("1e-3", "+.5", "inf"); nothing else.
std::optional<double> parse_number(std::string_view text);

}  // namespace nvm::config
