// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <array>
#include <cstddef>
#include <sstream>
#include <utility>

#include "nvm/core/finite.hpp"
#include "nvm/core/require.hpp"
#include "nvm/core/target.hpp"

namespace nvm {

/// What is said of an option, once, for whoever checks, stores, reads or prints it. Options structs
/// are walked by a function visit_options(options, visitor), which calls
/// `visitor(info, options.member)` for each member.
struct OptionInfo {
  const char* name;
  double min;
  double max;
  const char* unit;  ///< "m", "rad", "bytes", ...; empty for plain numbers
  const char* doc;
};

/// The same of an enumeration, whose values have names. For these, visit_options() calls
/// `visitor(info, options.member, choices)`.
template <class Enum, std::size_t kCount>
using OptionChoices = std::array<std::pair<const char*, Enum>, kCount>;

namespace detail {
inline namespace NVM_TARGET {

/// A visitor that throws std::invalid_argument for the first option out of range.
struct OptionValidator {
  template <class Value>
  void operator()(const OptionInfo& info, const Value& value) const {
    const auto number = static_cast<double>(value);
    if (!is_finite(number) || number < info.min || number > info.max) {
      std::ostringstream allowed;
      allowed << "from " << info.min << " to " << info.max << (*info.unit != '\0' ? " " : "")
              << info.unit;
      require(false, info.name, value, allowed.str().c_str());
    }
  }
  template <class Enum, std::size_t kCount>
  void operator()(
      const OptionInfo& info, const Enum& value, const OptionChoices<Enum, kCount>& choices) const {
    bool known = false;
    for (const auto& choice : choices) {
      known = known || choice.second == value;
    }
    require(known, info.name, static_cast<int>(value), "one of its enumeration");
  }
};

}  // namespace NVM_TARGET
}  // namespace detail
}  // namespace nvm
