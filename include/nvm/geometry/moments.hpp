// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_GEOMETRY_MOMENTS_HPP  // a kernel: nvm/core/target.hpp
#define NVM_GEOMETRY_MOMENTS_HPP

#include "nvm/core/target.hpp"

NVM_BEGIN_KERNELS

/// A symmetric 3x3 matrix. `Real` is float, double or FloatLanes (one matrix per lane).
template <class Real>
struct Symmetric3 {
  Real xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
};

/// Number, sum and sum of outer products of points: all that their covariance needs.
///
/// Give points relative to something near them (the query, the first point), or the covariance
/// cancels. Zero when default-constructed.
template <class Real>
struct Moments {
  Real count{};
  Real x{}, y{}, z{};
  Real xx{}, xy{}, xz{}, yy{}, yz{}, zz{};

  /// Adds a point that counts `weight` times: (x, y, z) must be zero where the weight is.
  void add(const Real& weight, const Real& px, const Real& py, const Real& pz) {
    count += weight;
    x += px;
    y += py;
    z += pz;
    xx += px * px;
    xy += px * py;
    xz += px * pz;
    yy += py * py;
    yz += py * pz;
    zz += pz * pz;
  }
};

/// Sum of (p - mean)(p - mean)^T: the covariance times the number of points. Needs count > 0.
template <class Real>
Symmetric3<Real> scatter(const Moments<Real>& m) {
  const Real share = 1.0F / m.count;
  const Real mean_x = share * m.x;
  const Real mean_y = share * m.y;
  const Real mean_z = share * m.z;
  return {
      m.xx - m.x * mean_x,
      m.xy - m.x * mean_y,
      m.xz - m.x * mean_z,
      m.yy - m.y * mean_y,
      m.yz - m.y * mean_z,
      m.zz - m.z * mean_z};
}

NVM_END_KERNELS

#endif  // NVM_GEOMETRY_MOMENTS_HPP
