#include "accel/polygons.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace norrsken {
namespace {

glm::dvec3 vertex_position(const SceneTables& scene, std::uint32_t vertex) {
  const float* p = scene.positions.data() + std::size_t{3} * vertex;
  return {p[0], p[1], p[2]};
}

/// Orders points exactly, so that vertices of different meshes at one place count as one.
struct PointLess {
  bool operator()(const glm::dvec3& a, const glm::dvec3& b) const {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  }
};

struct Triangle {
  glm::dvec3 corners[3];
  glm::dvec3 normal;
  double offset, area;
};

Triangle make_triangle(const SceneTables& scene, std::uint32_t i) {
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) t.corners[k] = vertex_position(scene, scene.triangle_vertices[3 * i + k]);
  const glm::dvec3 n = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
  t.area = glm::length(n) / 2;
  t.normal = n / (2 * t.area);
  t.offset = glm::dot(t.normal, t.corners[0]);
  return t;
}

glm::dvec2 texcoord(const SceneTables& scene, std::uint32_t vertex) {
  const float* c = scene.texcoords.data() + std::size_t{2} * vertex;
  return {c[0], c[1]};
}

/// Whether the texture coordinates of b's corners are those that a's, continued, have there.
bool same_texcoords(const SceneTables& scene, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t *va = &scene.triangle_vertices[3 * a], *vb = &scene.triangle_vertices[3 * b];
  const glm::dvec3 origin = vertex_position(scene, va[0]);
  const glm::dvec3 e1 = vertex_position(scene, va[1]) - origin, e2 = vertex_position(scene, va[2]) - origin;
  const glm::dvec2 c = texcoord(scene, va[0]), d1 = texcoord(scene, va[1]) - c, d2 = texcoord(scene, va[2]) - c;
  const double a11 = glm::dot(e1, e1), a12 = glm::dot(e1, e2), a22 = glm::dot(e2, e2), det = a11 * a22 - a12 * a12;
  return std::all_of(vb, vb + 3, [&](std::uint32_t vertex) {
    const glm::dvec3 p = vertex_position(scene, vertex), q = p - origin;
    const double q1 = glm::dot(q, e1), q2 = glm::dot(q, e2);
    const glm::dvec2 expected = c + d1 * ((a22 * q1 - a12 * q2) / det) + d2 * ((a11 * q2 - a12 * q1) / det);
    const glm::dvec2 gap = glm::abs(expected - texcoord(scene, vertex));
    // What rounding of the positions may come to in them: they change by d1 over e1.
    const double slope = std::max(glm::length(d1) / std::sqrt(a11), glm::length(d2) / std::sqrt(a22));
    return std::max(gap.x, gap.y) <= kCoplanar * (slope * (magnitude(p) + magnitude(q)) + glm::length(expected));
  });
}

bool same_surface(const SceneTables& scene, Variation at_least, std::uint32_t a, std::uint32_t b) {
  const SurfaceRecord &s = scene.surfaces[a], &t = scene.surfaces[b];
  if (s.shape != t.shape || s.material_front != t.material_front || s.material_back != t.material_back) return false;
  const ShapeRecord& shape = scene.shapes[s.shape];
  if (shape.smooth != 0 || scene.light_of(a) != scene.light_of(b)) return false;
  switch (std::max(shape.variation, at_least)) {
    case Variation::none:
      return true;
    case Variation::over_uv:  // without texture coordinates they are each triangle's barycentric ones
      return shape.has_texcoords != 0 && same_texcoords(scene, a, b);
    case Variation::by_triangle:
      break;
  }
  return false;
}

bool in_plane(const glm::dvec3& normal, double offset, const glm::dvec3& p) {
  return std::abs(glm::dot(normal, p) - offset) <= kCoplanar * magnitude(p);
}

bool same_plane(const Triangle& a, const Triangle& b) {
  return glm::dot(a.normal, b.normal) > 1 - kCoplanar * kCoplanar &&
         std::all_of(std::begin(b.corners), std::end(b.corners),
                     [&](const glm::dvec3& p) { return in_plane(a.normal, a.offset, p); });
}

/// The corners of a convex outline without those that lie on a straight line.
std::vector<glm::dvec3> drop_collinear(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
  std::vector<glm::dvec3> kept;
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3 in = corners[i] - corners[(i + n - 1) % n], out = corners[(i + 1) % n] - corners[i];
    if (glm::dot(glm::cross(in, out), normal) > kCoplanar * glm::length(in) * glm::length(out))
      kept.push_back(corners[i]);
  }
  return kept;
}

bool is_convex(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
  const std::size_t n = corners.size();
  double turning = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec3 in = corners[i] - corners[(i + n - 1) % n], out = corners[(i + 1) % n] - corners[i];
    const double sine = glm::dot(glm::cross(in, out), normal), cosine = glm::dot(in, out);
    if (sine < -kCoplanar * glm::length(in) * glm::length(out)) return false;
    turning += std::atan2(std::max(sine, 0.0), cosine);
  }
  // Once around: a star also turns left at every corner, but twice around.
  return turning < 3 * glm::pi<double>();
}

/// The outline of triangles that share edges: the directed edges that have no opposite. Empty if the edges do not form
/// one simple loop (a hole, a double cover, a single touching corner).
std::vector<glm::dvec3> outline(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& members) {
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  std::map<glm::dvec3, std::size_t, PointLess> ids;
  std::vector<glm::dvec3> points;
  const auto id = [&](const glm::dvec3& p) {
    const auto [it, added] = ids.emplace(p, points.size());
    if (added) points.push_back(p);
    return it->second;
  };
  for (const std::uint32_t m : members) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = id(triangles[m].corners[k]), b = id(triangles[m].corners[(k + 1) % 3]);
      if (const auto opposite = edges.find({b, a}); opposite != edges.end()) {
        edges.erase(opposite);
      } else if (++edges[{a, b}] > 1) {
        return {};
      }
    }
  }
  std::map<std::size_t, std::size_t> next;
  for (const auto& [edge, uses] : edges) {
    if (!next.emplace(edge.first, edge.second).second) return {};
  }
  std::vector<glm::dvec3> loop;
  if (next.empty()) return loop;
  const std::size_t first = next.begin()->first;
  std::size_t at = first;
  do {
    loop.push_back(points[at]);
    const auto it = next.find(at);
    if (it == next.end()) return {};
    at = it->second;
  } while (at != first && loop.size() <= next.size());
  return loop.size() == next.size() ? loop : std::vector<glm::dvec3>{};
}

bool share_edge(const Triangle& a, const Triangle& b) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (a.corners[i] == b.corners[(k + 1) % 3] && a.corners[(i + 1) % 3] == b.corners[k]) return true;
    }
  }
  return false;
}

class Merger {
 public:
  Merger(const SceneTables& scene, Variation variation) : scene_(scene), variation_(variation) {
    const std::uint32_t n = scene.triangle_count();
    triangles_.reserve(n);
    for (std::uint32_t i = 0; i < n; ++i) triangles_.push_back(make_triangle(scene, i));
  }

  std::vector<ConvexPolygon> run() {
    std::vector<bool> done(triangles_.size(), false);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      if (done[i]) continue;
      const std::vector<std::uint32_t> patch = connected_patch(i, done);
      for (const std::uint32_t m : patch) done[m] = true;
      add_patch(patch);
    }
    return std::move(polygons_);
  }

 private:
  /// All triangles not yet done that hang together with `seed` in one plane of one surface.
  std::vector<std::uint32_t> connected_patch(std::uint32_t seed, const std::vector<bool>& done) const {
    std::vector<std::uint32_t> patch{seed};
    std::vector<bool> taken = done;
    taken[seed] = true;
    for (std::size_t at = 0; at < patch.size(); ++at) {
      for (std::uint32_t i = seed + 1; i < triangles_.size(); ++i) {
        if (!taken[i] && same_surface(scene_, variation_, seed, i) && same_plane(triangles_[seed], triangles_[i]) &&
            share_edge(triangles_[patch[at]], triangles_[i])) {
          taken[i] = true;
          patch.push_back(i);
        }
      }
    }
    return patch;
  }

  bool try_add(const std::vector<std::uint32_t>& members) {
    const Triangle& t = triangles_[members.front()];
    const std::vector<glm::dvec3> loop = outline(triangles_, members);
    if (loop.size() < 3 || !is_convex(loop, t.normal)) return false;
    polygons_.push_back(
        {drop_collinear(loop, t.normal), t.normal, t.offset, *std::min_element(members.begin(), members.end())});
    return true;
  }

  /// The whole patch if it is convex; otherwise pairs of neighbours that are; otherwise single triangles.
  void add_patch(std::vector<std::uint32_t> patch) {
    if (try_add(patch)) return;
    while (!patch.empty()) {
      const std::uint32_t a = patch.front();
      patch.erase(patch.begin());
      const auto partner = std::find_if(patch.begin(), patch.end(), [&](std::uint32_t b) {
        return share_edge(triangles_[a], triangles_[b]) && try_add({a, b});
      });
      if (partner != patch.end()) {
        patch.erase(partner);
      } else {
        const Triangle& t = triangles_[a];
        polygons_.push_back({{t.corners[0], t.corners[1], t.corners[2]}, t.normal, t.offset, a});
      }
    }
  }

  const SceneTables& scene_;
  Variation variation_;
  std::vector<Triangle> triangles_;
  std::vector<ConvexPolygon> polygons_;
};

}  // namespace

double magnitude(const glm::dvec3& p) {
  const glm::dvec3 a = glm::abs(p);
  return std::max({a.x, a.y, a.z});
}

bool coplanar(const ConvexPolygon& a, const ConvexPolygon& b) {
  return glm::dot(a.normal, b.normal) > 1 - kCoplanar * kCoplanar &&
         std::all_of(b.corners.begin(), b.corners.end(),
                     [&](const glm::dvec3& p) { return in_plane(a.normal, a.offset, p); });
}

double scene_scale(const SceneTables& scene) {
  double scale = std::numeric_limits<double>::min();
  for (const float p : scene.positions) scale = std::max(scale, std::abs(static_cast<double>(p)));
  for (std::size_t i = scene.triangle_count(); i < scene.triangle_count() + scene.sphere_count(); ++i) {
    const float* g = scene.surfaces[i].geometry;
    for (int k = 0; k < 3; ++k)
      scale = std::max(scale, std::abs(static_cast<double>(g[k])) + static_cast<double>(g[3]));
  }
  return scale;
}

std::vector<ConvexPolygon> merge_triangles(const SceneTables& scene, Variation variation) {
  return Merger(scene, variation).run();
}

}  // namespace norrsken
