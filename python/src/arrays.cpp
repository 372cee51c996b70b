// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "arrays.hpp"

#include <stdexcept>
#include <string>

namespace nvm::python {

namespace {

std::string text_of(nb::handle object) { return nb::str(object).c_str(); }

[[noreturn]] void refuse(const char* name, const std::string& problem) {
  throw nb::value_error(("nvm: " + std::string(name) + " " + problem).c_str());
}

/// `object` as a numpy array of float32 or float64 in this machine's byte order.
nb::object as_float_array(nb::handle object, const char* name) {
  const nb::object array = as_array(object, name);
  const nb::object dtype = array.attr("dtype");
  const std::string kind = text_of(dtype.attr("kind"));
  const std::string code = text_of(dtype.attr("char"));
  if (kind != "f" && kind != "i" && kind != "u") {
    refuse(name, "must be numbers, not of the type " + text_of(dtype));
  }
  const bool is_plain = (code == "f" || code == "d") && nb::cast<bool>(dtype.attr("isnative"));
  return is_plain ? array : nb::object(array.attr("astype")("float64"));
}

}  // namespace

nb::object as_array(nb::handle object, const char* name) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  if (nb::hasattr(object, "mask") && nb::cast<bool>(numpy.attr("ma").attr("is_masked")(object))) {
    refuse(name, "has masked elements: leave their rows out, or fill them with NaN");
  }
  try {
    return numpy.attr("asarray")(object);
  } catch (const nb::python_error& error) {
    refuse(name, "is no array of numbers: " + text_of(error.value()));
  }
}

ArrayView::ArrayView(nb::handle object, const char* name, int dimensions) {
  const nb::object array = as_float_array(object, name);
  const nb::object shape = array.attr("shape");
  const auto length = [&](int axis) { return nb::cast<std::size_t>(shape[axis]); };
  const bool fits =
      nb::len(shape) == static_cast<std::size_t>(dimensions) && (dimensions == 1 || length(1) == 3);
  const bool is_bare_list = nb::len(shape) == 1 && length(0) == 0;
  if (!fits && !is_bare_list) {
    refuse(
        name,
        std::string("must have the shape ") + (dimensions == 2 ? "(N, 3)" : "(N,)") + ", not " +
            text_of(shape));
  }
  size_ = length(0);
  if (PyObject_GetBuffer(array.ptr(), &buffer_, PyBUF_STRIDES | PyBUF_FORMAT) != 0) {
    throw nb::python_error();
  }
  data_ = static_cast<const char*>(buffer_.buf);
  for (int axis = 0; axis < dimensions && fits; ++axis) {
    strides_[axis] = buffer_.strides[axis];
  }
  is_double_ = buffer_.itemsize == sizeof(double);
}

ArrayView::~ArrayView() { PyBuffer_Release(&buffer_); }

void require_same_size(
    std::size_t size, const char* name, std::size_t reference_size, const char* reference) {
  if (size != reference_size) {
    refuse(
        name,
        "has " + std::to_string(size) + " rows, but " + reference + " has " +
            std::to_string(reference_size));
  }
}

Eigen::Vector3d vector_from(nb::handle object, const char* name) {
  const Numbers numbers(object, name);
  if (numbers.size() != 3) {
    refuse(name, "must have the shape (3,)");
  }
  const Eigen::Vector3d vector(numbers[0], numbers[1], numbers[2]);
  if (!vector.allFinite()) {
    refuse(name, "must be finite");
  }
  return vector;
}

std::string path_from(nb::handle object) {
  PyObject* encoded = nullptr;
  if (PyUnicode_FSConverter(object.ptr(), &encoded) == 0) {
    throw nb::python_error();
  }
  const auto path = nb::steal<nb::bytes>(encoded);
  return {path.c_str(), path.size()};
}

Pose pose_from(nb::handle object, const char* name) {
  Pose pose = Pose::Identity();
  if (object.is_none()) {
    return pose;
  }
  const nb::object array = as_array(object, name);
  if (text_of(array.attr("shape")) != "(4, 4)") {
    refuse(name, "must have the shape (4, 4), not " + text_of(array.attr("shape")));
  }
  const Numbers numbers(array.attr("reshape")(16), name);
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 16; ++i) {
    matrix(i / 4, i % 4) = numbers[static_cast<std::size_t>(i)];
  }
  pose.matrix() = matrix;
  const bool has_last_row = matrix.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
  if (!has_last_row || !is_rigid(pose)) {
    refuse(name, "must be rigid: finite, an orthonormal rotation, a last row 0 0 0 1");
  }
  return pose;
}

nb::object to_array(const Pose& pose) {
  std::vector<double> values(16);
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data()) = pose.matrix();
  return nb::cast(to_array(std::move(values), 4));
}

Array<float> to_array(const std::vector<Eigen::Vector3f>& vectors) {
  std::vector<float> values(3 * vectors.size());
  if (!vectors.empty()) {
    std::memcpy(values.data(), vectors.data(), values.size() * sizeof(float));
  }
  return to_array(std::move(values), 3);
}

}  // namespace nvm::python
