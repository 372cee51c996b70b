// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/sequence/nvm_sequence_writer.hpp"

#include <fmt/format.h>

#include <cstring>

#include "io/sequence/trajectory_io.hpp"

namespace nvm::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRecordBytes = 24;

std::ofstream open_for_writing(const fs::path& path) {
  std::ofstream stream(path, std::ios::binary);
  if (!stream) {
    fail(path.string(), "cannot be written");
  }
  return stream;
}

void close(std::ofstream& stream, const fs::path& path) {
  stream.close();
  if (!stream) {
    fail(path.string(), "cannot be written; is the disk full?");
  }
}

void encode(const TimedPoint& point, char* record) {
  const float numbers[5] = {point.x, point.y, point.z, point.intensity, point.dt};
  const std::uint16_t ring_and_pad[2] = {point.ring, 0};
  std::memcpy(record, numbers, sizeof numbers);
  std::memcpy(record + sizeof numbers, ring_and_pad, sizeof ring_and_pad);
}

}  // namespace

NvmSequenceWriter::NvmSequenceWriter(const std::string& folder)
    : pending_(folder, PendingPath::Kind::kFolder), folder_(pending_.temporary()) {
  if (fs::exists(folder)) {
    fail(folder, "exists already");
  }
  std::error_code error;
  if (!fs::create_directory(folder_ / "scans", error)) {
    fail(folder, "cannot be made: " + error.message());
  }
  scan_list_ = open_for_writing(folder_ / "scans.csv");
  scan_list_ << "index,t_begin,t_end,file\n";
}

void NvmSequenceWriter::add_scan(const Scan& scan) {
  const std::string name = fmt::format("scans/{:06}.bin", scan_count_);
  std::string bytes(kRecordBytes * scan.points.size(), '\0');
  char* record = bytes.data();
  for (const TimedPoint& point : scan.points) {
    encode(point, record);
    record += kRecordBytes;
  }
  write_text(name, bytes);
  scan_list_ << fmt::format("{},{:.9f},{:.9f},{}\n", scan_count_, scan.t_begin, scan.t_end, name);
  ++scan_count_;
}

void NvmSequenceWriter::write_imu(const std::vector<ImuSample>& samples) {
  if (!imu_.is_open()) {
    imu_ = open_for_writing(folder_ / "imu.csv");
    imu_ << "t,gx,gy,gz,ax,ay,az\n";
  }
  for (const ImuSample& sample : samples) {
    imu_ << fmt::format(
        "{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n",
        sample.time,
        sample.gyro.x(),
        sample.gyro.y(),
        sample.gyro.z(),
        sample.accel.x(),
        sample.accel.y(),
        sample.accel.z());
  }
}

void NvmSequenceWriter::write_groundtruth(const Trajectory& T_world_imu) {
  write_tum((folder_ / "groundtruth.tum").string(), T_world_imu);
}

void NvmSequenceWriter::write_text(const std::string& name, const std::string& text) {
  const fs::path path = folder_ / name;
  std::ofstream stream = open_for_writing(path);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  close(stream, path);
}

void NvmSequenceWriter::commit() {
  close(scan_list_, folder_ / "scans.csv");
  if (imu_.is_open()) {
    close(imu_, folder_ / "imu.csv");
  }
  pending_.commit();
}

}  // namespace nvm::io
