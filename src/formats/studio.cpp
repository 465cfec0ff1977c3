#include "formats/studio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

namespace norrsken {
namespace {

constexpr double kFieldOfView = 30;  // degrees, along the height
constexpr double kAspect = 4.0 / 3;
constexpr std::int64_t kHeight = 576;               // pixels
constexpr double kFromRight = 25, kFromAbove = 15;  // degrees
constexpr double kFlat = 0.05;                      // what is thinner than this share of its size is looked at head on
constexpr double kMargin = 1.06;

void give(Node& node, const char* name, Property::Value value, const SourceLocation& place) {
  node.set(name, std::move(value));
  node.properties.back().location = node.properties.back().name_location = place;
}

Node make_node(const char* kind, const char* plugin, const SourceLocation& place) {
  Node node(kind, plugin);
  node.location = node.plugin_location = place;
  return node;
}

std::array<glm::dvec3, 8> corners_of(const Bounds& bounds) {
  std::array<glm::dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    for (int c = 0; c < 3; ++c)
      corners[i][c] = (i >> static_cast<unsigned>(c) & 1u) != 0 ? bounds.upper[c] : bounds.lower[c];
  }
  return corners;
}

/// Where the camera is, seen from the box: unit.
glm::dvec3 direction_to_camera(const Bounds& bounds) {
  const glm::dvec3 sides = bounds.sides();
  const double size = std::max({sides.x, sides.y, sides.z});
  if (sides.z < kFlat * size) return {0, 0, 1};
  if (sides.y < kFlat * size) return glm::normalize(glm::dvec3(0, 1, 0.6));
  const double right = glm::radians(kFromRight), above = glm::radians(kFromAbove);
  return {std::cos(above) * std::sin(right), std::sin(above), std::cos(above) * std::cos(right)};
}

double smooth(double from, double to, double x) { return glm::smoothstep(from, to, x); }

}  // namespace

void Bounds::add(const glm::dvec3& point) { lower = glm::min(lower, point), upper = glm::max(upper, point); }

void Bounds::add(const Bounds& other, const glm::dmat4& to_world) {
  if (other.is_empty()) return;
  for (const glm::dvec3& corner : corners_of(other)) add(glm::dvec3(to_world * glm::dvec4(corner, 1)));
}

Bounds bounds_of(const Mesh& mesh) {
  Bounds bounds;
  for (const std::uint32_t i : mesh.triangles) {
    const float* p = &mesh.positions[3 * std::size_t{i}];
    bounds.add(glm::dvec3(p[0], p[1], p[2]));
  }
  return bounds;
}

void add_film(Node& sensor, double aspect, const SourceLocation& place) {
  Node film = make_node("film", "hdrfilm", place);
  give(film, "width", std::clamp<std::int64_t>(std::llround(static_cast<double>(kHeight) * aspect), 16, 8192), place);
  give(film, "height", kHeight, place);
  sensor.add(std::move(film));
  Node sampler = make_node("sampler", "sobol", place);
  give(sampler, "sample_count", std::int64_t{64}, place);
  sensor.add(std::move(sampler));
}

Node sensor_around(const Bounds& given, const SourceLocation& place) {
  Bounds bounds = given;
  if (bounds.is_empty()) bounds.add(glm::dvec3(-1)), bounds.add(glm::dvec3(1));
  if (bounds.lower == bounds.upper) bounds.lower -= 1.0, bounds.upper += 1.0;
  const glm::dvec3 back = direction_to_camera(bounds), center = bounds.center();
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back)), up = glm::cross(back, right);
  const double tan_y = std::tan(glm::radians(kFieldOfView / 2)), tan_x = tan_y * kAspect;
  double distance = 0, nearest = 0, farthest = 0;
  for (const glm::dvec3& corner : corners_of(bounds)) {
    const glm::dvec3 offset = corner - center;
    const double towards = glm::dot(offset, back);
    distance = std::max({distance, towards + kMargin * std::abs(glm::dot(offset, right)) / tan_x,
                         towards + kMargin * std::abs(glm::dot(offset, up)) / tan_y});
    nearest = std::max(nearest, towards), farthest = std::max(farthest, -towards);
  }
  Node sensor = make_node("sensor", "perspective", place);
  give(sensor, "fov", kFieldOfView, place);
  give(sensor, "fov_axis", std::string("y"), place);
  give(sensor, "near_clip", distance / 1000, place);
  give(sensor, "far_clip", 1000 * (distance + farthest), place);
  // Ours look along +z, with +x to the left.
  give(sensor, "to_world",
       to_transform(glm::dmat4(glm::dvec4(-right, 0), glm::dvec4(up, 0), glm::dvec4(-back, 0),
                               glm::dvec4(center + distance * back, 1))),
       place);
  add_film(sensor, kAspect, place);
  return sensor;
}

Node studio_sky(const SourceLocation& place) {
  constexpr int kWidth = 256, kRows = 128;
  Image image;
  image.width = kWidth, image.height = kRows;
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, {}});
  const glm::dvec3 lamp = glm::normalize(glm::dvec3(-0.55, 0.8, 0.6));
  for (int row = 0; row < kRows; ++row) {
    const double polar = std::numbers::pi * (row + 0.5) / kRows;
    for (int column = 0; column < kWidth; ++column) {
      // The columns to the left of the middle, which is at +z, are towards +x.
      const double turn = 2 * std::numbers::pi * (0.5 - (column + 0.5) / kWidth);
      const glm::dvec3 w(std::sin(polar) * std::sin(turn), std::cos(polar), std::sin(polar) * std::cos(turn));
      const double sky = 0.15 + 0.75 * smooth(-0.3, 1, w.y);
      const double value = sky + 4.5 * smooth(0.88, 0.97, glm::dot(w, lamp));
      for (Channel& channel : image.channels) channel.values.push_back(static_cast<float>(value));
    }
  }
  Node sky = make_node("emitter", "envmap", place);
  give(sky, "image", std::make_shared<const Image>(std::move(image)), place);
  return sky;
}

Node studio_floor(const Bounds& bounds, const SourceLocation& place) {
  const glm::dvec3 center = bounds.center(), sides = bounds.sides();
  const double radius = 30 * std::max({sides.x, sides.y, sides.z, 1e-6});
  Node floor = make_node("shape", "disk", place);
  const glm::dvec3 middle(center.x, bounds.lower.y - 1e-4 * std::max(sides.y, 1e-6), center.z);
  glm::dmat4 to_world = glm::translate(glm::dmat4(1), middle);
  to_world = glm::rotate(to_world, -std::numbers::pi / 2, glm::dvec3(1, 0, 0));
  give(floor, "to_world", to_transform(glm::scale(to_world, glm::dvec3(radius))), place);
  Node bsdf = make_node("bsdf", "diffuse", place);
  give(bsdf, "reflectance", 0.4, place);
  floor.add(std::move(bsdf));
  return floor;
}

Node studio_integrator(const SourceLocation& place) {
  Node integrator = make_node("integrator", "path", place);
  give(integrator, "max_depth", std::int64_t{32}, place);
  return integrator;
}

}  // namespace norrsken
