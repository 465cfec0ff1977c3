// The sRGB colour space, IEC 61966-2-1: primaries and white, the matrices to and from CIE XYZ, luminance, and the
// transfer function between linear values and stored ones.
#pragma once

#include <array>
#include <cmath>
#include <concepts>

namespace norrsken {

/// CIE 1931 chromaticity coordinates.
struct Chromaticity {
  double x, y;
};

inline constexpr Chromaticity kSrgbRed{0.64, 0.33};
inline constexpr Chromaticity kSrgbGreen{0.30, 0.60};
inline constexpr Chromaticity kSrgbBlue{0.15, 0.06};
inline constexpr Chromaticity kSrgbWhite{0.3127, 0.3290};  ///< D65 as the standard rounds it

/// A row-major 3x3 matrix, and a column it is applied to.
using ColorMatrix = std::array<std::array<double, 3>, 3>;
using ColorVector = std::array<double, 3>;

constexpr ColorVector operator*(const ColorMatrix& m, const ColorVector& v) {
  ColorVector result{};
  for (int row = 0; row < 3; ++row) result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  return result;
}

/// The inverse of an invertible matrix: its adjugate over its determinant.
constexpr ColorMatrix inverse(const ColorMatrix& m) {
  ColorMatrix result{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      // Cyclic indices give each cofactor its sign.
      const int r1 = (column + 1) % 3, r2 = (column + 2) % 3, c1 = (row + 1) % 3, c2 = (row + 2) % 3;
      result[row][column] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    }
  }
  const double determinant = m[0][0] * result[0][0] + m[0][1] * result[1][0] + m[0][2] * result[2][0];
  for (auto& row : result) {
    for (double& element : row) element /= determinant;
  }
  return result;
}

/// The XYZ of a chromaticity at luminance 1.
constexpr ColorVector xyz_of(Chromaticity c) { return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y}; }

/// XYZ from linear RGB of the given primaries, scaled so that RGB (1,1,1) is the white at luminance 1
/// (SMPTE RP 177-1993).
constexpr ColorMatrix xyz_from_rgb(Chromaticity red, Chromaticity green, Chromaticity blue, Chromaticity white) {
  const ColorVector r = xyz_of(red), g = xyz_of(green), b = xyz_of(blue);
  ColorMatrix matrix{{{r[0], g[0], b[0]}, {r[1], g[1], b[1]}, {r[2], g[2], b[2]}}};
  const ColorVector scale = inverse(matrix) * xyz_of(white);
  for (auto& row : matrix) {
    for (int column = 0; column < 3; ++column) row[column] *= scale[column];
  }
  return matrix;
}

inline constexpr ColorMatrix kXyzFromSrgb = xyz_from_rgb(kSrgbRed, kSrgbGreen, kSrgbBlue, kSrgbWhite);
inline constexpr ColorMatrix kSrgbFromXyz = inverse(kXyzFromSrgb);

/// Weights of linear sRGB's relative luminance: about 0.2126, 0.7152 and 0.0722. They add up to 1.
inline constexpr ColorVector kSrgbLuminance = kXyzFromSrgb[1];

template <std::floating_point T>
constexpr T luminance(T r, T g, T b) {
  return T(kSrgbLuminance[0]) * r + T(kSrgbLuminance[1]) * g + T(kSrgbLuminance[2]) * b;
}

/// The stored value of a linear one. Exact on [0,1]; negative values stay on the linear segment.
template <std::floating_point T>
T srgb_from_linear(T linear) {
  if (linear <= T(0.0031308)) return T(12.92) * linear;
  // 1.055 power - 0.055, arranged so that 1 becomes 1 in any precision.
  const T power = std::pow(linear, T(1) / T(2.4));
  return power + T(0.055) * (power - T(1));
}

/// The linear value of a stored one, the inverse of `srgb_from_linear`.
template <std::floating_point T>
T linear_from_srgb(T stored) {
  return stored <= T(0.04045) ? stored / T(12.92) : std::pow((stored + T(0.055)) / T(1.055), T(2.4));
}

}  // namespace norrsken
