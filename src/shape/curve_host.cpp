#include "shape/curve_host.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "shape/analytic_host.h"
#include "shape/shape_file_host.h"

namespace norrsken {
namespace {

using Point = std::array<float, 4>;

constexpr TransformParameter kToWorld{.name = "to_world",
                                      .text = "of the control points; their radii stay as they are, as in Mitsuba"};

glm::dvec3 position(const Point& p) { return {p[0], p[1], p[2]}; }

bool move_to_world(Array<Point>& points, const glm::dmat4& to_world, Parameters& p) {
  for (Point& point : points) {
    const glm::dvec3 moved = to_world * glm::dvec4(position(point), 1);
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(moved[axis]) <= kMaxCoordinate)) {
        p.error(kToWorld.name, fmt::format("a control point is at ({:.6g}, {:.6g}, {:.6g})", moved.x, moved.y, moved.z),
                fmt::format("coordinates from {:g} to {:g}", -kMaxCoordinate, kMaxCoordinate));
        return false;
      }
      point[static_cast<std::size_t>(axis)] = static_cast<float>(moved[axis]);
    }
  }
  return true;
}

struct Ball {
  glm::dvec3 center;
  double radius;
};

/// Balls along the segment whose hull it is in: at the control points of its Bezier form.
std::vector<Ball> hull_of(const Point* points, CurveBasis basis) {
  const auto mean = [&](double w0, double w1, double w2, std::size_t first) {
    const Point &a = points[first], &b = points[first + 1], &c = points[first + (w2 == 0 ? 1 : 2)];
    return Ball{w0 * position(a) + w1 * position(b) + w2 * position(c),
                std::max(w0 * double{a[3]} + w1 * double{b[3]} + w2 * double{c[3]}, 0.0)};
  };
  if (basis == CurveBasis::linear) return {mean(1, 0, 0, 0), mean(0, 1, 0, 0)};
  return {mean(1. / 6, 4. / 6, 1. / 6, 0), mean(2. / 3, 1. / 3, 0, 1), mean(1. / 3, 2. / 3, 0, 1),
          mean(1. / 6, 4. / 6, 1. / 6, 1)};
}

}  // namespace

std::optional<ShapeGeometry> compile_curves(Parameters& p, Shapes& shapes, const FileParameter& filename,
                                            AnalyticKind kind, CurveBasis basis) {
  const std::string path = p.read(filename);
  const glm::dmat4 to_world = p.read(kToWorld);
  if (path.empty()) return std::nullopt;
  std::optional<CurveData> curves;
  if (const std::optional<FileContents> contents = read_shape_file(path, filename.name, p, shapes))
    curves = read_curves(contents->bytes, basis, path, p.diagnostics());
  if (!curves || !move_to_world(curves->points, to_world, p)) return std::nullopt;

  // Already in the world: Embree and the kernels read the same numbers.
  AnalyticShape shape{.kind = kind, .world_from_local = glm::dmat4(1), .area = 0, .flip_normals = false};
  shape.element_count = static_cast<std::uint32_t>(curves->segments.size());
  shape.elements_are_primitives = true;
  shape.table.reserve(1 + curves->segments.size() + 4 * curves->points.size());
  shape.table.push_back(std::bit_cast<float>(shape.element_count));
  shape.lower = glm::dvec3(std::numeric_limits<double>::infinity()), shape.upper = -shape.lower;
  for (const std::uint32_t first : curves->segments) {
    shape.table.push_back(std::bit_cast<float>(first));
    const std::vector<Ball> hull = hull_of(&curves->points[first], basis);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      shape.lower = glm::min(shape.lower, hull[i].center - hull[i].radius);
      shape.upper = glm::max(shape.upper, hull[i].center + hull[i].radius);
      // Nothing samples the surface: that of cones along the hull will do.
      if (i > 0)
        shape.area += std::numbers::pi * (hull[i].radius + hull[i - 1].radius) *
                      glm::distance(hull[i].center, hull[i - 1].center);
    }
  }
  for (const Point& point : curves->points) shape.table.insert(shape.table.end(), point.begin(), point.end());
  const auto counted = [](std::size_t n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  shapes.describe(p.node(),
                  fmt::format("{}, {}", counted(curves->curves, "curve"), counted(shape.element_count, "segment")));
  return place_analytic(shape, p);
}

}  // namespace norrsken
