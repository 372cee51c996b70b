// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/cloud/kitti.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "io/file/file.hpp"

namespace nvm::io {
namespace {

constexpr std::size_t kMaxFields = 6;
constexpr std::size_t kSequenceRecord = 24;  // [bytes]

float float_at(const std::string& bytes, std::size_t index) {
  float value = 0.0F;
  std::memcpy(&value, &bytes[index * sizeof(float)], sizeof(float));
  return value;
}

/// The numbers of one field of some of the points.
std::vector<float> column(const std::string& bytes, std::size_t fields, std::size_t field) {
  constexpr std::size_t kSample = 2000;
  const std::size_t size = bytes.size() / sizeof(float) / fields;
  const std::size_t step = size / kSample + 1;
  std::vector<float> values;
  for (std::size_t i = 0; i < size; i += step) {
    values.push_back(float_at(bytes, i * fields + field));
  }
  return values;
}

/// How much the numbers of a field differ, on a scale that huge ones do not dominate. Numbers that
/// are none differ much.
double variance(const std::vector<float>& values) {
  double sum = 0.0;
  double sum_sq = 0.0;
  for (const float value : values) {
    const double scaled = std::isfinite(value) ? std::asinh(static_cast<double>(value)) : 100.0;
    sum += scaled;
    sum_sq += scaled * scaled;
  }
  const double n = static_cast<double>(std::max<std::size_t>(values.size(), 1));
  return sum_sq / n - (sum / n) * (sum / n);
}

/// The mean logarithm of the variances of the fields: with a wrong number of fields, each holds
/// numbers of several, and the mean grows.
double disorder(const std::string& bytes, std::size_t fields) {
  constexpr double kLeast = 1e-4;  // of fields that are constant
  double sum = 0.0;
  for (std::size_t field = 0; field < fields; ++field) {
    sum += std::log(variance(column(bytes, fields, field)) + kLeast);
  }
  return sum / static_cast<double>(fields);
}

/// The number of fields that fits the numbers; 4 unless another fits clearly better.
std::size_t likely_fields(const std::string& bytes) {
  constexpr double kClearly = 0.2;
  constexpr std::size_t kFewPoints = 20;
  const auto fits = [&](std::size_t fields) {
    return bytes.size() % (fields * sizeof(float)) == 0;
  };
  std::size_t best = 4;
  if (bytes.size() < kFewPoints * kMaxFields * sizeof(float)) {
    return best;
  }
  double least = fits(best) ? disorder(bytes, best) : HUGE_VAL;
  for (const std::size_t fields : {3U, 5U, 6U}) {
    const double found = fits(fields) ? disorder(bytes, fields) : HUGE_VAL;
    if (found < least - kClearly) {
      best = fields;
      least = found;
    }
  }
  return best;
}

/// Whether the records are those of an nvm sequence: times ascend, and the padding is zero.
bool is_sequence_scan(const std::string& bytes) {
  constexpr std::size_t kPadding = 22;
  constexpr std::size_t kTime = 4;
  if (bytes.empty() || bytes.size() % kSequenceRecord != 0) {
    return false;
  }
  float previous = -1.0F;
  for (std::size_t at = 0; at < bytes.size(); at += kSequenceRecord) {
    const float time = float_at(bytes, at / sizeof(float) + kTime);
    if (bytes[at + kPadding] != '\0' || bytes[at + kPadding + 1] != '\0' || !(time >= previous) ||
        time > 100.0F) {
      return false;
    }
    previous = std::max(time, 0.0F);
  }
  // Zeros throughout are no ring and no padding, but numbers.
  return previous > 0.0F;
}

/// Whether a field holds the numbers of beams.
bool is_ring(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float value) {
    return value >= 0.0F && value < 1024.0F && value == std::floor(value);
  });
}

}  // namespace

PointRecords read_kitti_points(const std::string& path, std::size_t fields) {
  PointRecords records;
  records.source = path;
  records.bytes = read_file(path);
  const std::string& bytes = records.bytes;
  if (fields == 0 && is_sequence_scan(bytes)) {
    for (const char* name : {"x", "y", "z", "intensity", "time"}) {
      records.add_field(name, ScalarType::kFloat32);
    }
    records.add_field("ring", ScalarType::kUint16, 2);
  } else {
    fields = fields == 0 ? likely_fields(bytes) : fields;
    constexpr std::array<const char*, 4> kNames = {"x", "y", "z", "intensity"};
    for (std::size_t i = 0; i < fields; ++i) {
      const bool is_known = i < kNames.size();
      const bool is_beam =
          !is_known && is_ring(column(bytes, fields, i)) && records.find({"ring"}) == nullptr;
      records.add_field(is_known ? kNames[i] : (is_beam ? "ring" : "time"), ScalarType::kFloat32);
    }
  }
  records.size = bytes.size() / records.record_size;
  if (records.size * records.record_size != bytes.size()) {
    fail(
        path,
        std::to_string(bytes.size()) + " bytes are no whole number of " +
            std::to_string(records.record_size) +
            "-byte points: truncated, or not of 3 to 6 float32 a point (input.bin_fields)");
  }
  return records;
}

}  // namespace nvm::io
