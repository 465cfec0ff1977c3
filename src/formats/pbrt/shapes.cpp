#include "formats/pbrt/shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "base/text.h"
#include "formats/pbrt/mesh_maker.h"

namespace norrsken::pbrt {
namespace {

constexpr int kAround = 192, kAlong = 96;  // pieces of round shapes that are drawn as meshes
constexpr double kSameLength = 1e-3;       // by which a circle may be an ellipse

/// Whether the first `count` axes are at right angles and alike in length, and the third is at right angles to them.
bool keeps_circles(const glm::dmat4& m, int count) {
  const glm::dmat3 axes(m);
  const double length = glm::length(axes[0]);
  for (int i = 0; i < 3; ++i) {
    const double other = glm::length(axes[i]);
    if (!(other > 0) || (i < count && std::abs(other / length - 1) > kSameLength)) return false;
    if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > kSameLength * other * glm::length(axes[(i + 1) % 3]))
      return false;
  }
  return true;
}

/// Round shapes turn inside out where their placement mirrors, in pbrt.
bool flips(const Placement& placement) { return placement.reverse != placement.is_mirrored(); }

void place(Node& node, const glm::dmat4& to_world, bool flip, const Parameters& p) {
  give(node, "to_world", to_transform(to_world), p.place());
  if (flip) give(node, "flip_normals", true, p.place());
}

/// "phimax" in radians.
double read_phi(Parameters& p) { return glm::radians(std::clamp(p.number("phimax", 360), 0.0, 360.0)); }

glm::dvec3 around(double phi, double radius, double z) { return {radius * std::cos(phi), radius * std::sin(phi), z}; }

std::optional<Geometry> make_sphere(Context& context, Parameters& p, const Placement& placement) {
  const double radius = p.positive("radius", 1);
  double low = std::clamp(p.number("zmin", -radius), -radius, radius);
  double high = std::clamp(p.number("zmax", radius), -radius, radius);
  if (low > high) std::swap(low, high);
  const double phi_max = read_phi(p);
  const bool whole = low == -radius && high == radius && phi_max == glm::radians(360.0);
  const double area = phi_max * radius * (high - low);
  if (whole && !placement.as_mesh && keeps_circles(placement.to_world, 3)) {
    Geometry geometry{.node = make_node("shape", "sphere", p.place()), .area = area};
    give(geometry.node, "radius", radius, p.place());
    // v begins below, in pbrt: the sphere is turned upside down by a mirror, which also turns it inside out.
    place(geometry.node, glm::scale(placement.to_world, glm::dvec3(1, 1, -1)), !placement.reverse, p);
    return geometry;
  }
  MeshMaker maker(context, placement.to_world, flips(placement));
  const double first = std::acos(low / radius), last = std::acos(high / radius);
  maker.grid(kAround, kAlong, [&](const glm::dvec2& uv) {
    const double theta = first + uv.y * (last - first);
    const glm::dvec3 at = around(uv.x * phi_max, radius * std::sin(theta), radius * std::cos(theta));
    return MeshMaker::Point{at, at / radius};
  });
  auto geometry = maker.finish(p);
  if (geometry) geometry->area = area;
  return geometry;
}

std::optional<Geometry> make_disk(Context& context, Parameters& p, const Placement& placement) {
  const double height = p.number("height", 0), radius = p.positive("radius", 1);
  const double inner = p.number("innerradius", 0), phi_max = read_phi(p);
  const double area = phi_max / 2 * (radius * radius - inner * inner);
  if (inner == 0 && phi_max == glm::radians(360.0) && !placement.depends_on_uv && !placement.as_mesh) {
    Geometry geometry{.node = make_node("shape", "disk", p.place()), .area = area};
    const glm::dmat4 raised = glm::translate(placement.to_world, glm::dvec3(0, 0, height));
    place(geometry.node, glm::scale(raised, glm::dvec3(radius, radius, 1)), flips(placement), p);
    return geometry;
  }
  MeshMaker maker(context, placement.to_world, flips(placement));
  maker.grid(kAround, 1, [&](const glm::dvec2& uv) {
    return MeshMaker::Point{around(uv.x * phi_max, radius + uv.y * (inner - radius), height), {0, 0, 1}};
  });
  auto geometry = maker.finish(p);
  if (geometry) geometry->area = area;
  return geometry;
}

std::optional<Geometry> make_cylinder(Context& context, Parameters& p, const Placement& placement) {
  const double radius = p.positive("radius", 1), phi_max = read_phi(p);
  double low = p.number("zmin", -1), high = p.number("zmax", 1);
  if (low > high) std::swap(low, high);
  const double area = (high - low) * radius * phi_max;
  if (phi_max == glm::radians(360.0) && high > low && !placement.as_mesh && keeps_circles(placement.to_world, 2)) {
    Geometry geometry{.node = make_node("shape", "cylinder", p.place()), .area = area};
    give(geometry.node, "p0", Property::Vector{{0, 0, low}}, p.place());
    give(geometry.node, "p1", Property::Vector{{0, 0, high}}, p.place());
    give(geometry.node, "radius", radius, p.place());
    place(geometry.node, placement.to_world, flips(placement), p);
    return geometry;
  }
  MeshMaker maker(context, placement.to_world, flips(placement));
  maker.grid(kAround, 1, [&](const glm::dvec2& uv) {
    const glm::dvec3 out = around(uv.x * phi_max, 1, 0);
    return MeshMaker::Point{radius * out + glm::dvec3(0, 0, low + uv.y * (high - low)), out};
  });
  auto geometry = maker.finish(p);
  if (geometry) geometry->area = area;
  return geometry;
}

struct ShapeType {
  std::string_view name;
  std::optional<Geometry> (*make)(Context&, Parameters&, const Placement&);
};
constexpr ShapeType kTypes[] = {
    {"bilinearmesh", make_bilinear_mesh},
    {"curve", make_curve},
    {"cylinder", make_cylinder},
    {"disk", make_disk},
    {"loopsubdiv", make_subdivision},
    {"plymesh", make_ply_mesh},
    {"sphere", make_sphere},
    {"trianglemesh", make_triangle_mesh},
};

}  // namespace

std::optional<Geometry> make_shape(Context& context, const std::string& type, Parameters& p,
                                   const Placement& placement) {
  std::vector<std::string> names;
  for (const ShapeType& shape : kTypes) {
    if (shape.name == type) return shape.make(context, p, placement);
    names.emplace_back(shape.name);
  }
  context.diagnostics.error(p.place().location(),
                            fmt::format("unknown shape {}{}", quoted(type), did_you_mean(type, names)), join(names));
  return std::nullopt;
}

}  // namespace norrsken::pbrt
