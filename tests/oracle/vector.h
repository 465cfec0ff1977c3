// The oracle's own three numbers: a vector in space or a colour. Shares nothing with the renderer's mathematics.
#pragma once

#include <cmath>

namespace norrsken::oracle {

struct Vec {
  double x = 0, y = 0, z = 0;

  Vec& operator+=(const Vec& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
};
using Rgb = Vec;  ///< linear sRGB in x, y, z

constexpr Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec operator-(const Vec& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec operator*(const Vec& a, const Vec& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr Vec operator*(const Vec& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec operator*(double s, const Vec& a) { return a * s; }
constexpr Vec operator/(const Vec& a, double s) { return a * (1 / s); }
constexpr double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec& a) { return std::sqrt(dot(a, a)); }
inline Vec normalize(const Vec& a) { return a / length(a); }

}  // namespace norrsken::oracle
