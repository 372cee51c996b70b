// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/scan/scan_stream.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bind.hpp"
#include "config/schema.hpp"
#include "io/message/message_topics.hpp"
#include "io/message/ros_messages.hpp"
#include "io/sequence/sequence_options.hpp"
#include "scan_stream_docs.hpp"
#include "settings.hpp"

namespace nvm::python {

namespace {

using namespace nb::literals;

io::SequenceOptions input_from(const nb::object& settings) {
  io::SequenceOptions options;
  config::Schema schema;
  io::bind(schema, options);
  if (!settings.is_none()) {
    schema.read_text(as_json(settings), "input");
  }
  return options;
}

/// The bytes of an object, read where they lie.
class Bytes {
 public:
  explicit Bytes(nb::handle object) {
    if (PyObject_GetBuffer(object.ptr(), &buffer_, PyBUF_SIMPLE) != 0) {
      PyErr_Clear();
      throw std::invalid_argument("nvm: a message must be bytes");
    }
  }
  ~Bytes() { PyBuffer_Release(&buffer_); }
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;

  std::string_view view() const {
    return {static_cast<const char*>(buffer_.buf), static_cast<std::size_t>(buffer_.len)};
  }

 private:
  Py_buffer buffer_{};
};

io::CloudMessage read(nb::handle message, std::string type) {
  if (const auto middle = type.find("/msg/"); middle != std::string::npos) {
    type.erase(middle, 4);  // as ROS 2 names it
  }
  if (!io::is_cloud(type)) {
    throw std::invalid_argument("nvm: " + type + " is no type of clouds that nvm reads");
  }
  const Bytes bytes(message);
  return io::is_livox(type) ? io::read_livox_custom(bytes.view())
                            : io::read_point_cloud2(bytes.view());
}

class ScanStream {
 public:
  explicit ScanStream(const nb::object& input)
      : stream_(io::message_time_options(input_from(input))) {}

  std::size_t learn(const std::vector<nb::object>& messages, const std::string& type) {
    std::vector<io::CloudMessage> clouds;
    for (const nb::object& message : messages) {
      try {
        clouds.push_back(read(message, type));
      } catch (const std::runtime_error&) {
        continue;  // convert() tells it
      }
    }
    clouds = io::ScanStream::select(std::move(clouds));
    if (!clouds.empty()) {
      stream_.learn(clouds);
    }
    return clouds.size();
  }

  Scan convert(nb::handle message, const std::string& type) {
    const io::CloudMessage cloud = read(message, type);
    stream_.check(cloud);
    return stream_.convert(cloud.records, cloud.stamp);
  }

  std::vector<std::string> notes() const { return stream_.notes(); }
  std::vector<std::string> findings() const { return stream_.findings(); }

 private:
  io::ScanStream stream_;
};

template <class Value, class Member>
std::vector<Value> column(const Scan& scan, const Member& member) {
  std::vector<Value> values;
  values.reserve(scan.points.size());
  for (const TimedPoint& point : scan.points) {
    values.push_back(member(point));
  }
  return values;
}

void bind_scan(nb::module_& module) {
  nb::class_<Scan>(module, "Scan", kRawScanDoc)
      .def_ro("begin", &Scan::t_begin)
      .def_ro("end", &Scan::t_end)
      .def("__len__", [](const Scan& scan) { return scan.points.size(); })
      .def_prop_ro(
          "points",
          [](const Scan& scan) {
            return nb::cast(to_array(column<Eigen::Vector3f>(scan, [](const TimedPoint& point) {
              return Eigen::Vector3f(point.x, point.y, point.z);
            })));
          })
      .def_prop_ro("times", [](const Scan& scan) {
        return nb::cast(to_array(column<double>(
            scan, [&](const TimedPoint& point) { return scan.t_begin + double{point.dt}; })));
      });
}

}  // namespace

void bind_scan_stream(nb::module_& module) {
  bind_scan(module);
  constexpr const char* kCloudType = "sensor_msgs/PointCloud2";
  nb::class_<ScanStream>(module, "ScanStream", kScanStreamDoc)
      .def(nb::init<const nb::object&>(), "input"_a = nb::none())
      .def("learn", &ScanStream::learn, "messages"_a, "type"_a = kCloudType, kLearnDoc)
      .def("convert", &ScanStream::convert, "message"_a, "type"_a = kCloudType, kConvertDoc)
      .def("notes", &ScanStream::notes, kNotesDoc)
      .def("findings", &ScanStream::findings, kScanFindingsDoc);
}

}  // namespace nvm::python
