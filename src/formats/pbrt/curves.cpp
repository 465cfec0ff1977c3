// The shape curve, as a mesh: tubes, or ribbons where they are given a direction.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "formats/pbrt/mesh_maker.h"

namespace norrsken::pbrt {
namespace {

constexpr int kSides = 6;                        // of a tube
constexpr double kBend = std::numbers::pi / 12;  // that one step takes, about
constexpr int kMostSteps = 16;                   // of a segment

using Bezier = std::array<glm::dvec3, 4>;

glm::dvec3 at(const Bezier& b, double t) {
  const double s = 1 - t;
  return s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
}

glm::dvec3 tangent(const Bezier& b, double t) {
  const double s = 1 - t;
  return 3.0 * (s * s * (b[1] - b[0]) + 2 * s * t * (b[2] - b[1]) + t * t * (b[3] - b[2]));
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0 ? std::acos(std::clamp(glm::dot(a, b) / lengths, -1.0, 1.0)) : 0;
}

int steps_of(const Bezier& b) {
  const double bend = angle_between(b[1] - b[0], b[2] - b[1]) + angle_between(b[2] - b[1], b[3] - b[2]);
  return std::clamp(static_cast<int>(std::ceil(bend / kBend)), 1, kMostSteps);
}

/// A segment in cubic Bezier form, of whatever basis and degree it has: the points from `p` on.
Bezier to_bezier(const glm::dvec3* p, bool bspline, int degree) {
  if (degree == 2) {
    const glm::dvec3 a = bspline ? (p[0] + p[1]) / 2.0 : p[0], c = bspline ? (p[1] + p[2]) / 2.0 : p[2];
    return {a, glm::mix(a, p[1], 2. / 3), glm::mix(c, p[1], 2. / 3), c};
  }
  if (!bspline) return {p[0], p[1], p[2], p[3]};
  return {(p[0] + 4.0 * p[1] + p[2]) / 6.0, (2.0 * p[1] + p[2]) / 3.0, (p[1] + 2.0 * p[2]) / 3.0,
          (p[1] + 4.0 * p[2] + p[3]) / 6.0};
}

glm::dvec3 any_normal(const glm::dvec3& direction) {
  const glm::dvec3 axis =
      std::abs(direction.x) < 0.5 * glm::length(direction) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(direction, axis));
}

/// `v` without its part along `direction`, of length 1; `otherwise` if nothing is left.
glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& direction, const glm::dvec3& otherwise) {
  const glm::dvec3 rest = v - direction * glm::dot(v, direction);
  const double length = glm::length(rest);
  return length > 1e-9 ? rest / length : otherwise;
}

/// One cross-section after the other of a curve, joined to the one before.
class Sweep {
 public:
  Sweep(MeshMaker& maker, bool is_ribbon) : maker_(maker), points_(is_ribbon ? 1 : kSides), is_ribbon_(is_ribbon) {}

  void add(const glm::dvec3& center, const glm::dvec3& direction, double radius, double u, const glm::dvec3& face) {
    const double length = glm::length(direction);
    const glm::dvec3 along = length > 0 ? direction / length : glm::dvec3(0, 0, 1);
    normal_ = across(is_ribbon_ ? face : normal_, along, any_normal(along));
    const glm::dvec3 side = glm::cross(along, normal_);
    const std::uint32_t before = first_;
    maker_.reserve(static_cast<std::size_t>(points_ + 1), 2 * static_cast<std::size_t>(points_));
    for (int i = 0; i <= points_; ++i) {
      const double v = static_cast<double>(i) / points_;
      const glm::dvec2 uv(u, v);
      std::uint32_t number = 0;
      if (is_ribbon_) {
        number = maker_.vertex(center + radius * (2 * v - 1) * side, &normal_, &uv);
      } else {
        const double phi = 2 * std::numbers::pi * v;
        const glm::dvec3 out = std::cos(phi) * normal_ + std::sin(phi) * side;
        // A prism is as wide as the tube on the average over all views.
        const double wide = radius * (std::numbers::pi / kSides) / std::sin(std::numbers::pi / kSides);
        number = maker_.vertex(center + wide * out, &out, &uv);
      }
      if (i == 0) first_ = number;
    }
    for (std::uint32_t i = 0; begun_ && i < static_cast<std::uint32_t>(points_); ++i) {
      maker_.triangle(before + i, before + i + 1, first_ + i + 1);
      maker_.triangle(before + i, first_ + i + 1, first_ + i);
    }
    begun_ = true;
  }

 private:
  MeshMaker& maker_;
  int points_;
  bool is_ribbon_, begun_ = false;
  std::uint32_t first_ = 0;
  glm::dvec3 normal_{1, 0, 0};
};

}  // namespace

std::optional<Geometry> make_curve(Context& context, Parameters& p, const Placement& placement) {
  const Array<double>* given = p.list("point3", "P", 3);
  const auto degree = static_cast<int>(p.integer("degree", 3, 2, 3));
  const bool bspline = p.choice("basis", "bezier", {"bezier", "bspline"}) == "bspline";
  const std::string type = p.choice("type", "flat", {"flat", "ribbon", "cylinder"});
  const Array<double>* normals = p.list("normal", "N", 3);
  const double width = p.number("width", 1), width0 = p.number("width0", width), width1 = p.number("width1", width);
  p.integer("splitdepth", 3);
  if (!given) {
    if (!p.has("P")) p.error(nullptr, "shape 'curve' has no control points", R"("point3 P" [ x y z ... ])");
    return std::nullopt;
  }
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i + 2 < given->size(); i += 3)
    points.emplace_back((*given)[i], (*given)[i + 1], (*given)[i + 2]);
  const std::size_t n = points.size(), d = static_cast<std::size_t>(degree);
  if (n < d + 1 || (!bspline && (n - 1) % d != 0)) {
    p.error(p.find("point3", "P"), fmt::format("shape 'curve' has {} control points", n),
            bspline ? fmt::format("{} or more", d + 1) : fmt::format("{} and any number of times {} more", d + 1, d));
    return std::nullopt;
  }
  const std::size_t segments = bspline ? n - d : (n - 1) / d;
  const bool is_ribbon = type == "ribbon";
  if (is_ribbon && (!normals || normals->size() != 3 * (segments + 1))) {
    p.error(p.find("normal", "N"), "a curve of type 'ribbon' needs its normals",
            fmt::format("{} of them in N", segments + 1));
    return std::nullopt;
  }
  if (!is_ribbon)
    context.tell(p.place(), fmt::format("curves of type '{}' are meshes", type),
                 fmt::format("tubes of {} sides, as wide on the average", kSides));
  MeshMaker maker(context, placement.to_world, placement.reverse);
  Sweep sweep(maker, is_ribbon);
  for (std::size_t s = 0; s < segments; ++s) {
    const Bezier bezier = to_bezier(&points[bspline ? s : d * s], bspline, degree);
    const int steps = steps_of(bezier);
    for (int i = s == 0 ? 0 : 1; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps, u = (static_cast<double>(s) + t) / static_cast<double>(segments);
      glm::dvec3 face(0);
      if (is_ribbon) {
        const auto normal = [&](std::size_t k) {
          return glm::dvec3((*normals)[3 * k], (*normals)[3 * k + 1], (*normals)[3 * k + 2]);
        };
        face = glm::mix(normal(s), normal(s + 1), t);
      }
      glm::dvec3 direction = tangent(bezier, t);
      if (glm::length(direction) == 0) direction = bezier[3] - bezier[0];
      sweep.add(at(bezier, t), direction, glm::mix(width0, width1, u) / 2, u, face);
    }
  }
  return maker.finish(p);
}

}  // namespace norrsken::pbrt
