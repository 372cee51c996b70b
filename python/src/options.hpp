// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

#include "nvm/map/map_options.hpp"
#include "option_lists.hpp"
#include "whole_number.hpp"

namespace nvm::python {

namespace nb = nanobind;

namespace detail {

template <class Value>
constexpr bool kIsWhole = std::is_integral_v<Value> && !std::is_same_v<Value, bool>;

/// The least and the greatest value of a whole number: those of the option where it has a range,
/// else of its type.
template <class Value>
std::pair<std::int64_t, std::int64_t> range_of(const OptionInfo& info) {
  if (info.min < info.max) {
    return {static_cast<std::int64_t>(info.min), static_cast<std::int64_t>(info.max)};
  }
  constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
  const auto max = std::min(kMost, static_cast<std::uint64_t>(std::numeric_limits<Value>::max()));
  return {
      static_cast<std::int64_t>(std::numeric_limits<Value>::min()), static_cast<std::int64_t>(max)};
}

template <class Value>
bool assign(nb::handle given, const OptionInfo& info, Value& value) {
  if constexpr (kIsWhole<Value>) {
    const auto [min, max] = range_of<Value>(info);
    const auto number = whole_number(given, min, max);
    value = number ? static_cast<Value>(*number) : value;
    return number.has_value();
  } else {
    return nb::try_cast<Value>(given, value);
  }
}

template <class Enum, class Choices>
bool assign(nb::handle given, const OptionInfo& /*info*/, Enum& value, const Choices& choices) {
  std::string name;
  if (!nb::try_cast<std::string>(given, name)) {
    return false;
  }
  for (const auto& [text, choice] : choices) {
    if (name == text) {
      value = choice;
      return true;
    }
  }
  return false;
}

template <class Value>
std::string allowed(const OptionInfo& info, const Value& /*value*/) {
  if constexpr (kIsWhole<Value>) {
    const auto [min, max] = range_of<Value>(info);
    return must_be_whole(min, max);
  }
  return std::is_same_v<Value, bool> ? "True or False" : "a number";
}
template <class Enum, class Choices>
std::string allowed(const OptionInfo& /*info*/, const Enum& /*value*/, const Choices& choices) {
  std::string text = "one of";
  for (const auto& choice : choices) {
    text += std::string(" '") + choice.first + "'";
  }
  return text;
}

/// " [m], 0.01 to 100.", or which names there are.
template <class Value>
std::string limits(const OptionInfo& info, const Value& /*value*/) {
  std::ostringstream text;
  text << (*info.unit != '\0' ? std::string(" [") + info.unit + "]" : "");
  if (info.min < info.max && !std::is_same_v<Value, bool>) {
    text << ", " << info.min << " to " << info.max << ".";
  }
  return text.str();
}
template <class Enum, class Choices>
std::string limits(const OptionInfo& info, const Enum& value, const Choices& choices) {
  return ": " + allowed(info, value, choices) + ".";
}

template <class Value>
nb::object to_python(const Value& value) {
  return nb::cast(value);
}
template <class Enum, class Choices>
nb::object to_python(const Enum& value, const Choices& choices) {
  for (const auto& [text, choice] : choices) {
    if (value == choice) {
      return nb::str(text);
    }
  }
  return nb::none();
}

}  // namespace detail

/// What to say when not all of `keywords` are options.
template <class Options>
std::string unknown_option(const nb::kwargs& keywords, Options& options) {
  std::set<std::string> names;
  std::string list;
  visit_options(options, [&](const OptionInfo& text, auto&, const auto&...) {
    names.insert(text.name);
    list += std::string(" ") + text.name;
  });
  std::string unknown;
  for (const auto& [key, value] : keywords) {
    const std::string name = nb::str(key).c_str();
    unknown = names.count(name) == 0 ? name : unknown;
  }
  return "nvm: unknown option '" + unknown + "'; there are:" + list;
}

/// The options that `keywords` set, the others as the C++ defaults have them. Throws TypeError for
/// an unknown name, ValueError for a value of the wrong type. Ranges are checked by who takes them.
template <class Options>
Options options_from(const nb::kwargs& keywords) {
  Options options;
  std::size_t known = 0;
  visit_options(options, [&](const OptionInfo& text, auto& value, const auto&... choices) {
    if (!keywords.contains(text.name)) {
      return;
    }
    ++known;
    const nb::object given = keywords[text.name];
    if (!detail::assign(given, text, value, choices...)) {
      const std::string message = std::string("nvm: ") + text.name + " = " +
                                  nb::repr(given).c_str() + " must be " +
                                  detail::allowed(text, value, choices...);
      throw nb::value_error(message.c_str());
    }
  });
  if (known != keywords.size()) {
    throw nb::type_error(unknown_option(keywords, options).c_str());
  }
  return options;
}

/// The options as a dict of names and values.
template <class Options>
nb::dict to_dict(Options options) {
  nb::dict dict;
  visit_options(options, [&](const OptionInfo& text, const auto& value, const auto&... choices) {
    dict[text.name] = detail::to_python(value, choices...);
  });
  return dict;
}

/// The list of the options for a docstring in numpydoc's form, behind `head`. Lives forever, as
/// nanobind wants it.
template <class Options>
const char* documented(const std::string& head) {
  std::string text = head + "\n\nParameters\n----------\n";
  Options options;
  visit_options(options, [&](const OptionInfo& option, const auto& value, const auto&... choices) {
    text += std::string(option.name) + " : default " +
            nb::repr(detail::to_python(value, choices...)).c_str() + "\n    " + option.doc +
            detail::limits(option, value, choices...) + "\n";
  });
  return (new std::string(text))->c_str();
}

}  // namespace nvm::python
