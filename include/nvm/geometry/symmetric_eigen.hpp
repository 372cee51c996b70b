// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <Eigen/Core>
#include <tuple>

#include "nvm/geometry/float_lanes.hpp"
#include "nvm/geometry/moments.hpp"

namespace nvm {

/// Three coordinates of number type `Real`: float, double or FloatLanes (one vector per lane).
template <class Real>
struct Vector3Of {
  Real x{}, y{}, z{};
};

/// Eigenvalues of a symmetric 3x3 matrix, ascending, and their unit eigenvectors, orthogonal to
/// each other. The sign of an eigenvector is arbitrary.
template <class Real>
struct Eigen3 {
  Real smallest{}, middle{}, largest{};
  Vector3Of<Real> smallest_vector, middle_vector, largest_vector;
};

namespace detail {

template <class Real>
Real dot(const Vector3Of<Real>& a, const Vector3Of<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
Vector3Of<Real> cross(const Vector3Of<Real>& a, const Vector3Of<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// a * u + b * v.
template <class Real>
Vector3Of<Real> combine(
    const Real& a, const Vector3Of<Real>& u, const Real& b, const Vector3Of<Real>& v) {
  return {a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z};
}

template <class Real, class Mask>
Vector3Of<Real> select(const Mask& mask, const Vector3Of<Real>& a, const Vector3Of<Real>& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

template <class Real>
Vector3Of<Real> times(const Symmetric3<Real>& m, const Vector3Of<Real>& v) {
  return {
      m.xx * v.x + m.xy * v.y + m.xz * v.z,
      m.xy * v.x + m.yy * v.y + m.yz * v.z,
      m.xz * v.x + m.yz * v.y + m.zz * v.z};
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
Deviator<Real> deviator(const Symmetric3<Real>& m) {
  const Real zero{};
  const Real size = max_abs(m);
  const Real scale = size > zero ? size : constant<Real>(1.0);
  const Real unscale = 1.0F / scale;
  const Real mean = (m.xx + m.yy + m.zz) * unscale * constant<Real>(1.0 / 3.0);
  const Real xx = m.xx * unscale - mean, xy = m.xy * unscale, xz = m.xz * unscale;
  const Real yy = m.yy * unscale - mean, yz = m.yz * unscale, zz = m.zz * unscale - mean;
  const Real sq_spread = (xx * xx + yy * yy + zz * zz + 2.0F * (xy * xy + xz * xz + yz * yz)) *
                         constant<Real>(1.0 / 6.0);
  const Real unspread = inverse_sqrt(sq_spread);
  return {
      {xx * unspread, xy * unspread, xz * unspread, yy * unspread, yz * unspread, zz * unspread},
      mean * scale,
      sq_spread * unspread * scale};
}

template <class Real>
Real determinant(const Symmetric3<Real>& m) {
  return m.xx * (m.yy * m.zz - m.yz * m.yz) - m.xy * (m.xy * m.zz - m.yz * m.xz) +
         m.xz * (m.xy * m.yz - m.yy * m.xz);
}

/// The largest root of x^3 - 3x - 2r for r in [0, 1]: 2 cos(acos(r)/3), by Newton's method. The
/// start, a fitted parabola, is off by at most 1.1e-3; each step more than squares that.
template <class Real>
Real isolated_root(const Real& r) {
  Real x = 1.7331223F + r * (0.3191803F - 0.0531376F * r);
  for (int step = 0; step < 3; ++step) {
    const Real sq_x = x * x;
    x = (2.0F * x * sq_x + 2.0F * r) / (3.0F * sq_x - 3.0F);
  }
  return x;
}

/// Unit vector that m maps to zero, for a matrix of rank 2: its rows span the plane that the vector
/// is orthogonal to, and of the three pairs of rows the one with the largest product is used.
template <class Real>
Vector3Of<Real> null_vector(const Symmetric3<Real>& m) {
  const Vector3Of<Real> row_x{m.xx, m.xy, m.xz}, row_y{m.xy, m.yy, m.yz}, row_z{m.xz, m.yz, m.zz};
  const Vector3Of<Real> a = cross(row_x, row_y), b = cross(row_x, row_z), c = cross(row_y, row_z);
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
  const Vector3Of<Real> u{one + sign * v.x * v.x * a, sign * b, -sign * v.x};
  const Vector3Of<Real> w{b, sign + v.y * v.y * a, -v.y};
  const Vector3Of<Real> mw = times(m, w);
  const Real uu = dot(u, times(m, u)), uw = dot(u, mw), ww = dot(w, mw);

  const Real half_difference = 0.5F * (uu - ww), half_sum = 0.5F * (uu + ww);
  const Real sq_radius = half_difference * half_difference + uw * uw;
  const Real radius = sq_radius * inverse_sqrt(sq_radius);
  // (cosine, sine) of the larger eigenvector in (u, w), from whichever row does not cancel.
  const auto u_leads = half_difference >= zero;
  const Real along_u = u_leads ? half_difference + radius : uw;
  const Real along_w = u_leads ? uw : radius - half_difference;
  const Real sq_length = along_u * along_u + along_w * along_w;
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

}  // namespace detail

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

  const Symmetric3<Real>& b = d.unit;
  const Vector3Of<Real> v = null_vector(
      Symmetric3<Real>{b.xx - isolated, b.xy, b.xz, b.yy - isolated, b.yz, b.zz - isolated});
  const EigenPair<Real> pair = eigen_pair_across(b, v);
  return {
      d.mean + d.spread * (is_smallest ? isolated : pair.smaller),
      d.mean + d.spread * (is_smallest ? pair.smaller : pair.larger),
      d.mean + d.spread * (is_smallest ? pair.larger : isolated),
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

inline EigenDecomposition eigen_decomposition(const Eigen::Matrix3d& m) {
  const Eigen3<double> e =
      eigen_decomposition(Symmetric3<double>{m(0, 0), m(1, 0), m(2, 0), m(1, 1), m(2, 1), m(2, 2)});
  const auto& [s, t, l] = std::tie(e.smallest_vector, e.middle_vector, e.largest_vector);
  EigenDecomposition result;
  result.values << e.smallest, e.middle, e.largest;
  result.vectors << s.x, t.x, l.x, s.y, t.y, l.y, s.z, t.z, l.z;
  return result;
}

}  // namespace nvm
