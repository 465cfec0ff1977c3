#include "accel/embree_curves.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <new>

#include "accel/embree_callbacks.h"
#include "shape/bsplinecurve.h"

namespace norrsken {
namespace {

/// How src/shape/curve.h lays out a shape's table.
struct CurveTable {
  const float* firsts;  ///< the bits of each segment's first control point
  std::uint32_t segments;

  explicit CurveTable(const ElementShape& shape) : firsts(shape.table + 1), segments(shape.record->element_count) {}

  std::uint32_t first(std::uint32_t segment) const { return std::bit_cast<std::uint32_t>(firsts[segment]); }
  const float* point(std::uint32_t i) const { return firsts + segments + std::size_t{4} * i; }
};

/// The segments of a linear curve, each the hull of two balls. Embree has them too (RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE),
/// but not for rays along a segment that does not swell, and for segments shorter than some thousandths of a unit its hits
/// are off by as much as the radius. Doubles leave nothing to be careful about.
struct HullsOfBalls {
  struct Ball {
    glm::dvec3 center;
    double radius;
  };

  static Ball ball(const float* p) { return {{p[0], p[1], p[2]}, p[3]}; }

  static void bounds_of(const void* data, unsigned segment, RTCBounds& b) {
    const CurveTable table(*static_cast<const ElementShape*>(data));
    const float *p = table.point(table.first(segment)), *q = p + 4;
    // More than rounding can do to a sum.
    const auto below = [](float x, float r) { return (x - r) - 0x1p-22f * (std::abs(x) + r); };
    const auto above = [](float x, float r) { return (x + r) + 0x1p-22f * (std::abs(x) + r); };
    b.lower_x = std::min(below(p[0], p[3]), below(q[0], q[3])),
    b.upper_x = std::max(above(p[0], p[3]), above(q[0], q[3]));
    b.lower_y = std::min(below(p[1], p[3]), below(q[1], q[3])),
    b.upper_y = std::max(above(p[1], p[3]), above(q[1], q[3]));
    b.lower_z = std::min(below(p[2], p[3]), below(q[2], q[3])),
    b.upper_z = std::max(above(p[2], p[3]), above(q[2], q[3]));
  }

  /// Where the line enters the ball; infinite where it misses it.
  static double enter(const Ball& ball, const glm::dvec3& o, const glm::dvec3& d) {
    const glm::dvec3 l = ball.center - o;
    const double d2 = glm::dot(d, d), along = glm::dot(l, d) / d2;
    const glm::dvec3 off = l - along * d;
    const double half_chord2 = (ball.radius * ball.radius - glm::dot(off, off)) / d2;
    return half_chord2 > 0 ? along - std::sqrt(half_chord2) : double{kNowhere};
  }

  /// The hull is convex, so a line enters it once: in the cone between the balls, or in one of them. Rays that start inside
  /// have that behind them.
  ///
  /// The ball around a + s e with radius r + s w touches the hull in x where its equation as a quadratic in s,
  /// g s^2 - 2 h s + |x - a|^2 - r^2 = 0 with g = e^2 - w^2 and h = (x - a) . e + r w, has one solution, s = h / g.
  static UserHit intersect(const void* data, unsigned segment, const isa_host::Vec3f& origin,
                           const isa_host::Vec3f& direction, float t_max) {
    const CurveTable table(*static_cast<const ElementShape*>(data));
    const float* p = table.point(table.first(segment));
    const Ball a = ball(p), b = ball(p + 4);
    const glm::dvec3 o(origin.x.v, origin.y.v, origin.z.v), d(direction.x.v, direction.y.v, direction.z.v);
    const double enter_a = enter(a, o, d), enter_b = enter(b, o, d);
    double t = std::min(enter_a, enter_b), s = enter_a < enter_b ? 0 : 1;

    const glm::dvec3 e = b.center - a.center, q = o - a.center;
    const double w = b.radius - a.radius, g = glm::dot(e, e) - w * w;
    if (g > 0) {
      const double h = glm::dot(q, e) + a.radius * w, dh = glm::dot(d, e);
      const double c2 = dh * dh - g * glm::dot(d, d), c1 = h * dh - g * glm::dot(q, d),
                   c0 = h * h - g * (glm::dot(q, q) - a.radius * a.radius);
      const double root = std::sqrt(c1 * c1 - c2 * c0);  // not a number where the cone is missed
      const double enter_cone = c1 > 0 ? -c0 / (c1 + root) : (root - c1) / c2;
      const double touching = (h + enter_cone * dh) / g;
      if (touching >= 0 && touching <= 1 && enter_cone < t) t = enter_cone, s = touching;
    }
    if (!(t > 0 && t < double{t_max})) return {};
    const glm::dvec3 n = q + t * d - s * e;
    return {static_cast<float>(t), {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}};
  }
};

/// B-splines are seen from outside only, as in Mitsuba; whether Embree itself leaves out the inside is a matter of how it
/// was built. It is our own normal that decides: Embree's search is content a little off the surface, where rays that leave
/// it flat seem to come from outside, the more so the smaller everything is.
void pass_from_inside(const RTCFilterFunctionNArguments* args) {
  const float* table = static_cast<const ElementShape*>(args->geometryUserPtr)->table;
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const isa_host::Vec3f o{RTCRayN_org_x(args->ray, args->N, i), RTCRayN_org_y(args->ray, args->N, i),
                            RTCRayN_org_z(args->ray, args->N, i)};
    const isa_host::Vec3f d{RTCRayN_dir_x(args->ray, args->N, i), RTCRayN_dir_y(args->ray, args->N, i),
                            RTCRayN_dir_z(args->ray, args->N, i)};
    const isa_host::Float t(RTCRayN_tfar(args->ray, args->N, i));
    const isa_host::ElementReader reader{table, 0u, RTCHitN_primID(args->hit, args->N, i), {true}};
    const isa_host::Vec3f n = isa_host::BsplineCurveShape::surface_at(reader, fma(d, t, o)).normal;
    if (dot(n, d).v >= 0) args->valid[i] = 0;
    RTCHitN_Ng_x(args->hit, args->N, i) = n.x.v;
    RTCHitN_Ng_y(args->hit, args->N, i) = n.y.v;
    RTCHitN_Ng_z(args->hit, args->N, i) = n.z.v;
  }
}

}  // namespace

RTCGeometry make_embree_linear_curves(RTCDevice device, const ElementShape& shape) {
  return make_user_geometry<HullsOfBalls>(device, &shape, shape.record->element_count);
}

RTCGeometry make_embree_bspline_curves(RTCDevice device, const ElementShape& shape) {
  constexpr std::size_t kPointBytes = 4 * sizeof(float);
  const CurveTable table(shape);
  const std::size_t points = std::size_t{table.first(table.segments - 1)} + 4;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, table.firsts, 0, sizeof(float),
                             table.segments);
  // A copy, because Embree reads control points at addresses that are multiples of 16.
  void* copy = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, kPointBytes, points);
  if (copy == nullptr) throw std::bad_alloc();
  std::memcpy(copy, table.point(0), points * kPointBytes);
  rtcSetGeometryUserData(geometry, const_cast<ElementShape*>(&shape));
  rtcSetGeometryIntersectFilterFunction(geometry, pass_from_inside);
  rtcSetGeometryOccludedFilterFunction(geometry, pass_from_inside);
  return geometry;
}

}  // namespace norrsken
