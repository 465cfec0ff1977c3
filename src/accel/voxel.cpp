#include "accel/voxel.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>

namespace norrsken {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Exact at both ends; has the sign that both arguments have.
double lerp(double a, double b, double w) { return a * (1 - w) + b * w; }

/// What a ray has of a voxel: parameters along the ray, and places in the voxel from 0 to 1.
struct Segment {
  double begin, end;
  glm::dvec3 first, last;
};

std::optional<Segment> clip(const glm::dvec3& lower, const glm::dvec3& origin, const glm::dvec3& direction) {
  glm::dvec3 enter(-kInfinity), leave(kInfinity);
  for (int a = 0; a < 3; ++a) {
    if (direction[a] == 0) {
      if (origin[a] < lower[a] || origin[a] > lower[a] + 1) return std::nullopt;
      continue;
    }
    enter[a] = (lower[a] - origin[a]) / direction[a];
    leave[a] = (lower[a] + 1 - origin[a]) / direction[a];
    if (direction[a] < 0) std::swap(enter[a], leave[a]);
  }
  Segment s{std::max({0.0, enter.x, enter.y, enter.z}), std::min({leave.x, leave.y, leave.z}), {}, {}};
  if (!(s.begin < s.end && s.end < kInfinity)) return std::nullopt;
  for (int a = 0; a < 3; ++a) {
    const double near = direction[a] < 0 ? 1 : 0;
    const auto place = [&](double t) { return std::clamp(origin[a] + t * direction[a] - lower[a], 0.0, 1.0); };
    // On a face the place across it is exact.
    s.first[a] = enter[a] == s.begin ? near : place(s.begin);
    s.last[a] = leave[a] == s.end ? 1 - near : place(s.end);
  }
  return s;
}

/// A cubic polynomial on [0, 1].
struct Bernstein {
  double b[4];

  double at(double s) const {
    const double ab = lerp(b[0], b[1], s), bc = lerp(b[1], b[2], s), cd = lerp(b[2], b[3], s);
    return lerp(lerp(ab, bc, s), lerp(bc, cd, s), s);
  }
  double slope(double s) const {
    return 3 * lerp(lerp(b[1] - b[0], b[2] - b[1], s), lerp(b[2] - b[1], b[3] - b[2], s), s);
  }
  bool has_one_sign() const {
    const bool inside = is_inside(b[0]);
    return std::all_of(b, b + 4, [&](double v) { return is_inside(v) == inside; });
  }
};

/// The interpolation along the segment. Its values at the corners of the box whose diagonal the segment is are those of
/// its polar form, in which each factor of a product may be of a place of its own.
Bernstein along(std::array<double, 8> values, const Segment& segment) {
  for (int a = 0; a < 3; ++a) {
    const std::size_t step = std::size_t{1} << a;
    for (std::size_t i = 0; i < 8; ++i) {
      if ((i & step) != 0) continue;
      const double low = values[i], high = values[i + step];
      values[i] = lerp(low, high, segment.first[a]);
      values[i + step] = lerp(low, high, segment.last[a]);
    }
  }
  const auto& v = values;
  return {{v[0], (v[1] + v[2] + v[4]) / 3, (v[3] + v[5] + v[6]) / 3, v[7]}};
}

/// Where the polynomial's slope is 0, within (0, 1) and in order; 1 in place of what is not there.
std::pair<double, double> extrema(const Bernstein& f) {
  const double d0 = f.b[1] - f.b[0], d1 = f.b[2] - f.b[1], d2 = f.b[3] - f.b[2];
  // (d0 - 2 d1 + d2) s^2 + 2 (d1 - d0) s + d0 = 0
  const double discriminant = d1 * d1 - d0 * d2;
  if (!(discriminant > 0)) return {1, 1};
  const double half = d1 - d0;
  const double q = -(half + std::copysign(std::sqrt(discriminant), half));
  double r0 = q / (d0 - 2 * d1 + d2), r1 = d0 / q;
  if (!(r0 > 0 && r0 < 1)) r0 = 1;
  if (!(r1 > 0 && r1 < 1)) r1 = 1;
  return std::minmax(r0, r1);
}

/// Between two places with values of different signs and no extremum in between: Newton's method, kept within the
/// bracket by bisection.
double root(const Bernstein& f, double low, double high, double at_low, double at_high) {
  constexpr double kEnough = 0x1p-44;  // of a voxel: far below what a float tells apart
  const bool low_inside = is_inside(at_low);
  double s = low + (high - low) * (at_low / (at_low - at_high));
  for (int i = 0; i < 64; ++i) {
    const double value = f.at(s);
    (is_inside(value) == low_inside ? low : high) = s;
    double next = s - value / f.slope(s);
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    const bool enough = std::abs(next - s) <= kEnough;
    s = next;
    if (enough) break;
  }
  return s;
}

glm::dvec3 gradient_at(const std::array<double, 8>& v, const glm::dvec3& w) {
  glm::dvec3 gradient;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const auto edge = [&](int corner) {
      const auto i = static_cast<std::size_t>(corner);
      return v[i | (std::size_t{1} << a)] - v[i];
    };
    gradient[a] = lerp(lerp(edge(0), edge(1 << b), w[b]), lerp(edge(1 << c), edge((1 << b) | (1 << c)), w[b]), w[c]);
  }
  return gradient;
}

}  // namespace

Box surface_box(const Voxel& voxel) {
  // In a slice across an axis the interpolation has both signs if and only if the slice's corners have: the surface
  // reaches as far as the edges that it crosses.
  Box box{glm::dvec3(1), glm::dvec3(0)};
  for (std::size_t i = 0; i < 8; ++i) {
    for (int a = 0; a < 3; ++a) {
      const std::size_t step = std::size_t{1} << a;
      const double low = voxel.values[i], high = voxel.values[i | step];
      if ((i & step) != 0 || is_inside(low) == is_inside(high)) continue;
      glm::dvec3 p(i & 1, (i >> 1) & 1, (i >> 2) & 1);
      p[a] = low / (low - high);
      box.lower = glm::min(box.lower, p);
      box.upper = glm::max(box.upper, p);
    }
  }
  return {voxel.lower + box.lower, voxel.lower + box.upper};
}

std::optional<VoxelHit> cross_voxel(const Voxel& voxel, const glm::dvec3& origin, const glm::dvec3& direction,
                                    float t_max) {
  const std::optional<Segment> segment = clip(voxel.lower, origin, direction);
  if (!segment) return std::nullopt;
  const Bernstein f = along(voxel.values, *segment);
  if (f.has_one_sign()) return std::nullopt;
  const auto [first, second] = extrema(f);
  const double places[4] = {0, first, second, 1};
  const double values[4] = {f.b[0], f.at(first), f.at(second), f.b[3]};
  for (int i = 0; i < 3; ++i) {
    if (is_inside(values[i]) == is_inside(values[i + 1])) continue;
    const double s = root(f, places[i], places[i + 1], values[i], values[i + 1]);
    const auto t = static_cast<float>(segment->begin + s * (segment->end - segment->begin));
    if (!(t > 0)) continue;
    if (!(t < t_max)) return std::nullopt;
    return VoxelHit{t, gradient_at(voxel.values, glm::mix(segment->first, segment->last, s))};
  }
  return std::nullopt;
}

}  // namespace norrsken
