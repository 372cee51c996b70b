// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

namespace nvm_ros {

/// A parameter of the parameter server as YAML in flow style. A text that begins with '[' counts as
/// a list: command lines (_name:=[1, 2]) have no other way to give one.
std::string to_yaml(XmlRpc::XmlRpcValue& value);

}  // namespace nvm_ros
