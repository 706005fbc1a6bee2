// Vectors and matrices of intervals, as far as second-order enclosures need them.
//
// Like every interval operation, sound only while a Rounding object is alive.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "numerics/interval.h"

namespace starcell {

/// Encloses the square: never below 0, unlike x * x.
inline Interval squared(const Interval& x) { return boost::numeric::square(x); }

/// Encloses the square root of a number that is not negative; what lies below 0 is rounding.
inline Interval square_root(const Interval& x) {
  // Rounding is upwards: the lower end has to step back, 0 stays 0.
  const double low = x.lower() > 0 ? std::nextafter(std::sqrt(x.lower()), 0.0) : 0.0;
  return {low, x.upper() > 0 ? std::sqrt(x.upper()) : 0.0};
}

inline Interval3 enclose(const Vec3& v) { return {Interval(v.x()), Interval(v.y()), Interval(v.z())}; }
inline Interval3 operator+(const Interval3& a, const Interval3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Interval3 operator-(const Interval3& a, const Interval3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Interval3 operator*(const Interval& s, const Interval3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Interval dot(const Interval3& a, const Interval3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Interval dot(const Interval3& a, const Vec3& b) { return a.x * b.x() + a.y * b.y() + a.z * b.z(); }
inline Interval3 cross(const Interval3& a, const Interval3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Interval norm(const Interval3& a) { return square_root(squared(a.x) + squared(a.y) + squared(a.z)); }
inline Interval3 unit(const Interval3& a) {
  const Interval length = norm(a);
  return {a.x / length, a.y / length, a.z / length};
}

/// Both of them, and what is between.
inline Interval hull(const Interval& a, const Interval& b) { return {std::min(a.lower(), b.lower()), std::max(a.upper(), b.upper())}; }
inline Interval3 hull(const Interval3& a, const Interval3& b) { return {hull(a.x, b.x), hull(a.y, b.y), hull(a.z, b.z)}; }

/// A symmetric 3x3 matrix.
struct IntervalSymmetric {
  Interval xx, yy, zz, xy, xz, yz;

  Interval3 operator*(const Interval3& v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
  IntervalSymmetric operator+(const IntervalSymmetric& m) const {
    return {xx + m.xx, yy + m.yy, zz + m.zz, xy + m.xy, xz + m.xz, yz + m.yz};
  }
  friend IntervalSymmetric operator*(const Interval& s, const IntervalSymmetric& m) {
    return {s * m.xx, s * m.yy, s * m.zz, s * m.xy, s * m.xz, s * m.yz};
  }
};

/// A 3x3 matrix, by rows.
struct IntervalMatrix {
  std::array<Interval3, 3> row;

  Interval3 operator*(const Interval3& v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  Interval3 column(int k) const { return {row[0][k], row[1][k], row[2][k]}; }
  IntervalMatrix transposed() const { return {column(0), column(1), column(2)}; }
  IntervalMatrix operator*(const IntervalMatrix& m) const {
    IntervalMatrix product;
    const IntervalMatrix t = m.transposed();
    for (int i = 0; i < 3; ++i) product.row[i] = t * row[i];
    return product;
  }
  Interval determinant() const { return dot(row[0], cross(row[1], row[2])); }
  /// Encloses the inverse, if the determinant is certainly not 0.
  IntervalMatrix inverse() const {
    const Interval d = determinant();
    const IntervalMatrix columns{{cross(row[1], row[2]), cross(row[2], row[0]), cross(row[0], row[1])}};
    IntervalMatrix result = columns.transposed();
    for (Interval3& r : result.row) r = {r.x / d, r.y / d, r.z / d};
    return result;
  }
  /// Transpose times s times this: how a quadratic form is pulled back.
  IntervalSymmetric pull_back(const IntervalSymmetric& s) const {
    const IntervalMatrix t = transposed();
    const Interval3 x = s * t.row[0], y = s * t.row[1], z = s * t.row[2];
    return {dot(t.row[0], x), dot(t.row[1], y), dot(t.row[2], z), dot(t.row[0], y), dot(t.row[0], z), dot(t.row[1], z)};
  }
};

}  // namespace starcell
