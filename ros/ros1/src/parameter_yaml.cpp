// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "parameter_yaml.hpp"

#include <fmt/format.h>

namespace nvm_ros {

namespace {

std::string quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char character : text) {
    if (character == '"' || character == '\\') {
      quoted += '\\';
    }
    quoted += character == '\n' ? ' ' : character;
  }
  return quoted + '"';
}

std::string text_yaml(const std::string& text) {
  return !text.empty() && text.front() == '[' ? text : quoted(text);
}

std::string list_yaml(XmlRpc::XmlRpcValue& list) {
  std::string yaml;
  for (int i = 0; i < list.size(); ++i) {
    yaml += (i == 0 ? "" : ", ") + to_yaml(list[i]);
  }
  return "[" + yaml + "]";
}

std::string mapping_yaml(XmlRpc::XmlRpcValue& mapping) {
  std::string yaml;
  for (auto& [name, value] : mapping) {
    yaml += (yaml.empty() ? "" : ", ") + quoted(name) + ": " + to_yaml(value);
  }
  return "{" + yaml + "}";
}

}  // namespace

std::string to_yaml(XmlRpc::XmlRpcValue& value) {
  using XmlRpc::XmlRpcValue;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpcValue::TypeInt:
      return fmt::format("{}", static_cast<int>(value));
    case XmlRpcValue::TypeDouble:
      return fmt::format("{}", static_cast<double>(value));
    case XmlRpcValue::TypeString:
      return text_yaml(static_cast<std::string>(value));
    case XmlRpcValue::TypeArray:
      return list_yaml(value);
    case XmlRpcValue::TypeStruct:
      return mapping_yaml(value);
    default:
      return "null";
  }
}

}  // namespace nvm_ros
