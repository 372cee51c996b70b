// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#include "sim/imu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/angles.hpp"

namespace nvm::sim {
namespace {

Eigen::Vector3d gaussian_vector(Random& random) {
  const double x = random.gaussian();
  const double y = random.gaussian();
  const double z = random.gaussian();
  return {x, y, z};
}

/// Three gyroscopes or accelerometers: reading = scale * turn * truth + bias + vibration + noise.
class Triad {
 public:
  Triad(const TriadNoise& noise, const ImuOptions& options, std::uint64_t seed, Stream stream)
      : noise_(noise), options_(options), random_(seed, stream, 0) {
    const double grade = options.grade;
    bias_ = grade * noise.initial_bias * gaussian_vector(random_);
    const Eigen::Vector3d scale =
        Eigen::Vector3d::Ones() + grade * noise.scale_error * gaussian_vector(random_);
    const double misalignment = grade * rad(noise.misalignment_deg);
    distortion_ = scale.asDiagonal() * so3_exp(misalignment * gaussian_vector(random_));
    Random direction(seed, stream, 1);
    vibration_ = grade * noise.vibration * gaussian_vector(direction).normalized();
  }

  Eigen::Vector3d read(const Eigen::Vector3d& truth, double time) {
    const double rate = options_.rate;
    const double phase = 2.0 * M_PI * options_.vibration_frequency * time;
    const double white = options_.grade * noise_.noise_density * std::sqrt(rate);
    const double walk = options_.grade * noise_.bias_walk / std::sqrt(rate);
    const Eigen::Vector3d reading = distortion_ * truth + bias_ + std::sin(phase) * vibration_ +
                                    white * gaussian_vector(random_);
    bias_ += walk * gaussian_vector(random_);
    return reading;
  }

 private:
  TriadNoise noise_;
  ImuOptions options_;
  Random random_;
  Eigen::Vector3d bias_;
  Eigen::Vector3d vibration_;
  Eigen::Matrix3d distortion_;
};

/// Stamps that are late and unsteady, but in order.
class Clock {
 public:
  Clock(const ImuOptions& options, std::uint64_t seed)
      : options_(options), random_(seed, Stream::kImuClock, 0) {}

  double stamp(double time) {
    constexpr double kLeastStep = 1e-6;  // [s]
    const double stamp = time + options_.clock_offset + options_.clock_jitter * random_.gaussian();
    last_ = std::max(stamp, last_ + kLeastStep);
    return last_;
  }

 private:
  ImuOptions options_;
  Random random_;
  double last_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<ImuSample> simulate_imu(
    const Motion& motion, const ImuOptions& options, std::uint64_t seed) {
  Triad gyro(options.gyro, options, seed, Stream::kGyro);
  Triad accelerometer(options.accelerometer, options, seed, Stream::kAccelerometer);
  Clock clock(options, seed);
  const Eigen::Vector3d gravity(0.0, 0.0, -options.gravity);
  const auto count = static_cast<std::size_t>(std::floor(motion.duration() * options.rate)) + 1;
  std::vector<ImuSample> samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double time = static_cast<double>(i) / options.rate;
    const Kinematics truth = motion.kinematics(time);
    const Eigen::Vector3d specific_force =
        truth.T_world_imu.linear().transpose() * (truth.acceleration - gravity);
    samples.push_back(
        {clock.stamp(time),
         gyro.read(truth.angular_velocity, time),
         accelerometer.read(specific_force, time)});
  }
  return samples;
}

}  // namespace nvm::sim
