// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "config/value.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>
#include <stdexcept>

namespace nvm::config {
namespace {

/// `node` on one line, cut to a length that fits into a message.
std::string excerpt(const YAML::Node& node) {
  constexpr std::size_t kMaxLength = 60;
  YAML::Emitter emitter;
  emitter << YAML::Flow << node;
  std::string text = node.IsScalar() ? node.Scalar() : emitter.c_str();
  if (text.size() > kMaxLength) {
    text = text.substr(0, kMaxLength) + "...";
  }
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return text;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  const bool has_plus = !text.empty() && text[0] == '+';
  const char* begin = text.data() + (has_plus ? 1 : 0);
  const char* end = text.data() + text.size();
  double number = 0.0;
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || rest != end) {
    return std::nullopt;
  }
  return number;
}

Value::Value(const YAML::Node& node, std::string key, std::string source)
    : node_(std::make_shared<YAML::Node>(node)), key_(std::move(key)), source_(std::move(source)) {}

Value Value::child(const YAML::Node& node, std::string key) const {
  return {node, std::move(key), source_};
}

std::string Value::key_of(const std::string& name) const {
  return key_.empty() ? name : key_ + "." + name;
}

bool Value::is_empty() const { return node_->IsNull(); }

std::optional<std::string> Value::text() const {
  return node_->IsScalar() ? std::optional(node_->Scalar()) : std::nullopt;
}

std::optional<double> Value::number() const {
  const auto scalar = text();
  return scalar ? parse_number(*scalar) : std::nullopt;
}

std::optional<bool> Value::boolean() const {
  bool boolean = false;
  return YAML::convert<bool>::decode(*node_, boolean) ? std::optional(boolean) : std::nullopt;
}

std::optional<std::vector<Value>> Value::items() const {
  if (!node_->IsSequence()) {
    return std::nullopt;
  }
  std::vector<Value> items;
  for (const YAML::Node& item : *node_) {
    items.push_back(child(item, key_ + "[" + std::to_string(items.size()) + "]"));
  }
  return items;
}

std::vector<std::pair<std::string, Value>> Value::members() const {
  if (!node_->IsMap()) {
    fail("must be a mapping of keys to values");
  }
  std::vector<std::pair<std::string, Value>> members;
  std::set<std::string> names;
  for (const auto& member : *node_) {
    const std::string name = excerpt(member.first);
    members.emplace_back(name, child(member.second, key_of(name)));
    if (!names.insert(name).second) {
      members.back().second.fail("the key is there twice");
    }
  }
  return members;
}

void Value::fail(const std::string& problem) const {
  const std::string subject = key_.empty() ? "" : key_ + " = ";
  fail_here(subject + excerpt(*node_) + ": " + problem);
}

void Value::fail_here(const std::string& problem) const {
  std::string place;
  if (!source_.empty()) {
    place = source_ + ":" + std::to_string(node_->Mark().line + 1) + ": ";
  }
  throw std::invalid_argument(place + problem);
}

}  // namespace nvm::config
