// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/imu.hpp"

#include <cmath>

#include "sim/angles.hpp"

namespace nvm::sim {
namespace {

/// Three gyroscopes or accelerometers: reading = scale * turn * truth + bias + noise.
class Triad {
 public:
  Triad(const TriadNoise& noise, double rate, std::uint64_t seed, Stream stream)
      : noise_(noise), rate_(rate), random_(seed, stream, 0) {
    bias_ = noise.initial_bias * gaussian_vector();
    const Eigen::Vector3d scale = Eigen::Vector3d::Ones() + noise.scale_error * gaussian_vector();
    const double misalignment = rad(noise.misalignment_deg);
    distortion_ = scale.asDiagonal() * so3_exp(misalignment * gaussian_vector());
  }

  Eigen::Vector3d read(const Eigen::Vector3d& truth) {
    const Eigen::Vector3d reading =
        distortion_ * truth + bias_ + noise_.noise_density * std::sqrt(rate_) * gaussian_vector();
    bias_ += noise_.bias_walk / std::sqrt(rate_) * gaussian_vector();
    return reading;
  }

 private:
  Eigen::Vector3d gaussian_vector() {
    const double x = random_.gaussian();
    const double y = random_.gaussian();
    const double z = random_.gaussian();
    return {x, y, z};
  }

  TriadNoise noise_;
  double rate_;
  Random random_;
  Eigen::Vector3d bias_;
  Eigen::Matrix3d distortion_;
};

}  // namespace

std::vector<lio::ImuSample> simulate_imu(
    const Motion& motion, const ImuOptions& options, std::uint64_t seed) {
  Triad gyro(options.gyro, options.rate, seed, Stream::kGyro);
  Triad accelerometer(options.accelerometer, options.rate, seed, Stream::kAccelerometer);
  const Eigen::Vector3d gravity(0.0, 0.0, -options.gravity);
  const auto count = static_cast<std::size_t>(std::floor(motion.duration() * options.rate)) + 1;
  std::vector<lio::ImuSample> samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double time = static_cast<double>(i) / options.rate;
    const Kinematics truth = motion.kinematics(time);
    const Eigen::Vector3d specific_force =
        truth.T_world_imu.linear().transpose() * (truth.acceleration - gravity);
    samples.push_back(
        {time, gyro.read(truth.angular_velocity), accelerometer.read(specific_force)});
  }
  return samples;
}

}  // namespace nvm::sim
