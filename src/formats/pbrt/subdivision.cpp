// The shape loopsubdiv: the limit surface of Loop's subdivision (Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987).
#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "formats/pbrt/mesh_maker.h"

namespace norrsken::pbrt {
namespace {

using Index = std::uint32_t;
using Edge = std::pair<Index, Index>;  ///< the smaller vertex first

Edge edge_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

struct Surface {
  Array<glm::dvec3> points;
  Array<Index> triangles;
};

struct EdgeFaces {
  Index number = 0;  ///< of the vertex that the edge becomes
  Index opposite[2] = {};
  int faces = 0;
};

/// What is around each vertex.
struct Ring {
  glm::dvec3 sum{0};           ///< of the neighbours
  glm::dvec3 boundary_sum{0};  ///< of those along the boundary
  int neighbours = 0, boundary = 0;
};

std::map<Edge, EdgeFaces> edges_of(const Surface& surface) {
  std::map<Edge, EdgeFaces> edges;
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      EdgeFaces& edge = edges[edge_of(surface.triangles[t + k], surface.triangles[t + (k + 1) % 3])];
      if (edge.faces < 2) edge.opposite[edge.faces] = surface.triangles[t + (k + 2) % 3];
      ++edge.faces;
    }
  }
  return edges;
}

Array<Ring> rings_of(const Surface& surface, const std::map<Edge, EdgeFaces>& edges) {
  Array<Ring> rings(surface.points.size());
  for (const auto& [edge, faces] : edges) {
    for (const auto& [vertex, other] : {edge, Edge(edge.second, edge.first)}) {
      Ring& ring = rings[vertex];
      ring.sum += surface.points[other];
      ++ring.neighbours;
      if (faces.faces != 1) continue;
      ring.boundary_sum += surface.points[other];
      ++ring.boundary;
    }
  }
  return rings;
}

double weight_of(int neighbours) { return neighbours == 3 ? 3. / 16 : 3. / (8. * neighbours); }

/// A vertex with weight `each` for every neighbour, or `along` for those of the boundary that it is on.
glm::dvec3 smoothed(const glm::dvec3& point, const Ring& ring, double each, double along) {
  if (ring.neighbours == 0) return point;
  if (ring.boundary > 0) return (1 - ring.boundary * along) * point + along * ring.boundary_sum;
  return (1 - ring.neighbours * each) * point + each * ring.sum;
}

Surface subdivided(const Surface& coarse) {
  std::map<Edge, EdgeFaces> edges = edges_of(coarse);
  const Array<Ring> rings = rings_of(coarse, edges);
  Surface fine;
  fine.points.reserve(coarse.points.size() + edges.size());
  for (std::size_t i = 0; i < coarse.points.size(); ++i)
    fine.points.push_back(smoothed(coarse.points[i], rings[i], weight_of(rings[i].neighbours), 1. / 8));
  for (auto& [edge, faces] : edges) {
    faces.number = static_cast<Index>(fine.points.size());
    const glm::dvec3 ends = coarse.points[edge.first] + coarse.points[edge.second];
    fine.points.push_back(faces.faces == 1
                              ? ends / 2.0
                              : 3. / 8 * ends +
                                    1. / 8 * (coarse.points[faces.opposite[0]] + coarse.points[faces.opposite[1]]));
  }
  fine.triangles.reserve(4 * coarse.triangles.size());
  for (std::size_t t = 0; t < coarse.triangles.size(); t += 3) {
    const Index* v = &coarse.triangles[t];
    Index middle[3];
    for (std::size_t k = 0; k < 3; ++k) middle[k] = edges.at(edge_of(v[k], v[(k + 1) % 3])).number;
    for (const Index i : {v[0], middle[0], middle[2], v[1], middle[1], middle[0], v[2], middle[2], middle[1], middle[0],
                          middle[1], middle[2]})
      fine.triangles.push_back(i);
  }
  return fine;
}

}  // namespace

std::optional<Geometry> make_subdivision(Context& context, Parameters& p, const Placement& placement) {
  constexpr std::int64_t kMostLevels = 12;
  const std::int64_t levels = p.integer("levels", 3, 0, kMostLevels);
  p.text("scheme", {});
  const Array<double>*points = p.list("point3", "P", 3), *indices = p.list("integer", "indices", 3);
  if (!points || !indices) {
    if (!p.has("P") || !p.has("indices"))
      p.error(nullptr, "shape 'loopsubdiv' needs vertices and triangles", R"("point3 P" and "integer indices")");
    return std::nullopt;
  }
  Surface surface;
  for (std::size_t i = 0; i < points->size(); i += 3)
    surface.points.emplace_back((*points)[i], (*points)[i + 1], (*points)[i + 2]);
  for (const double index : *indices) {
    if (!(index >= 0 && index < static_cast<double>(surface.points.size()))) {
      p.error(p.find("integer", "indices"),
              fmt::format("{} has vertex {:g} of {}", p.object(), index, surface.points.size()),
              "vertices counted from 0");
      return std::nullopt;
    }
    surface.triangles.push_back(static_cast<Index>(index));
  }
  for (std::int64_t level = 0; level < levels; ++level) {
    // Edges and their map, about.
    const MemoryReservation working(surface.triangles.size() * (sizeof(std::pair<Edge, EdgeFaces>) + 64));
    surface = subdivided(surface);
  }
  const Array<Ring> rings = rings_of(surface, edges_of(surface));
  MeshMaker maker(context, placement.to_world, placement.reverse);
  maker.reserve(surface.points.size(), surface.triangles.size() / 3);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const int n = std::max(rings[i].neighbours, 1);
    const glm::dvec3 limit = smoothed(surface.points[i], rings[i], 1 / (n + 3 / (8 * weight_of(n))), 1. / 5);
    maker.vertex(limit, nullptr, nullptr);
  }
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3)
    maker.triangle(surface.triangles[t], surface.triangles[t + 1], surface.triangles[t + 2]);
  // pbrt walks around vertices clockwise as it makes their normals, which face the other way than the triangles do.
  if (placement.reverse == placement.is_mirrored()) maker.reverse_winding();
  auto geometry = maker.finish(p);
  if (geometry) give(geometry->node, "face_normals", false, p.place());
  return geometry;
}

}  // namespace norrsken::pbrt
