// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#ifndef NVM_GEOMETRY_SYMMETRIC_EIGEN_HPP  // a kernel: nvm/core/target.hpp
#define NVM_GEOMETRY_SYMMETRIC_EIGEN_HPP

#include <Eigen/Core>
#include <type_traits>

#include "nvm/core/target.hpp"
#include "nvm/geometry/eigen3.hpp"
#include "nvm/geometry/float_lanes.hpp"
#include "nvm/geometry/moments.hpp"

NVM_BEGIN_DETAIL_KERNELS

template <class Real>
Real dot(const Vector3Of<Real>& a, const Vector3Of<Real>& b) {
  return multiply_add<Real>(a.z, b.z, multiply_add<Real>(a.y, b.y, a.x * b.x));
}

/// a b + c d.
template <class Real>
Real sum_of_products(const Real& a, const Real& b, const Real& c, const Real& d) {
  return multiply_add<Real>(a, b, c * d);
}

template <class Real>
Vector3Of<Real> cross(const Vector3Of<Real>& a, const Vector3Of<Real>& b) {
  return {
      sum_of_products<Real>(a.y, b.z, -a.z, b.y),
      sum_of_products<Real>(a.z, b.x, -a.x, b.z),
      sum_of_products<Real>(a.x, b.y, -a.y, b.x)};
}

/// a u + b v.
template <class Real>
Vector3Of<Real> combine(
    const Real& a, const Vector3Of<Real>& u, const Real& b, const Vector3Of<Real>& v) {
  return {
      sum_of_products(a, u.x, b, v.x),
      sum_of_products(a, u.y, b, v.y),
      sum_of_products(a, u.z, b, v.z)};
}

template <class Real, class Mask>
Vector3Of<Real> select(const Mask& mask, const Vector3Of<Real>& a, const Vector3Of<Real>& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

template <class Real>
struct Rows {
  Vector3Of<Real> x, y, z;
};

template <class Real>
Rows<Real> rows(const Symmetric3<Real>& m) {
  return {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
}

template <class Real>
Vector3Of<Real> times(const Symmetric3<Real>& m, const Vector3Of<Real>& v) {
  const Rows<Real> row = rows(m);
  return {dot(row.x, v), dot(row.y, v), dot(row.z, v)};
}

template <class Real>
Real determinant(const Symmetric3<Real>& m) {
  const Rows<Real> row = rows(m);
  return dot(row.x, cross(row.y, row.z));
}

template <class Real>
Symmetric3<Real> scaled(const Symmetric3<Real>& m, const Real& s) {
  return {m.xx * s, m.xy * s, m.xz * s, m.yy * s, m.yz * s, m.zz * s};
}

template <class Real>
Symmetric3<Real> shifted(const Symmetric3<Real>& m, const Real& diagonal) {
  return {m.xx - diagonal, m.xy, m.xz, m.yy - diagonal, m.yz, m.zz - diagonal};
}

template <class Real>
Real max_abs(const Symmetric3<Real>& m) {
  return larger(
      larger(larger(absolute(m.xx), absolute(m.yy)), absolute(m.zz)),
      larger(larger(absolute(m.xy), absolute(m.xz)), absolute(m.yz)));
}

/// matrix = mean I + spread * unit, where `unit` has trace 0 and eigenvalues 2 cos(phi + 2 pi k/3).
template <class Real>
struct Deviator {
  Symmetric3<Real> unit;
  Real mean, spread;
};

template <class Real>
Real third_of_trace(const Symmetric3<Real>& m) {
  return (m.xx + m.yy + m.zz) / constant<Real>(3.0);  // a product could be fused with what follows
}

template <class Real>
Deviator<Real> deviator(const Symmetric3<Real>& m) {
  // In two steps, because close to a multiple of I the rounding of the mean is all that is left.
  const Real mean = third_of_trace(m);
  const Symmetric3<Real> almost = shifted(m, mean);
  const Real correction = third_of_trace(almost);
  const Symmetric3<Real> exact = shifted(almost, correction);

  const Real size = max_abs(exact);
  const Real scale = size > Real{} ? size : constant<Real>(1.0);
  const Symmetric3<Real> b = scaled<Real>(exact, 1.0F / scale);
  const Vector3Of<Real> diagonal{b.xx, b.yy, b.zz}, rest{b.xy, b.xz, b.yz};
  const Real half_sq_norm =
      multiply_add<Real>(constant<Real>(0.5), dot(diagonal, diagonal), dot(rest, rest));
  const Real sq_spread = half_sq_norm * constant<Real>(1.0 / 3.0);
  const Real unspread = inverse_sqrt(sq_spread);
  return {scaled(b, unspread), mean + correction, sq_spread * unspread * scale};
}

/// The largest root of x^3 - 3x - 2r for r in [0, 1]: 2 cos(acos(r)/3), by Newton's method. The
/// start, a fitted parabola, is off by at most 1.1e-3, then by 8e-7, 5e-13 and 2e-25.
template <class Real>
Real isolated_root(const Real& r) {
  const Real slope = multiply_add<Real>(constant<Real>(-0.0531376), r, constant<Real>(0.3191803));
  Real x = multiply_add<Real>(slope, r, constant<Real>(1.7331223));
  constexpr int kSteps = std::is_same_v<Real, double> ? 3 : 2;
  for (int step = 0; step < kSteps; ++step) {
    const Real sq_x = x * x;
    x = multiply_add<Real>(x, sq_x, r) / (1.5F * (sq_x - 1.0F));
  }
  return x;
}

/// Unit vector that m maps to zero, for a matrix of rank 2: its rows span the plane that the vector
/// is orthogonal to, and of the three pairs of rows the one with the largest product is used.
template <class Real>
Vector3Of<Real> null_vector(const Symmetric3<Real>& m) {
  const Rows<Real> row = rows(m);
  const Vector3Of<Real> a = cross(row.x, row.y), b = cross(row.x, row.z), c = cross(row.y, row.z);
  const Real sq_a = dot(a, a), sq_b = dot(b, b), sq_c = dot(c, c);
  const auto use_b = sq_b > sq_a;
  const Vector3Of<Real> ab = select(use_b, b, a);
  const Real sq_ab = use_b ? sq_b : sq_a;
  const auto use_c = sq_c > sq_ab;
  const Vector3Of<Real> best = select(use_c, c, ab);
  const Real unit = inverse_sqrt(use_c ? sq_c : sq_ab);
  return {best.x * unit, best.y * unit, best.z * unit};
}

template <class Real>
struct EigenPair {
  Real smaller, larger;
  Vector3Of<Real> smaller_vector, larger_vector;
};

/// The eigenvectors of `m` in the plane that the unit vector `v` is orthogonal to. The basis (u, w)
/// of that plane is Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
template <class Real>
EigenPair<Real> eigen_pair_across(const Symmetric3<Real>& m, const Vector3Of<Real>& v) {
  const Real zero{}, one = constant<Real>(1.0);
  const Real sign = v.z < zero ? -one : one;
  const Real a = -1.0F / (sign + v.z);
  const Real b = v.x * v.y * a;
  const Vector3Of<Real> u{multiply_add<Real>(sign * v.x * v.x, a, one), sign * b, -sign * v.x};
  const Vector3Of<Real> w{b, multiply_add<Real>(v.y * v.y, a, sign), -v.y};
  const Vector3Of<Real> mw = times(m, w);
  const Real uu = dot(u, times(m, u)), uw = dot(u, mw), ww = dot(w, mw);

  const Real half_difference = 0.5F * (uu - ww), half_sum = 0.5F * (uu + ww);
  const Real sq_radius = sum_of_products(half_difference, half_difference, uw, uw);
  const Real radius = sq_radius * inverse_sqrt(sq_radius);
  // (cosine, sine) of the larger eigenvector in (u, w), from whichever row does not cancel.
  const auto u_leads = half_difference >= zero;
  const Real along_u = u_leads ? half_difference + radius : uw;
  const Real along_w = u_leads ? uw : radius - half_difference;
  const Real sq_length = sum_of_products(along_u, along_u, along_w, along_w);
  const auto is_split = sq_length > constant<Real>(1e-30);
  const Real unit = inverse_sqrt(sq_length);
  const Real cosine = is_split ? along_u * unit : one;
  const Real sine = is_split ? along_w * unit : zero;
  return {
      half_sum - radius,
      half_sum + radius,
      combine(-sine, u, cosine, w),
      combine(cosine, u, sine, w)};
}

NVM_END_DETAIL_KERNELS
NVM_BEGIN_KERNELS

/// Eigenvalues and eigenvectors of `m` in closed form, without branches: the same steps for every
/// matrix and, with FloatLanes, for several matrices at once.
///
/// One eigenvalue of a symmetric 3x3 matrix is always well apart from the two others: it is solved
/// first (trigonometric solution with Newton steps in place of acos and cos), then the other two in
/// the plane across its eigenvector, as a 2x2 matrix. Nothing is lost where two or three
/// eigenvalues coincide. With eps the machine epsilon and |m| the largest absolute entry,
/// eigenvalues, residuals |m v - lambda v| and the cosines between eigenvectors are within
/// 16 eps |m| (cosines: 16 eps) of exact, for finite matrices with 1e-15 < |m| < 1e15 (tested).
template <class Real>
Eigen3<Real> eigen_decomposition(const Symmetric3<Real>& m) {
  using namespace detail;
  const Real zero{}, one = constant<Real>(1.0);
  const Deviator<Real> d = deviator(m);
  const Real half_determinant = 0.5F * determinant(d.unit);
  const auto is_smallest = half_determinant < zero;  // the isolated eigenvalue
  const Real root = isolated_root(smaller(absolute(half_determinant), one));
  const Real isolated = is_smallest ? -root : root;

  const Vector3Of<Real> v = null_vector(shifted(d.unit, isolated));
  const EigenPair<Real> pair = eigen_pair_across(d.unit, v);
  const auto eigenvalue = [&d](const Real& unit) {
    return multiply_add<Real>(d.spread, unit, d.mean);
  };
  return {
      eigenvalue(is_smallest ? isolated : pair.smaller),
      eigenvalue(is_smallest ? pair.smaller : pair.larger),
      eigenvalue(is_smallest ? pair.larger : isolated),
      select(is_smallest, v, pair.smaller_vector),
      select(is_smallest, pair.smaller_vector, pair.larger_vector),
      select(is_smallest, pair.larger_vector, v)};
}

/// The same for Eigen's types: eigenvalues ascending, eigenvectors in the columns. Reads the lower
/// triangle of `m`.
struct EigenDecomposition {
  Eigen::Vector3d values;
  Eigen::Matrix3d vectors;
};

template <class = void>
EigenDecomposition eigen_decomposition(const Eigen::Matrix3d& m) {
  const Eigen3<double> e =
      eigen_decomposition(Symmetric3<double>{m(0, 0), m(1, 0), m(2, 0), m(1, 1), m(2, 1), m(2, 2)});
  const Vector3Of<double>& s = e.smallest_vector;
  const Vector3Of<double>& t = e.middle_vector;
  const Vector3Of<double>& l = e.largest_vector;
  EigenDecomposition result;
  result.values << e.smallest, e.middle, e.largest;
  result.vectors << s.x, t.x, l.x, s.y, t.y, l.y, s.z, t.z, l.z;
  return result;
}

NVM_END_KERNELS

#endif  // NVM_GEOMETRY_SYMMETRIC_EIGEN_HPP
