// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "io/result/session_file.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "temporary_folder.hpp"

namespace nvm::io {
namespace {

using ::testing::HasSubstr;

class SessionFileTest : public test::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    SessionWriter writer(path("session"));
    for (int k = 0; k < 3; ++k) {
      writer.add(keyframe(k));
    }
    writer.finish({123'456'789'012, 0xfedcba98U});
    std::ostringstream text;
    text << std::ifstream(path("session"), std::ios::binary).rdbuf();
    bytes_ = text.str();
  }

  static Keyframe keyframe(int k) {
    Keyframe keyframe;
    keyframe.time = 1.7e9 + 0.1 * k;
    keyframe.T_map_lidar.linear() = so3_exp({0.1, -0.2, 0.7 * k});
    keyframe.T_map_lidar.translation() << 1.0 * k, -2.0, 0.3;
    for (int i = 0; i < 5 * k; ++i) {
      keyframe.points.emplace_back(0.5F * static_cast<float>(i), -1.0F, 2.0F);
      keyframe.normals.push_back(Eigen::Vector3f(1.0F, static_cast<float>(i), -1.0F).normalized());
    }
    return keyframe;
  }

  std::size_t read(const std::string& name) const {
    SessionReader reader(path(name));
    std::size_t count = 0;
    while (reader.next()) {
      ++count;
    }
    return count;
  }

  std::string error_of(const std::string& bytes) const {
    write("damaged", bytes);
    return test::runtime_error_of([&] { read("damaged"); });
  }

  std::string bytes_;
};

TEST_F(SessionFileTest, ReadsWhatWasWritten) {
  SessionReader reader(path("session"));
  for (int k = 0; k < 3; ++k) {
    const std::optional<Keyframe> found = reader.next();
    ASSERT_TRUE(found);
    const Keyframe truth = keyframe(k);
    EXPECT_EQ(found->time, truth.time);
    EXPECT_TRUE(found->T_map_lidar.isApprox(truth.T_map_lidar, 1e-12));
    EXPECT_EQ(found->points, truth.points);
    ASSERT_EQ(found->normals.size(), truth.normals.size());
    for (std::size_t i = 0; i < truth.normals.size(); ++i) {
      EXPECT_LT((found->normals[i] - truth.normals[i]).norm(), 1e-4F);
    }
  }
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.map().bytes, 123'456'789'012U);
  EXPECT_EQ(reader.map().checksum, 0xfedcba98U);
}

TEST_F(SessionFileTest, RefusesATruncatedFileWhereverItEnds) {
  for (std::size_t size = 0; size < bytes_.size(); size += 7) {
    EXPECT_THAT(error_of(bytes_.substr(0, size)), HasSubstr("damaged: is ")) << size;
  }
}

TEST_F(SessionFileTest, RefusesAFileWithAnyByteChanged) {
  for (std::size_t i = 0; i < bytes_.size(); i += 5) {
    std::string damaged = bytes_;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x20);
    EXPECT_THAT(error_of(damaged), HasSubstr("damaged: is ")) << i;
  }
}

TEST_F(SessionFileTest, RefusesWhatFollowsTheEndAndNewerFormats) {
  EXPECT_THAT(error_of(bytes_ + "x"), HasSubstr("does not end where it should"));
  std::string newer = bytes_;
  newer[8] = 2;
  EXPECT_THAT(error_of(newer), HasSubstr("a session of format 2, and this nvm reads 1"));
}

}  // namespace
}  // namespace nvm::io
