// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "config/codec.hpp"
#include "config/value.hpp"

namespace nvm::config {

/// The keys of a YAML mapping, each bound to the variable that takes its value.
///
///     MapOptions options;
///     Schema schema;
///     Schema& map = schema.section("map", "The two-sided voxel map");
///     map.add("voxel_size", options.voxel_size, {0.01, 100.0}, "Edge of a voxel [m]");
///     schema.read_file("nvm.yaml");
///     schema.set("map.voxel_size=0.2");
///
/// What a variable holds when it is bound is the key's default. The variables must outlive the
/// schema. Every reading function throws std::invalid_argument, with file:line, key, value and what
/// is allowed, for an unknown key (naming the nearest known one), a wrong type, a number out of
/// range, a key given twice, and a missing required key; the variables of the keys before the bad
/// one have then changed already.
class Schema {
 public:
  class Key;

  Schema();
  Schema(Schema&&) noexcept;
  Schema& operator=(Schema&&) noexcept;
  ~Schema();

  /// A number, a whole number, a flag, a text, an Eigen 3-vector, or a std::vector of these.
  template <class T>
  Key& add(const std::string& name, T& target, const Range& range, const std::string& doc);
  template <class T>
  Key& add(const std::string& name, T& target, const std::string& doc);

  /// An angle written in degrees: `name` ends in "_deg", `range` is in degrees, `radians` in [rad].
  Key& add_angle(
      const std::string& name, double& radians, const Range& range, const std::string& doc);

  /// One of the named values of an enumeration.
  template <class Enum>
  Key& add_choice(
      const std::string& name,
      Enum& target,
      const std::vector<std::pair<std::string, Enum>>& choices,
      const std::string& doc);

  /// A list of mappings; `bind(element_schema, element)` adds the keys of one.
  template <class T, class Bind>
  Key& add_list(
      const std::string& name, std::vector<T>& target, const Bind& bind, const std::string& doc);

  /// A mapping below this one.
  Schema& section(const std::string& name, const std::string& doc);

  /// Throws std::runtime_error, naming the file, when it cannot be read or is no YAML.
  void read_file(const std::string& path);
  /// `source` stands for the file name in messages.
  void read_text(const std::string& yaml, const std::string& source);
  /// An override "section.key=value", with the value in YAML.
  void set(const std::string& assignment);

  /// All keys with their present values, each below a comment with its doc and what it allows:
  /// before anything is read, the documented default configuration.
  std::string to_yaml() const;

  /// Reads the members of a mapping.
  void read(const Value& mapping);

 private:
  using Parse = std::function<bool(const Value&)>;
  using Print = std::function<std::string()>;

  Key& add_key(Key key);
  Key* find(const std::string& name);
  void read_members(const Value& mapping);
  void check_required(const Value& mapping, const std::string& prefix) const;
  [[noreturn]] void fail_unknown(
      const Value& mapping, const std::string& name, const Value& value) const;
  std::vector<std::string> dotted_names(const std::string& prefix) const;
  std::string to_yaml(const std::string& indent) const;

  std::vector<std::unique_ptr<Key>> keys_;
};

/// A key of a Schema: a value, or a section with keys of its own.
class Schema::Key {
 public:
  /// Makes reading fail when the mapping that the key belongs to does not have it.
  void required() { is_required_ = true; }

 private:
  friend class Schema;

  std::string name_;
  std::string doc_;
  std::string allowed_;
  Parse parse_;
  Print print_;
  std::unique_ptr<Schema> section_;
  bool is_required_ = false;
  bool is_given_ = false;
};

template <class T>
Schema::Key& Schema::add(
    const std::string& name, T& target, const Range& range, const std::string& doc) {
  Key key;
  key.name_ = name;
  key.doc_ = doc;
  key.allowed_ = Codec<T>::allowed(range);
  key.parse_ = [&target, range](const Value& value) {
    return Codec<T>::parse(value, range, target);
  };
  key.print_ = [&target] { return Codec<T>::print(target); };
  return add_key(std::move(key));
}

template <class T>
Schema::Key& Schema::add(const std::string& name, T& target, const std::string& doc) {
  return add(name, target, Range{}, doc);
}

template <class Enum>
Schema::Key& Schema::add_choice(
    const std::string& name,
    Enum& target,
    const std::vector<std::pair<std::string, Enum>>& choices,
    const std::string& doc) {
  Key key;
  key.name_ = name;
  key.doc_ = doc;
  for (const auto& [text, choice] : choices) {
    key.allowed_ += (key.allowed_.empty() ? "one of " : ", ") + text;
  }
  key.parse_ = [&target, choices](const Value& value) {
    for (const auto& [text, choice] : choices) {
      if (value.text() == text) {
        target = choice;
        return true;
      }
    }
    return false;
  };
  key.print_ = [&target, choices] {
    for (const auto& [text, choice] : choices) {
      if (choice == target) {
        return text;
      }
    }
    return std::string();
  };
  return add_key(std::move(key));
}

template <class T, class Bind>
Schema::Key& Schema::add_list(
    const std::string& name, std::vector<T>& target, const Bind& bind, const std::string& doc) {
  const auto bound = [bind](T& element) {
    Schema schema;
    bind(schema, element);
    return schema;
  };
  Key key;
  key.name_ = name;
  key.doc_ = doc;
  key.allowed_ = "a list of mappings";
  key.parse_ = [&target, bound](const Value& value) {
    const auto items = value.items();
    if (!items) {
      return false;
    }
    std::vector<T> elements(items->size());
    for (std::size_t i = 0; i < elements.size(); ++i) {
      bound(elements[i]).read((*items)[i]);
    }
    target = std::move(elements);
    return true;
  };
  key.print_ = [&target, bound] {
    std::string text;
    for (T element : target) {
      text += "\n-\n" + bound(element).to_yaml("  ");
    }
    return text.empty() ? "[]" : text;
  };
  return add_key(std::move(key));
}

}  // namespace nvm::config
