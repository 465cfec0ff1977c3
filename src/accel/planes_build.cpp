#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "accel/build.h"
#include "accel/polygons.h"

namespace norrsken {
namespace {

int dominant_axis(const glm::dvec3& n) {
  const glm::dvec3 a = glm::abs(n);
  return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

struct Point2 {
  double u, v;
};

/// Builds the planes of one set of polygons at the end of the tables.
class PlaneSetBuilder {
 public:
  explicit PlaneSetBuilder(PlaneTables& tables) : tables_(tables) {}

  PlaneSet build(const std::vector<const ConvexPolygon*>& polygons) {
    PlaneSet set;
    for (int axis = 0; axis < 3; ++axis) {
      set.axis_begin[axis] = static_cast<std::uint32_t>(tables_.planes.size());
      std::vector<const ConvexPolygon*> rest;
      for (const ConvexPolygon* p : polygons) {
        if (dominant_axis(p->normal) == axis) rest.push_back(p);
      }
      while (!rest.empty()) {
        const ConvexPolygon* first = rest.front();
        const auto others = std::stable_partition(rest.begin(), rest.end(), [&](const ConvexPolygon* p) {
          return p->normal == first->normal && p->offset == first->offset;
        });
        add_plane(axis, {rest.begin(), others});
        rest.erase(rest.begin(), others);
      }
    }
    set.axis_begin[3] = static_cast<std::uint32_t>(tables_.planes.size());
    return set;
  }

 private:
  void add_plane(int axis, const std::vector<const ConvexPolygon*>& polygons) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const glm::dvec3 n = polygons.front()->normal;
    PlaneRecord plane;
    plane.nu = static_cast<float>(n[u] / n[axis]);
    plane.nv = static_cast<float>(n[v] / n[axis]);
    plane.c = static_cast<float>(polygons.front()->offset / n[axis]);
    plane.back_flip = n[axis] > 0 ? 0x80000000u : 0u;
    plane.first_polygon = static_cast<std::uint32_t>(tables_.polygons.size());
    plane.polygon_count = static_cast<std::uint32_t>(polygons.size());
    tables_.planes.push_back(plane);
    for (const ConvexPolygon* polygon : polygons) {
      std::vector<Point2> corners;
      for (const glm::dvec3& c : polygon->corners) corners.push_back({c[u], c[v]});
      add_polygon(corners, polygon->primitive);
    }
  }

  void add_polygon(const std::vector<Point2>& corners, std::uint32_t primitive) {
    PolygonRecord record;
    record.primitive = primitive;
    record.first_row = static_cast<std::uint32_t>(tables_.rows.size());
    record.kind = is_parallelogram(corners) ? PolygonKind::parallelogram : PolygonKind::convex;
    if (record.kind == PolygonKind::parallelogram) {
      // 2 s - 1 and 2 t - 1 of the coordinates (s, t) along the two edges.
      add_row(corners, edge_function(corners[0], corners[1]), 2, -1);
      add_row(corners, edge_function(corners[0], corners[3]), 2, -1);
    } else {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        add_row(corners, edge_function(corners[i], corners[(i + 1) % corners.size()]), 1, 0);
      }
    }
    record.row_count = static_cast<std::uint32_t>(tables_.rows.size()) - record.first_row;
    tables_.polygons.push_back(record);
  }

  static bool is_parallelogram(const std::vector<Point2>& c) {
    if (c.size() != 4) return false;
    const double du = c[0].u - c[1].u + c[2].u - c[3].u, dv = c[0].v - c[1].v + c[2].v - c[3].v;
    double largest = 0;
    for (const Point2& p : c) largest = std::max({largest, std::abs(p.u), std::abs(p.v)});
    return std::abs(du) <= kCoplanar * largest && std::abs(dv) <= kCoplanar * largest;
  }

  struct Line {
    double u, v, w;
    double at(const Point2& p) const { return u * p.u + v * p.v + w; }
  };

  /// Zero on the line through both points.
  static Line edge_function(const Point2& a, const Point2& b) {
    Line e{a.v - b.v, b.u - a.u, 0};
    e.w = -(e.u * a.u + e.v * a.v);
    return e;
  }

  /// The line scaled to [0, 1] over the polygon, then to scale * line + shift, and widened by what rounding may do.
  void add_row(const std::vector<Point2>& corners, Line e, double scale, double shift) {
    double extreme = 0, magnitude = 0;
    for (const Point2& c : corners) {
      if (std::abs(e.at(c)) > std::abs(extreme)) extreme = e.at(c);
    }
    e = {e.u / extreme, e.v / extreme, e.w / extreme};
    for (const Point2& c : corners) {
      magnitude = std::max(magnitude, std::abs(e.u * c.u) + std::abs(e.v * c.v) + std::abs(e.w));
    }
    const double slack = 8 * 0x1p-24 * scale * magnitude;
    Line row{e.u * scale, e.v * scale, e.w * scale + shift};
    if (shift != 0) {
      row = {row.u / (1 + slack), row.v / (1 + slack), row.w / (1 + slack)};
    } else {
      row.w += slack;
    }
    tables_.rows.push_back({static_cast<float>(row.u), static_cast<float>(row.v), static_cast<float>(row.w)});
  }

  PlaneTables& tables_;
};

/// Whether everything (triangles, spheres, lights) is on one side of the polygon's plane, and its other side scatters
/// nothing: then the polygon cannot come between two points that light travels between.
bool bounds_the_scene(const SceneTables& scene, const ConvexPolygon& polygon) {
  bool all_in_front = true, all_behind = true;
  const auto extend = [&](const float* p, double radius) {
    const glm::dvec3 q(p[0], p[1], p[2]);
    const double d = glm::dot(polygon.normal, q) - polygon.offset,
                 tolerance = kCoplanar * std::max(magnitude(q), radius);
    all_in_front = all_in_front && d - radius >= -tolerance;
    all_behind = all_behind && d + radius <= tolerance;
  };
  for (const std::uint32_t vertex : scene.triangle_vertices)
    extend(scene.positions.data() + std::size_t{3} * vertex, 0);
  for (std::size_t i = scene.triangle_count(); i < scene.triangle_count() + scene.sphere_count(); ++i) {
    extend(scene.surfaces[i].geometry, static_cast<double>(scene.surfaces[i].geometry[3]));
  }
  for (const LightRecord& light : scene.lights) {
    switch (light.kind) {
      case LightKind::triangle:
      case LightKind::parallelogram:
      case LightKind::sphere:
        break;  // on surfaces
      case LightKind::point:
        extend(light.origin, 0);
        break;
      default:
        return false;  // from outside, perhaps
    }
  }
  const SurfaceRecord& surface = scene.surfaces[polygon.primitive];
  const bool front_shut = material_kind(surface.material_front) == BsdfKind::absorb;
  const bool back_shut = material_kind(surface.material_back) == BsdfKind::absorb;
  return (all_in_front && back_shut) || (all_behind && front_shut);
}

/// Gives coplanar polygons one plane, to the bit: the sets are built apart, and a light must not find itself an ulp
/// nearer as an occluder than as an emitter.
void share_planes(std::vector<ConvexPolygon>& polygons) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const auto end = polygons.begin() + static_cast<std::ptrdiff_t>(i);
    const auto same =
        std::find_if(polygons.begin(), end, [&](const ConvexPolygon& p) { return coplanar(p, polygons[i]); });
    if (same == end) continue;
    polygons[i].normal = same->normal;
    polygons[i].offset = same->offset;
  }
}

}  // namespace

PlaneTables build_planes(const SceneTables& scene, Variation variation) {
  std::vector<ConvexPolygon> polygons = merge_triangles(scene, variation);
  share_planes(polygons);
  PlaneTables tables;
  PlaneSetBuilder builder(tables);
  const auto build_set = [&](const std::function<bool(const ConvexPolygon&)>& wanted) {
    std::vector<const ConvexPolygon*> chosen;
    for (const ConvexPolygon& p : polygons) {
      if (wanted(p)) chosen.push_back(&p);
    }
    return builder.build(chosen);
  };
  tables.all = build_set([](const ConvexPolygon&) { return true; });
  tables.occluders = build_set([&](const ConvexPolygon& p) { return !bounds_the_scene(scene, p); });
  tables.emitters = build_set([&](const ConvexPolygon& p) { return scene.light_of(p.primitive) != kNone; });
  return tables;
}

Array<SphereRecord> build_spheres(const SceneTables& scene) {
  Array<SphereRecord> spheres;
  const std::uint32_t first = scene.triangle_count();
  for (std::uint32_t i = first; i < first + scene.sphere_count(); ++i) {
    const SurfaceRecord& s = scene.surfaces[i];
    spheres.push_back({{s.geometry[0], s.geometry[1], s.geometry[2]},
                       s.geometry[3],
                       i,
                       scene.shapes[s.shape].flip_normals != 0 ? 0x80000000u : 0u});
  }
  return spheres;
}

}  // namespace norrsken
