#include "camera/meter_host.h"

#include <fmt/core.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <vector>

#include "base/text.h"
#include "camera/camera_host.h"
#include "tables/meter_tables.h"

namespace norrsken {
namespace {

struct Piece {
  MeterKind kind;
  double area;
  glm::dmat3 linear;  ///< its third column takes the normal of flat pieces
  glm::dvec3 origin;
  double side = 1;
};

glm::dvec3 to_dvec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

Piece flat_piece(MeterKind kind, const glm::dvec3& origin, const glm::dvec3& edge1, const glm::dvec3& edge2) {
  const glm::dvec3 normal = glm::cross(edge1, edge2);
  const double area = glm::length(normal);
  // Triangles without an area are never chosen.
  const glm::dvec3 unit = area > 0 ? normal / area : glm::dvec3(0, 0, 1);
  return {kind, kind == MeterKind::triangle ? area / 2 : area, {edge1, edge2, unit}, origin};
}

std::vector<Piece> pieces_of(const MeshData& mesh) {
  const auto corner = [&](std::size_t triangle, std::size_t k) {
    return to_dvec(mesh.positions[mesh.triangles[triangle][k]]);
  };
  // A rectangle is one piece, whose coordinates are the film's.
  if (mesh.triangles.size() == 2 && mesh.positions.size() == 4) {
    const glm::dvec3 p[] = {to_dvec(mesh.positions[0]), to_dvec(mesh.positions[1]), to_dvec(mesh.positions[2]),
                            to_dvec(mesh.positions[3])};
    const double size = glm::length(p[2] - p[0]);
    Piece piece = flat_piece(MeterKind::parallelogram, p[0], p[1] - p[0], p[3] - p[0]);
    const glm::dvec3 front = glm::cross(corner(0, 1) - corner(0, 0), corner(0, 2) - corner(0, 0));
    if (glm::dot(front, piece.linear[2]) < 0) piece.side = -1;
    if (glm::length(p[0] + p[2] - p[1] - p[3]) <= 1e-6 * size) return {piece};
  }
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    pieces.push_back(
        flat_piece(MeterKind::triangle, corner(i, 0), corner(i, 1) - corner(i, 0), corner(i, 2) - corner(i, 0)));
  }
  return pieces;
}

/// Empty if the surface is one that nothing samples.
std::vector<Piece> pieces_of(const ShapeGeometry& surface) {
  if (surface.analytic) {
    const AnalyticShape& shape = *surface.analytic;
    if (shape.kind != AnalyticKind::disk && shape.kind != AnalyticKind::cylinder) return {};
    const MeterKind kind = shape.kind == AnalyticKind::disk ? MeterKind::disk : MeterKind::cylinder;
    Piece piece{kind, shape.area, glm::dmat3(shape.world_from_local), glm::dvec3(shape.world_from_local[3])};
    if (kind == MeterKind::disk) {
      // Normals go through the inverse transpose.
      const glm::dvec3 normal = glm::normalize(glm::cross(piece.linear[0], piece.linear[1]));
      piece.side = glm::dot(normal, piece.linear[2]) < 0 ? -1 : 1;
      piece.linear[2] = normal;
    }
    if (shape.flip_normals) piece.side = -piece.side;
    return {piece};
  }
  std::vector<Piece> pieces = pieces_of(surface.mesh);
  for (const ShapeGeometry::Sphere& sphere : surface.spheres) {
    pieces.push_back({MeterKind::sphere, 4 * std::numbers::pi * sphere.radius * sphere.radius,
                      glm::dmat3(sphere.radius), sphere.center, sphere.flip_normals ? -1.0 : 1.0});
  }
  return pieces;
}

void append(const Piece& piece, double begin, double share, Array<float>& meter) {
  meter.push_back(static_cast<float>(begin));
  meter.push_back(static_cast<float>(share));
  meter.push_back(std::bit_cast<float>(piece.kind));
  meter.push_back(static_cast<float>(piece.side));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) meter.push_back(static_cast<float>(piece.linear[column][row]));
    meter.push_back(static_cast<float>(piece.origin[row]));
  }
}

}  // namespace

CameraRecord make_meter(CameraKind kind) {
  CameraRecord meter{};
  meter.kind = kind;
  meter.far_clip = static_cast<float>(kFarthest);
  return meter;
}

glm::dvec3 read_direction(Parameters& p, const PointParameter& direction) {
  const glm::dvec3 value = p.read(direction);
  const double length = glm::length(value);
  if (length > 0) return value / length;
  p.error(direction.name, fmt::format("'{}' is a vector of length 0", direction.name), "a direction, of any length");
  return {0, 0, 1};
}

glm::dvec3 direction_of(const glm::dmat4& to_world) { return glm::normalize(glm::dvec3(to_world[2])); }

void set_surface(CameraRecord& meter, const ShapeGeometry& surface, const Node& node, Parameters& p, Sensors& sensors) {
  const std::vector<Piece> pieces = pieces_of(surface);
  double whole = 0;
  for (const Piece& piece : pieces) whole += piece.area;
  if (!(whole > 0)) {
    p.diagnostics().error(node.location, fmt::format("shape {} has no surface that is sampled", quoted(node.plugin)),
                          "a mesh, sphere, disk or cylinder");
    return;
  }
  Array<float>& table = sensors.meter();
  meter.first_piece = static_cast<std::uint32_t>(table.size());
  meter.piece_count = static_cast<std::uint32_t>(std::bit_ceil(pieces.size()));
  double begin = 0;
  for (const Piece& piece : pieces) {
    append(piece, begin, piece.area / whole, table);
    begin += piece.area / whole;
  }
  for (std::size_t i = pieces.size(); i < meter.piece_count; ++i) append(pieces[0], 2, 1, table);  // never chosen
}

}  // namespace norrsken
