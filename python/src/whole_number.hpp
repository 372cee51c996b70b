// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nanobind/nanobind.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace nvm::python {

/// The whole number that `given` is, to Python (numpy's too); nothing for another object, and for
/// one outside `min` to `max`.
inline std::optional<std::int64_t> whole_number(
    nanobind::handle given, std::int64_t min, std::int64_t max) {
  if (PyIndex_Check(given.ptr()) == 0) {
    return std::nullopt;
  }
  const nanobind::object index = nanobind::steal(PyNumber_Index(given.ptr()));
  int overflow = 0;
  const long long value =
      index.is_valid() ? PyLong_AsLongLongAndOverflow(index.ptr(), &overflow) : 0;
  if (!index.is_valid()) {
    PyErr_Clear();  // an array of several
  }
  const bool is_one = index.is_valid() && overflow == 0 && value >= min && value <= max;
  return is_one ? std::optional<std::int64_t>(value) : std::nullopt;
}

/// What is to be said of a number that is none from `min` to `max`.
inline std::string must_be_whole(std::int64_t min, std::int64_t max) {
  return "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
}

/// An argument of a call that is to be a whole number. Python refuses what is no number at all;
/// of() refuses the others, by name and range, which a C++ integer as argument does not tell.
struct Integer {
  nanobind::object given;

  /// Throws ValueError, naming the argument `name`, unless it is whole and from `min` to `max`.
  std::int64_t from(const char* name, std::int64_t min, std::int64_t max) const {
    const auto number = whole_number(given, min, max);
    if (!number) {
      const std::string message = std::string("nvm: ") + name + " = " +
                                  nanobind::repr(given).c_str() + " must be " +
                                  must_be_whole(min, max);
      throw nanobind::value_error(message.c_str());
    }
    return *number;
  }
};

}  // namespace nvm::python

template <>
struct nanobind::detail::type_caster<nvm::python::Integer> {
  NB_TYPE_CASTER(nvm::python::Integer, const_name("int"))

  bool from_python(handle source, std::uint8_t /*flags*/, cleanup_list* /*cleanup*/) noexcept {
    value.given = borrow(source);
    return PyNumber_Check(source.ptr()) != 0;
  }
  static handle from_cpp(
      const nvm::python::Integer& integer, rv_policy /*policy*/, cleanup_list* /*cleanup*/) {
    return integer.given.inc_ref();
  }
};
