// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nvm/geometry/pose.hpp"

namespace nvm::python {

namespace nb = nanobind;

/// Whatever numpy makes of `object`. Throws ValueError, naming it `name`, for what is no array, and
/// for masked elements, whose mask numpy would drop.
nb::object as_array(nb::handle object, const char* name);

/// An array of float32 or float64 with any strides, negative ones too, read where it lies. Whatever
/// else numpy can make an array of numbers of is converted first. Construct and destroy it with the
/// GIL held; it may be read without.
class ArrayView {
 public:
  /// Throws ValueError, naming the array `name`, for anything but numbers in `dimensions` (1 or 2)
  /// dimensions, the second of which has 3 elements. Anything without elements is empty.
  ArrayView(nb::handle object, const char* name, int dimensions);
  ~ArrayView();
  ArrayView(const ArrayView&) = delete;
  ArrayView& operator=(const ArrayView&) = delete;

  std::size_t size() const { return size_; }
  bool is_double() const { return is_double_; }

  double value(std::size_t row, std::size_t column = 0) const {
    const char* at = data_ + static_cast<std::ptrdiff_t>(row) * strides_[0] +
                     static_cast<std::ptrdiff_t>(column) * strides_[1];
    return is_double_ ? load<double>(at) : static_cast<double>(load<float>(at));
  }

 private:
  template <class T>
  static T load(const char* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));  // numpy's records may be packed
    return value;
  }

  Py_buffer buffer_{};
  const char* data_ = nullptr;
  std::size_t size_ = 0;
  std::ptrdiff_t strides_[2] = {0, 0};  ///< [bytes]
  bool is_double_ = false;
};

/// (N, 3): a range of points or normals for the templates of nvm.
class Vectors : public ArrayView {
 public:
  Vectors(nb::handle object, const char* name) : ArrayView(object, name, 2) {}

  Eigen::Vector3d operator[](std::size_t i) const {
    return {value(i, 0), value(i, 1), value(i, 2)};
  }
};

/// (N,): a range of numbers.
class Numbers : public ArrayView {
 public:
  Numbers(nb::handle object, const char* name) : ArrayView(object, name, 1) {}

  double operator[](std::size_t i) const { return value(i); }
};

/// Throws ValueError unless there are as many of `name` as of `reference`.
void require_same_size(
    std::size_t size, const char* name, std::size_t reference_size, const char* reference);

/// Three finite numbers. Throws ValueError.
Eigen::Vector3d vector_from(nb::handle object, const char* name);

/// A path of a str, bytes or os.PathLike. Throws TypeError for another object, ValueError for a
/// path with a NUL.
std::string path_from(nb::handle object);

/// A pose of an array (4, 4), the identity of None. Throws ValueError unless it is finite and
/// rigid.
Pose pose_from(nb::handle object, const char* name);

/// The (4, 4) array of a pose.
nb::object to_array(const Pose& pose);

template <class T>
using Array = nb::ndarray<nb::numpy, T>;

/// An array that owns `values`, `columns` in a row; 0: of one dimension.
template <class T>
Array<T> to_array(std::vector<T> values, std::size_t columns = 0) {
  auto* kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  if (columns == 0) {
    return Array<T>(kept->data(), {kept->size()}, owner);
  }
  return Array<T>(kept->data(), {kept->size() / columns, columns}, owner);
}

/// An array of `rows` that owns `values`, `columns` in a row; 0: of one dimension.
template <class T>
Array<T> to_array(std::unique_ptr<T[]> values, std::size_t rows, std::size_t columns = 0) {
  T* const kept = values.release();
  const nb::capsule owner(kept, [](void* p) noexcept { delete[] static_cast<T*>(p); });
  return columns == 0 ? Array<T>(kept, {rows}, owner) : Array<T>(kept, {rows, columns}, owner);
}

/// The array (N, 3) of 3-vectors.
Array<float> to_array(const std::vector<Eigen::Vector3f>& vectors);

}  // namespace nvm::python
