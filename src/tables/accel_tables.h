// What kernels intersect: planes with convex polygons for small scenes, plain triangles as the reference, a hierarchy of
// bounding volumes, or Embree.
#pragma once

#include <cstdint>
#include <vector>

#include "tables/bvh_tables.h"
#include "tables/scene_tables.h"

namespace norrsken {

enum class AccelKind : std::uint32_t { planes, moller_trumbore, bvh, embree };

/// A plane n.p = c with |n_k| = 1 for its axis k, so that t = (c - n.o) / (n.d) takes two products for each dot
/// product. Source: Wald, "Realtime Ray Tracing and Interactive Global Illumination", PhD thesis 2004, section 7.1.1.
struct PlaneRecord {
  float nu, nv;  ///< the normal's components along axes u = (k + 1) % 3 and v = (k + 2) % 3, over n_k
  float c;
  std::uint32_t back_flip;  ///< 0x80000000 if n_k > 0, else 0: turns the sign of n.d into "seen from the back"
  std::uint32_t first_polygon, polygon_count;
};

enum class PolygonKind : std::uint32_t { parallelogram, convex };

/// A convex polygon in its plane's (u, v) coordinates. A point is inside where for
///   parallelogram: both |a.(u, v, 1)| <= 1 of two rows a,
///   convex: all rows a.(u, v, 1) >= 0.
/// Rows are scaled so that the largest value inside is about 1, and widened by a few ulps: neighbours overlap rather
/// than leave a gap.
struct PolygonRecord {
  PolygonKind kind;
  std::uint32_t first_row, row_count;
  std::uint32_t primitive;  ///< the first of the triangles that it is made of
};

struct PolygonRow {
  float u, v, w;
};

struct SphereRecord {
  float center[3];
  float radius;
  std::uint32_t primitive;
  std::uint32_t back_flip;  ///< 0x80000000 if the normal points to the centre
};

/// The planes of one set of polygons, in order of their axis; planes of axis k are [axis_begin[k], axis_begin[k + 1]).
struct PlaneSet {
  std::uint32_t axis_begin[4] = {};
};

/// A geometry of an Embree scene: what its element i is in `surfaces`.
struct EmbreeGeometry {
  std::uint32_t first_primitive;
  std::uint32_t step;  ///< 0 if all elements are one primitive, such as the voxels of a grid; otherwise 1
};

/// Borrowed arrays. `all` are the planes for closest hits. `occluders` are those that can come between two points of
/// the scene; a plane that has the whole scene on one side cannot. `emitters` are those of area lights.
struct AccelView {
  AccelKind kind = AccelKind::planes;
  const PlaneRecord* planes = nullptr;
  const PolygonRecord* polygons = nullptr;
  const PolygonRow* rows = nullptr;
  const SphereRecord* spheres = nullptr;
  std::uint32_t sphere_count = 0;
  PlaneSet all, occluders, emitters;
  std::uint32_t emitter_sphere_count = 0;  ///< they come first among the spheres
  BvhView bvh;                             ///< of the triangles
  /// What stands beside it besides the spheres: the primitives from first_analytic on.
  const AnalyticRecord* analytics = nullptr;
  std::uint32_t analytic_count = 0, first_analytic = kNone;
  void* embree_scene = nullptr;  ///< RTCScene
  /// Geometries by their ID, first the world's; those of instance i begin at instance_geometries[i].
  const EmbreeGeometry* embree_geometries = nullptr;
  const std::uint32_t* instance_geometries = nullptr;
  std::uint32_t first_instance = 0;  ///< Embree's ID of the first instance, the others follow
  /// Of each triangle: what the rounding of tests that begin from its corners is relative to, along its normal. Null where
  /// it does not depend on them: for planes, and for the hierarchy, which meets what is near in double precision.
  const float* rounding_extents = nullptr;
};

}  // namespace norrsken
