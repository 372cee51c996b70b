// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
//
// usage: make_ros_bag SEQUENCE TYPE BAG
//
// Writes an nvm sequence as a ROS 1 bag whose clouds are of TYPE (cloud, livox or livox2), a
// thousand seconds later: time 0 has a meaning of its own in ROS.
#include <cstdio>
#include <exception>
#include <string>

#include "io/message/ros_bag_writer.hpp"
#include "io/sequence/sequence_reader.hpp"

namespace {

using nvm::io::CloudMessageType;

constexpr double kLater = 1000.0;  // [s]

void convert(const std::string& sequence, const std::string& type, const std::string& bag) {
  const auto reader = nvm::io::open_sequence(sequence);
  nvm::io::RosBagWriter writer(
      bag,
      type == "livox"    ? CloudMessageType::kLivoxCustom
      : type == "livox2" ? CloudMessageType::kLivox2Custom
                         : CloudMessageType::kPointCloud2);
  while (auto scan = reader->next_scan()) {
    for (nvm::ImuSample sample : reader->imu_until(scan->t_end)) {
      sample.time += kLater;
      writer.add_imu(sample);
    }
    scan->t_begin += kLater;
    scan->t_end += kLater;
    writer.add_scan(*scan);
  }
  writer.commit();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: make_ros_bag SEQUENCE TYPE BAG\n", stderr);
    return 2;
  }
  try {
    convert(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_ros_bag: %s\n", error.what());
    return 1;
  }
  return 0;
}
