// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "config/schema.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "config/nearest_name.hpp"
#include "nvm/core/assert.hpp"

namespace nvm::config {
namespace {

constexpr double kDegreesPerRadian = 57.295779513082320876798154814105;

YAML::Node load(const std::string& yaml, const std::string& source) {
  try {
    return YAML::Load(yaml);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(
        source + ":" + std::to_string(error.mark.line + 1) + ": not valid YAML: " + error.msg);
  }
}

/// `text` as comment lines of at most 100 columns.
std::string comment(const std::string& text, const std::string& indent) {
  constexpr std::size_t kColumns = 100;
  std::istringstream words(text);
  std::string lines;
  std::string line = indent + "#";
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kColumns) {
      lines += line + "\n";
      line = indent + "#";
    }
    line += " " + word;
  }
  return lines + line + "\n";
}

std::string indented(const std::string& lines, const std::string& indent) {
  std::string text;
  for (const char c : lines) {
    text += c;
    if (c == '\n') {
      text += indent;
    }
  }
  return text;
}

std::string leaf_of(const std::string& dotted) { return dotted.substr(dotted.rfind('.') + 1); }

}  // namespace

std::string print_number(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof(text), number).ptr};
}

std::string describe(const Range& range) {
  if (std::isfinite(range.min) && std::isfinite(range.max)) {
    return " from " + print_number(range.min) + " to " + print_number(range.max);
  }
  if (std::isfinite(range.min)) {
    return " of at least " + print_number(range.min);
  }
  return std::isfinite(range.max) ? " of at most " + print_number(range.max) : "";
}

std::string Codec<std::string>::print(const std::string& target) {
  YAML::Emitter emitter;
  emitter << target;
  return emitter.c_str();
}

Schema::Schema() = default;
Schema::Schema(Schema&&) noexcept = default;
Schema& Schema::operator=(Schema&&) noexcept = default;
Schema::~Schema() = default;

Schema::Key& Schema::add_key(Key key) {
  NVM_ASSERT(find(key.name_) == nullptr);
  return *keys_.emplace_back(std::make_unique<Key>(std::move(key)));
}

Schema::Key& Schema::add_angle(
    const std::string& name, double& radians, const Range& range, const std::string& doc) {
  NVM_ASSERT(name.size() > 4 && name.substr(name.size() - 4) == "_deg");
  Key key;
  key.name_ = name;
  key.doc_ = doc;
  key.allowed_ = Codec<double>::allowed(range);
  key.parse_ = [&radians, range](const Value& value) {
    double degrees = 0.0;
    const bool is_allowed = Codec<double>::parse(value, range, degrees);
    radians = is_allowed ? degrees / kDegreesPerRadian : radians;
    return is_allowed;
  };
  key.print_ = [&radians] {
    std::ostringstream degrees;
    degrees.precision(12);
    degrees << radians * kDegreesPerRadian;
    return degrees.str();
  };
  return add_key(std::move(key));
}

Schema& Schema::section(const std::string& name, const std::string& doc) {
  Key key;
  key.name_ = name;
  key.doc_ = doc;
  key.section_ = std::make_unique<Schema>();
  return *add_key(std::move(key)).section_;
}

Schema::Key* Schema::find(const std::string& name) {
  for (const auto& key : keys_) {
    if (key->name_ == name) {
      return key.get();
    }
  }
  return nullptr;
}

void Schema::read_file(const std::string& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error(path + ": the file cannot be read");
  }
  read_text(std::string(std::istreambuf_iterator<char>(file), {}), path);
}

void Schema::read_text(const std::string& yaml, const std::string& source) {
  read(Value(load(yaml, source), "", source));
}

void Schema::set(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == 0 || equals == std::string::npos) {
    throw std::invalid_argument("override '" + assignment + "' is not of the form key=value");
  }
  YAML::Node node = load(assignment.substr(equals + 1), "override '" + assignment + "'");
  std::string dotted = assignment.substr(0, equals);
  while (!dotted.empty()) {
    const std::string leaf = leaf_of(dotted);
    YAML::Node mapping;
    mapping[leaf] = node;
    node = mapping;
    dotted.resize(dotted.size() - std::min(dotted.size(), leaf.size() + 1));
  }
  read_members(Value(node, "", ""));
}

void Schema::read(const Value& mapping) {
  read_members(mapping);
  check_required(mapping, "");
}

void Schema::read_members(const Value& mapping) {
  if (mapping.is_empty()) {
    return;
  }
  for (const auto& [name, value] : mapping.members()) {
    Key* key = find(name);
    if (key == nullptr) {
      fail_unknown(mapping, name, value);
    }
    key->is_given_ = true;
    if (key->section_) {
      key->section_->read_members(value);
    } else if (!key->parse_(value)) {
      value.fail("must be " + key->allowed_);
    }
  }
}

void Schema::check_required(const Value& mapping, const std::string& prefix) const {
  for (const auto& key : keys_) {
    const std::string name = prefix + key->name_;
    if (key->is_required_ && !key->is_given_) {
      mapping.fail_here("key " + mapping.key_of(name) + " is missing: " + key->doc_);
    }
    if (key->section_) {
      key->section_->check_required(mapping, name + ".");
    }
  }
}

void Schema::fail_unknown(const Value& mapping, const std::string& name, const Value& value) const {
  const std::vector<std::string> names = dotted_names("");
  std::vector<std::string> leaves;
  leaves.reserve(names.size());
  for (const std::string& known : names) {
    leaves.push_back(leaf_of(known));
  }
  auto known = nearest_name(name, names);
  if (const auto leaf = nearest_name(name, leaves); leaf && !known) {
    known = names[static_cast<std::size_t>(
        std::find(leaves.begin(), leaves.end(), *leaf) - leaves.begin())];
  }
  value.fail_here(
      "unknown key " + mapping.key_of(name) +
      (known ? "; did you mean " + mapping.key_of(*known) + "?" : ""));
}

std::vector<std::string> Schema::dotted_names(const std::string& prefix) const {
  std::vector<std::string> names;
  for (const auto& key : keys_) {
    names.push_back(prefix + key->name_);
    if (key->section_) {
      const auto below = key->section_->dotted_names(names.back() + ".");
      names.insert(names.end(), below.begin(), below.end());
    }
  }
  return names;
}

std::string Schema::to_yaml() const { return to_yaml(""); }

std::string Schema::to_yaml(const std::string& indent) const {
  std::string yaml;
  for (const auto& key : keys_) {
    if (key->section_) {
      yaml += comment(key->doc_ + ".", indent) + indent + key->name_ + ":\n" +
              key->section_->to_yaml(indent + "  ");
    } else {
      yaml += comment(key->doc_ + ". Allowed: " + key->allowed_ + ".", indent) + indent +
              key->name_ + ": " + indented(key->print_(), indent + "  ") + "\n";
    }
  }
  return yaml;
}

}  // namespace nvm::config
