// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/message/message_source.hpp"

namespace nvm::io {

/// Types of messages, by their names.
bool is_livox(const std::string& type);
bool is_cloud(const std::string& type);
bool is_imu(const std::string& type);

/// The topics with messages of an accepted type, in order of appearance.
std::vector<std::string> topics_of(
    const std::vector<MessageTopic>& topics, bool (*accepts)(const std::string&));

/// The number of messages of accepted types on a topic.
std::size_t count_of(
    const std::vector<MessageTopic>& topics,
    const std::string& name,
    bool (*accepts)(const std::string&));

/// The wanted one of `topics`, or the first; empty when there is none. Adds a note when there was a
/// choice. Throws std::runtime_error when the wanted one is not there.
std::string choose_topic(
    const char* kind,
    const std::vector<std::string>& topics,
    const std::string& wanted,
    std::vector<std::string>& notes);

/// Throws std::runtime_error, which says what there is instead of clouds, and `notes`.
[[noreturn]] void refuse_without_clouds(
    const std::vector<MessageTopic>& topics, const std::vector<std::string>& notes);

}  // namespace nvm::io
