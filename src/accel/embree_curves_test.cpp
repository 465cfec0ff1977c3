// Curves in a scene: what rays meet of them, and where the next rays begin.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "isa/kernel_testing.h"
#include "tests/temporary_folder.h"
#include "wave/hits.h"

namespace norrsken {
namespace {

using isa_host::Vec3f;

glm::dvec3 to_dvec(const Vec3f& v) { return {v.x.v, v.y.v, v.z.v}; }
Vec3f to_lanes(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

struct Point {
  glm::dvec3 p;
  double r;
};

/// Where the curves stand: the size of everything, and whether in an instance.
struct Place {
  double scale;
  bool instanced;
};
const Place kPlaces[] = {{1, false}, {1, true}, {1e-3, false}, {1e3, true}};
std::string name_of(const Place& p) { return fmt::format("scale {}{}", p.scale, p.instanced ? " in an instance" : ""); }

/// A scene with one curve.
class CurveScene {
 public:
  CurveScene(const std::string& kind, const std::vector<Point>& points, const Place& place) : place_(place) {
    const TemporaryFolder folder;
    std::ofstream file(folder / "curve.txt");
    // In an instance the radii are scaled too; by the shape's own place they are not.
    const double r = place.instanced ? 1 : place.scale;
    for (const Point& c : points) file << fmt::format("{} {} {} {}\n", c.p.x, c.p.y, c.p.z, r * c.r);
    file.close();
    const double s = place.scale;
    const std::string to_world = fmt::format(
        R"(<transform name="to_world"><scale value="{}"/><rotate x="0.267261242" y="0.534522484" z="0.801783726" angle="40"/>
        <translate x="{}" y="{}" z="{}"/></transform>)",
        s, 2 * s, -3 * s, s);
    const std::string curve = "<shape type=\"" + kind + R"("><string name="filename" value="curve.txt"/>)";
    const std::string shapes = place.instanced ? R"(<shape type="shapegroup" id="g">)" + curve +
                                                     R"(</shape></shape><shape type="instance"><ref id="g"/>)" +
                                                     to_world + "</shape>"
                                               : curve + to_world + "</shape>";
    const std::string scene =
        R"(<scene version="3.0.0"><sensor type="perspective"><film type="hdrfilm"/></sensor><emitter type="point"/>)" +
        shapes + "</scene>";
    viewed_ = view_scene(folder.write("scene.xml", scene), AccelKind::embree);
    world_from_curve_ = glm::translate(glm::dmat4(1), s * glm::dvec3(2, -3, 1)) *
                        glm::rotate(glm::dmat4(1), glm::radians(40.0), glm::dvec3(1, 2, 3)) *
                        glm::scale(glm::dmat4(1), glm::dvec3(s));
  }

  const SceneView& view() const { return viewed_->view; }
  glm::dvec3 to_world(const glm::dvec3& p) const { return world_from_curve_ * glm::dvec4(p, 1); }
  glm::dvec3 to_curve(const glm::dvec3& p) const { return glm::inverse(world_from_curve_) * glm::dvec4(p, 1); }
  double scale() const { return place_.scale; }

 private:
  Place place_;
  std::unique_ptr<ViewedScene> viewed_;
  glm::dmat4 world_from_curve_{1};
};

isa_host::ClosestHit closest(const SceneView& view, const glm::dvec3& o, const glm::dvec3& d) {
  return isa_host::intersect_closest_lanes(view, false, to_lanes(o), to_lanes(d), {true});
}
bool is_hit(const isa_host::ClosestHit& hit) { return std::isfinite(hit.t.v); }
bool is_occluded(const SceneView& view, const glm::dvec3& o, const glm::dvec3& d) {
  return isa_host::occluded_lanes(view, to_lanes(o), to_lanes(d), isa_host::Float(1e30f), {true}).v;
}

/// Distance from the hull of two balls: from balls along its axis, by a search for the nearest.
double distance_from_hull(const Point& a, const Point& b, const glm::dvec3& p) {
  const auto distance = [&](double s) { return glm::distance(p, a.p + s * (b.p - a.p)) - (a.r + s * (b.r - a.r)); };
  double lower = 0, upper = 1;
  for (int k = 0; k < 60; ++k) {
    const double a_third = lower + (upper - lower) / 3, two_thirds = upper - (upper - lower) / 3;
    if (distance(a_third) < distance(two_thirds)) {
      upper = two_thirds;
    } else {
      lower = a_third;
    }
  }
  return distance((lower + upper) / 2);
}

/// A straight segment, of either kind the same cone but for the ends.
const std::vector<Point> kSegment = {{{0.1, -0.2, 0}, 0.3}, {{0.4, 0.3, 1}, 0.1}};
const std::vector<Point> kStraight = {
    {{-0.2, -0.7, -1}, 0.5}, {{0.1, -0.2, 0}, 0.3}, {{0.4, 0.3, 1}, 0.1}, {{0.7, 0.8, 2}, -0.1}};

/// Rays about the segment: from around it, and from in it.
template <class Function>
void for_rays(const CurveScene& scene, int count, const Function& function) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const glm::dvec3 middle(0.25, 0.05, 0.5);
  for (int i = 0; i < count; ++i) {
    const double reach = i % 3 == 0 ? 0.3 : i % 3 == 1 ? 2 : 100;
    const glm::dvec3 o = middle + reach * glm::dvec3(unit(random), unit(random), unit(random));
    const glm::dvec3 target = middle + glm::dvec3(0.4 * unit(random), 0.4 * unit(random), 0.8 * unit(random));
    // As kernels have them: unit vectors in the world, in single precision.
    const glm::dvec3 world_o = to_dvec(to_lanes(scene.to_world(o)));
    function(i, world_o, to_dvec(to_lanes(glm::normalize(scene.to_world(target) - world_o))));
  }
}

TEST(EmbreeCurves, LinearOnesAreHitWhereTheHullOfTheirBallsIs) {
  for (const Place& place : kPlaces) {
    SCOPED_TRACE(name_of(place));
    const CurveScene scene("linearcurve", kSegment, place);
    int hits = 0, inside = 0;
    for_rays(scene, 6000, [&](int i, const glm::dvec3& o, const glm::dvec3& d) {
      const auto off = [&](double t) {
        return distance_from_hull(kSegment[0], kSegment[1], scene.to_curve(o + t * d * scene.scale()));
      };
      const auto hit = closest(scene.view(), o, d);
      EXPECT_EQ(is_occluded(scene.view(), o, d), is_hit(hit)) << i;
      // March along the ray as far as the distance allows.
      double t = 0;
      for (int k = 0; k < 400 && t < 300 && off(t) > 1e-7; ++k) t += off(t);
      const bool starts_inside = off(0) < 0;
      if (std::abs(off(0)) < 1e-4) return;
      inside += starts_inside ? 1 : 0;
      if (starts_inside || t > 299) {
        // Grazing rays may go either way.
        EXPECT_TRUE(!is_hit(hit) || (!starts_inside && std::abs(off(double{hit.t.v} / scene.scale())) < 1e-4)) << i;
        return;
      }
      if (!is_hit(hit)) {
        EXPECT_GT(off(t + 1e-3), -1e-5) << i;
        return;
      }
      ++hits;
      EXPECT_LT(std::abs(off(double{hit.t.v} / scene.scale())), 3e-5) << i;
      EXPECT_NEAR(double{hit.t.v} / scene.scale(), t, 2e-3) << i;
      EXPECT_EQ(hit.primitive_side.v & isa_host::kBackSide, 0u);
    });
    EXPECT_GT(hits, 1000);
    EXPECT_GT(inside, 50);
  }
}

TEST(EmbreeCurves, LinearOnesAreHitAlongTheirAxes) {
  const CurveScene scene("linearcurve", {{{0, 0, 0}, 0.5}, {{0, 0, 2}, 0.5}}, {1, false});
  const glm::dvec3 o = scene.to_world({0.3, 0, -1}), d = glm::normalize(scene.to_world({0.3, 0, 1}) - o);
  EXPECT_NEAR(closest(scene.view(), o, d).t.v, 0.6, 1e-5);
  const CurveScene larger("linearcurve", {{{0, 0, 0}, 1}, {{0, 0, 0.5}, 0.25}}, {1, false});
  EXPECT_NEAR(
      closest(larger.view(), larger.to_world({0, 0, 5}), larger.to_world({0, 0, 0}) - larger.to_world({0, 0, 1})).t.v,
      4, 1e-5);
}

TEST(EmbreeCurves, BsplinesAreTubesOpenAtTheEnds) {
  for (const Place& place : kPlaces) {
    SCOPED_TRACE(name_of(place));
    const CurveScene scene("bsplinecurve", kStraight, place);
    const glm::dvec3 axis = glm::normalize(kSegment[1].p - kSegment[0].p);
    const double length = glm::distance(kSegment[1].p, kSegment[0].p);
    int hits = 0, passed = 0, imprecise = 0;
    for_rays(scene, 6000, [&](int i, const glm::dvec3& o, const glm::dvec3& d) {
      const auto hit = closest(scene.view(), o, d);
      EXPECT_EQ(is_occluded(scene.view(), o, d), is_hit(hit)) << i;
      if (!is_hit(hit)) {
        ++passed;
        return;
      }
      ++hits;
      // On the cone the distance from the axis is the radius there. Embree's search is content sooner where rays graze.
      const glm::dvec3 x = scene.to_curve(o + double{hit.t.v} * d) - kSegment[0].p;
      const double along = glm::dot(x, axis) / length;
      const glm::dvec3 off_axis = x - along * length * axis;
      const double steep =
          glm::dot(glm::normalize(off_axis), scene.to_curve(o) - scene.to_curve(o + d)) * scene.scale();
      const double off = std::abs(glm::length(off_axis) - (0.3 - 0.2 * along));
      EXPECT_LT(off, 0.1) << i;
      imprecise += off < (steep > 0.2 ? 3e-5 : 3e-3) ? 0 : 1;
      EXPECT_GT(along, -1e-4) << i;
      EXPECT_LT(along, 1 + 1e-4) << i;
      EXPECT_EQ(hit.primitive_side.v & isa_host::kBackSide, 0u) << i;
    });
    EXPECT_GT(hits, 1000);
    EXPECT_GT(passed, 500);
    // Where everything is small, Embree's search goes astray now and then.
    EXPECT_LE(imprecise, place.scale < 0.01 && !place.instanced ? hits / 50 : 0);
    // Through the tube, and out of it.
    const glm::dvec3 below = scene.to_world(kSegment[0].p - axis),
                     up = glm::normalize(scene.to_world(kSegment[1].p) - below);
    EXPECT_FALSE(is_hit(closest(scene.view(), below, up)));
    const glm::dvec3 middle = scene.to_world((kSegment[0].p + kSegment[1].p) / 2.0);
    EXPECT_FALSE(is_hit(closest(scene.view(), middle, glm::normalize(glm::dvec3(1, 2, -1)))));
    EXPECT_FALSE(is_occluded(scene.view(), middle, glm::normalize(glm::dvec3(1, 2, -1))));
    EXPECT_TRUE(is_hit(closest(scene.view(), middle + 5 * scene.scale() * glm::dvec3(1, 0, 0), {-1, 0, 0})));
  }
}

TEST(EmbreeCurves, NextRaysBeginOffTheSurface) {
  for (const char* kind : {"linearcurve", "bsplinecurve"}) {
    const bool linear = std::string(kind) == "linearcurve";
    for (const Place& place : kPlaces) {
      SCOPED_TRACE(kind + (": " + name_of(place)));
      const CurveScene scene(kind, linear ? kSegment : kStraight, place);
      std::mt19937 random(2);
      std::normal_distribution<double> normal;
      int hits = 0, again = 0;
      for_rays(scene, 6000, [&](int, const glm::dvec3& o, const glm::dvec3& d) {
        const auto closest_hit = closest(scene.view(), o, d);
        if (!is_hit(closest_hit)) return;
        ++hits;
        isa_host::Hit hit{};
        hit.ray.origin = to_lanes(o), hit.ray.direction = to_lanes(d);
        set_end(hit, closest_hit);
        const isa_host::SurfacePoint s = make_surface_point(scene.view(), hit, {true});
        EXPECT_LT(s.offset.v, 1e-3 * scene.scale());
        EXPECT_LT(glm::dot(to_dvec(s.normal), d), 1e-3);
        for (int k = 0; k < 8; ++k) {
          glm::dvec3 w = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
          const double cosine = glm::dot(w, to_dvec(s.normal));
          // Outwards, half of them all but along the surface; or inwards, where the other side does not stop them.
          if (k >= 4) w = glm::normalize(w - 0.999 * cosine * to_dvec(s.normal));
          const bool outwards = glm::dot(w, to_dvec(s.normal)) > 0;
          const glm::dvec3 begin =
              to_dvec(spawn_origin(s.position, s.normal, s.offset, isa_host::Float(outwards ? 1.0f : -1.0f)));
          again += is_occluded(scene.view(), begin, w) ? 1 : 0;
        }
      });
      EXPECT_GT(hits, 1000);
      EXPECT_EQ(again, 0) << "of " << 8 * hits;
    }
  }
}

}  // namespace
}  // namespace norrsken
