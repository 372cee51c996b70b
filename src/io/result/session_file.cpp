// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/result/session_file.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "io/file/file.hpp"
#include "nvm/map/storage/byte_stream.hpp"

namespace nvm::io {

namespace {

constexpr char kSessionMagic[8] = {'N', 'V', 'M', 'S', 'E', 'S', 'S', '\n'};
constexpr std::uint32_t kVersion = 1;
constexpr float kNormalScale = 32767.0F;
constexpr std::uint32_t kMostBytes = 1U << 28;  // of a keyframe
constexpr std::size_t kEndBytes = 16;           // fewer than a keyframe has
constexpr std::size_t kPointBytes = 3 * sizeof(float) + 3 * sizeof(std::int16_t);

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

std::uint32_t checksum(const std::string& bytes) {
  return detail::crc32(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// `payload` behind its size and checksum.
std::string record(const std::string& payload) {
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(payload.size()));
  append(bytes, checksum(payload));
  return bytes + payload;
}

std::string encode(const Keyframe& keyframe) {
  std::string bytes;
  append(bytes, keyframe.time);
  const Eigen::Vector3d p = keyframe.T_map_lidar.translation();
  const Eigen::Quaterniond q(keyframe.T_map_lidar.linear());
  for (const double number : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) {
    append(bytes, number);
  }
  append(bytes, static_cast<std::uint32_t>(keyframe.points.size()));
  for (std::size_t i = 0; i < keyframe.points.size(); ++i) {
    for (const float coordinate : keyframe.points[i]) {
      append(bytes, coordinate);
    }
    for (const float component : keyframe.normals[i]) {
      append(bytes, static_cast<std::int16_t>(std::lround(kNormalScale * component)));
    }
  }
  return bytes;
}

Pose decode_pose(ByteCursor& bytes) {
  std::array<double, 7> n{};
  for (double& number : n) {
    number = bytes.next<double>();
  }
  Pose pose = Pose::Identity();
  pose.translation() << n[0], n[1], n[2];
  pose.linear() = Eigen::Quaterniond(n[6], n[3], n[4], n[5]).toRotationMatrix();
  if (!is_rigid(pose)) {
    throw std::runtime_error("is corrupt: a pose is none");
  }
  return pose;
}

Keyframe decode(ByteCursor bytes) {
  Keyframe keyframe;
  keyframe.time = bytes.next<double>();
  keyframe.T_map_lidar = decode_pose(bytes);
  const auto count = bytes.next<std::uint32_t>();
  if (bytes.left() != count * kPointBytes) {
    throw std::runtime_error("is corrupt: the number of points is wrong");
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    Eigen::Vector3f point;
    Eigen::Vector3f normal;
    for (float& coordinate : point) {
      coordinate = bytes.next<float>();
    }
    for (float& component : normal) {
      component = static_cast<float>(bytes.next<std::int16_t>()) / kNormalScale;
    }
    if (!point.allFinite() || normal.isZero()) {
      throw std::runtime_error("is corrupt: a point is none");
    }
    keyframe.points.push_back(point);
    keyframe.normals.push_back(normal.normalized());
  }
  return keyframe;
}

}  // namespace

MapStamp stamp_of(const std::string& map) {
  MapStamp stamp;
  std::ifstream stream = open_to_read(map);
  stream.seekg(0, std::ios::end);
  stamp.bytes = static_cast<std::uint64_t>(stream.tellg());
  stream.seekg(-static_cast<std::streamoff>(sizeof stamp.checksum), std::ios::end);
  if (!stream.read(reinterpret_cast<char*>(&stamp.checksum), sizeof stamp.checksum)) {
    fail(map, "is too short for an nvm map");
  }
  return stamp;
}

SessionWriter::SessionWriter(const std::string& path)
    : path_(path), stream_(path, std::ios::binary) {
  std::string head(kSessionMagic, sizeof kSessionMagic);
  append(head, kVersion);
  put(head);
}

void SessionWriter::add(const Keyframe& keyframe) {
  put(record(encode(keyframe)));
  ++count_;
}

void SessionWriter::finish(const MapStamp& map) {
  std::string end;
  append(end, count_);
  append(end, map.bytes);
  append(end, map.checksum);
  put(record(end));
  stream_.close();
  if (!stream_) {
    fail(path_, "cannot be written; is the disk full?");
  }
}

void SessionWriter::put(const std::string& bytes) {
  if (!stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    fail(path_, "cannot be written; is the disk full?");
  }
}

SessionReader::SessionReader(const std::string& path) : path_(path), stream_(open_to_read(path)) {
  char magic[sizeof kSessionMagic] = {};
  std::uint32_t version = 0;
  stream_.read(magic, sizeof magic);
  stream_.read(reinterpret_cast<char*>(&version), sizeof version);
  if (!stream_ || std::memcmp(magic, kSessionMagic, sizeof magic) != 0) {
    fail(path_, "is not a session of nvm run");
  }
  if (version != kVersion) {
    fail(path_, "is a session of format " + std::to_string(version) + ", and this nvm reads 1");
  }
}

std::optional<Keyframe> SessionReader::next() {
  const std::string head = take(2 * sizeof(std::uint32_t));
  ByteCursor cursor(head);
  const auto size = cursor.next<std::uint32_t>();
  const auto sum = cursor.next<std::uint32_t>();
  if (size > kMostBytes) {
    fail(path_, "is corrupt: a keyframe is too large");
  }
  const std::string payload = take(size);
  if (checksum(payload) != sum) {
    fail(path_, "is corrupt: a checksum is wrong");
  }
  if (size == kEndBytes) {
    finish(ByteCursor(payload));
    return std::nullopt;
  }
  ++count_;
  try {
    return decode(ByteCursor(payload));
  } catch (const std::runtime_error& error) {
    fail(path_, error.what());
  }
}

void SessionReader::finish(ByteCursor end) {
  const auto count = end.next<std::uint32_t>();
  map_.bytes = end.next<std::uint64_t>();
  map_.checksum = end.next<std::uint32_t>();
  if (count != count_ || stream_.peek() != std::ifstream::traits_type::eof()) {
    fail(path_, "is corrupt: it does not end where it should");
  }
}

std::string SessionReader::take(std::size_t size) {
  std::string bytes;
  constexpr std::size_t kBlock = std::size_t{1} << 20;  // so that a wrong size takes no memory
  while (bytes.size() < size) {
    const std::size_t begin = bytes.size();
    bytes.resize(std::min(size, begin + kBlock));
    if (!stream_.read(&bytes[begin], static_cast<std::streamsize>(bytes.size() - begin))) {
      fail(path_, "is truncated: the run that wrote it, or a copy, was not finished");
    }
  }
  return bytes;
}

}  // namespace nvm::io
