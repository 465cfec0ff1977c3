// Grids of signed distances in a scene: what rays meet of them, at every lane width, and where the next rays begin.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <functional>
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

using Function = std::function<double(const glm::dvec3&)>;

double sphere(const glm::dvec3& p) { return glm::length(p - 0.5) - 0.35; }

/// Random inside and positive at the borders, so that the surface is closed: as bad as a grid can be.
Function noise(unsigned seed) {
  return [random = std::mt19937(seed)](const glm::dvec3& p) mutable {
    const double value = std::normal_distribution<double>()(random);
    const glm::dvec3 q = glm::abs(p - 0.5);
    return std::max({q.x, q.y, q.z}) > 0.499 ? 1.0 : value;
  };
}

/// Where a scene's grid stands: scale, then the rest.
struct Place {
  double scale;
  bool instanced;
};
const Place kPlaces[] = {{1, false}, {1, true}, {1e-3, false}, {1e3, true}};
std::string name_of(const Place& p) { return fmt::format("scale {}{}", p.scale, p.instanced ? " in an instance" : ""); }

/// A scene with a grid of N^3 values; `world_from_grid` maps the cube.
class GridScene {
 public:
  GridScene(const Function& f, int n, const Place& place) {
    const TemporaryFolder folder;
    sample(f, n);
    write_vol(folder.file("grid.vol"));
    const double s = place.scale;
    const std::string to_world = fmt::format(
        R"(<transform name="to_world"><scale x="{}" y="{}" z="{}"/><rotate x="0.267261242" y="0.534522484" z="0.801783726" angle="40"/>
        <translate x="{}" y="{}" z="{}"/></transform>)",
        s, 1.5 * s, 0.75 * s, 2 * s, -3 * s, s);
    const std::string grid = R"(<shape type="sdfgrid"><string name="filename" value="grid.vol"/>)";
    const std::string shapes = place.instanced ? R"(<shape type="shapegroup" id="g">)" + grid +
                                                     R"(</shape></shape><shape type="instance"><ref id="g"/>)" +
                                                     to_world + "</shape>"
                                               : grid + to_world + "</shape>";
    const std::string scene =
        R"(<scene version="3.0.0"><sensor type="perspective"><film type="hdrfilm"/></sensor><emitter type="constant"/>)" +
        shapes + "</scene>";
    viewed_ = view_scene(folder.write("scene.xml", scene), AccelKind::embree);
    world_from_grid_ = glm::translate(glm::dmat4(1), s * glm::dvec3(2, -3, 1)) *
                       glm::rotate(glm::dmat4(1), glm::radians(40.0), glm::dvec3(1, 2, 3)) *
                       glm::scale(glm::dmat4(1), s * glm::dvec3(1, 1.5, 0.75));
    scale_ = s;
  }

  const SceneView& view() const { return viewed_->view; }
  glm::dvec3 to_world(const glm::dvec3& p) const { return world_from_grid_ * glm::dvec4(p, 1); }
  glm::dvec3 to_grid(const glm::dvec3& p) const { return glm::inverse(world_from_grid_) * glm::dvec4(p, 1); }
  double scale() const { return scale_; }

  /// The interpolation at a place of the world; outside of the cube it is 1.
  double value(const glm::dvec3& world) const {
    const glm::dvec3 p = to_grid(world) * (n_ - 1.0), q = glm::abs(to_grid(world) - 0.5);
    if (std::max({q.x, q.y, q.z}) > 0.5) return 1;
    const glm::ivec3 voxel = glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), glm::ivec3(n_ - 2));
    const glm::dvec3 w = p - glm::dvec3(voxel);
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
      const glm::ivec3 corner(i & 1, (i >> 1) & 1, i >> 2), at = voxel + corner;
      double weight = 1;
      for (int a = 0; a < 3; ++a) weight *= corner[a] != 0 ? w[a] : 1 - w[a];
      sum += weight * double{values_[static_cast<std::size_t>((at.z * n_ + at.y) * n_ + at.x)]};
    }
    return sum;
  }

  /// Rays from around the cube, and from in it.
  RandomRays rays(std::uint32_t count, unsigned seed) const {
    const glm::dvec3 center = to_world(glm::dvec3(0.5));
    double lower[3], upper[3];
    for (int k = 0; k < 3; ++k) lower[k] = center[k] - scale_, upper[k] = center[k] + scale_;
    return {count, seed, lower, upper};
  }

 private:
  void sample(const Function& f, int n) {
    n_ = n;
    for (int z = 0; z < n; ++z) {
      for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) values_.push_back(static_cast<float>(f(glm::dvec3(x, y, z) / (n - 1.0))));
      }
    }
  }
  void write_vol(const std::string& path) const {
    std::ofstream file(path, std::ios::binary);
    const auto write = [&](auto value) { file.write(reinterpret_cast<const char*>(&value), sizeof value); };
    file << "VOL\3";
    for (const std::int32_t word : {1, n_, n_, n_, 1}) write(word);
    for (int k = 0; k < 6; ++k) write(0.0f);
    for (const float value : values_) write(value);
  }

  int n_ = 0;
  std::vector<float> values_;
  std::unique_ptr<ViewedScene> viewed_;
  glm::dmat4 world_from_grid_{1};
  double scale_ = 1;
};

struct OneRay {
  glm::dvec3 origin, direction;
};
OneRay ray_of(const RayArrays& r, std::uint32_t i) {
  return {{r.ox[i], r.oy[i], r.oz[i]}, {r.dx[i], r.dy[i], r.dz[i]}};
}

/// One ray through the one-lane kernels.
isa_host::ClosestHit closest(const SceneView& view, const OneRay& ray) {
  const auto lanes = [](const glm::dvec3& v) {
    return Vec3f{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  return isa_host::intersect_closest_lanes(view, false, lanes(ray.origin), lanes(ray.direction), {true});
}
bool is_hit(const isa_host::ClosestHit& hit) { return std::isfinite(hit.t.v); }
bool is_back(const isa_host::ClosestHit& hit) { return (hit.primitive_side.v & isa_host::kBackSide) != 0; }

TEST(EmbreeGrid, SpheresAreHitWhereTheyAre) {
  constexpr int kValues = 65;
  for (const Place& place : kPlaces) {
    SCOPED_TRACE(name_of(place));
    const GridScene scene(sphere, kValues, place);
    const RandomRays random = scene.rays(20000, 1);
    int hits = 0;
    for (std::uint32_t i = 0; i < random.arrays().count; ++i) {
      const OneRay ray = ray_of(random.arrays(), i);
      const glm::dvec3 o = scene.to_grid(ray.origin) - 0.5, d = scene.to_grid(ray.origin + ray.direction) - 0.5 - o;
      const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 0.35 * 0.35;
      const double discriminant = b * b - a * c;
      // Between values the surface differs by the square of a voxel at most: not of the rays that graze it.
      if (std::abs(discriminant) < 0.05 * a || std::abs(c) < 0.01) continue;
      const bool inside = c < 0;
      const double t = (-b + (inside ? 1 : -1) * std::sqrt(std::max(discriminant, 0.0))) / a;
      const auto hit = closest(scene.view(), ray);
      ASSERT_EQ(is_hit(hit), discriminant > 0 && t > 0) << i;
      if (!is_hit(hit)) continue;
      ++hits;
      EXPECT_EQ(is_back(hit), inside) << i;
      EXPECT_LT(std::abs(hit.t.v - t) * std::sqrt(a), 3.0 / (kValues * kValues)) << i;
    }
    EXPECT_GT(hits, 500);
  }
}

TEST(EmbreeGrid, NoRayComesInOrOutUnseen) {
  for (const Place& place : kPlaces) {
    SCOPED_TRACE(name_of(place));
    const GridScene scene(noise(3), 12, place);
    const RandomRays random = scene.rays(4000, 2);
    int hits = 0, ends = 0;
    for (std::uint32_t i = 0; i < random.arrays().count; ++i) {
      OneRay ray = ray_of(random.arrays(), i);
      for (int k = 0; k < 1000; ++k) {
        const double here = scene.value(ray.origin);
        const auto hit = closest(scene.view(), ray);
        // The values tell whether the ray is inside, but for rounding: from there it meets the surface, which is closed,
        // and from behind; from outside it may miss it, or meets it from its front.
        if (std::abs(here) > 1e-5) {
          ASSERT_TRUE(is_hit(hit) || here > 0) << "ray " << i << ", after " << k << " hits";
          if (is_hit(hit)) {
            ASSERT_EQ(is_back(hit), here < 0) << "ray " << i << ", after " << k << " hits";
          }
        }
        if (!is_hit(hit)) {
          ++ends;
          break;
        }
        ++hits;
        ray.origin += (double{hit.t.v} + 1e-4 * scene.scale()) * ray.direction;
      }
    }
    EXPECT_GT(hits, 2000);
    EXPECT_EQ(ends, 4000);
  }
}

TEST(EmbreeGrid, NextRaysBeginOffTheSurface) {
  constexpr double kNear = 1e-3;
  for (const Place& place : kPlaces) {
    SCOPED_TRACE(name_of(place));
    const GridScene scene(sphere, 33, place);
    // From afar too, where distances are told less precisely than the surface wants.
    for (const double away : {1.0, 300.0}) {
      const RandomRays random = scene.rays(4000, 4);
      int hits = 0;
      for (std::uint32_t i = 0; i < random.arrays().count; ++i) {
        OneRay ray = ray_of(random.arrays(), i);
        ray.direction =
            glm::normalize(scene.to_world(sphere(scene.to_grid(ray.origin)) * glm::dvec3(0.1) + 0.45) - ray.origin);
        ray.origin -= (away - 1) * scene.scale() * ray.direction;
        const auto closest_hit = closest(scene.view(), ray);
        if (!is_hit(closest_hit)) continue;
        ++hits;
        isa_host::Hit hit{};
        const auto f = [](double x) { return static_cast<float>(x); };
        hit.ray.origin = {f(ray.origin.x), f(ray.origin.y), f(ray.origin.z)};
        hit.ray.direction = {f(ray.direction.x), f(ray.direction.y), f(ray.direction.z)};
        set_end(hit, closest_hit);
        const isa_host::SurfacePoint s = make_surface_point(scene.view(), hit, {true});
        EXPECT_LT(s.offset.v, 1e-4 * scene.scale());
        const RayArrays& more = random.arrays();
        for (std::uint32_t k = 0; k < 4; ++k) {
          OneRay next = ray_of(more, (7 * i + k) % more.count);
          const double cosine = glm::dot(next.direction, to_dvec(s.normal));
          if (std::abs(cosine) < 0.05) continue;
          next.origin = to_dvec(spawn_origin(s.position, s.normal, s.offset, {static_cast<float>(cosine)}));
          const auto next_hit = closest(scene.view(), next);
          const bool outside = cosine > 0;
          // The sphere is round: from outside nothing is near, from inside the other side is met from behind.
          if (outside) {
            ASSERT_FALSE(is_hit(next_hit) && next_hit.t.v < kNear * scene.scale()) << i;
          } else {
            ASSERT_TRUE(is_hit(next_hit) && is_back(next_hit)) << i;
            ASSERT_GT(next_hit.t.v, kNear * scene.scale()) << i;
          }
        }
      }
      EXPECT_GT(hits, 1000);
    }
  }
}

TEST(EmbreeGrid, EveryLaneWidthAndPacketsFindTheSame) {
  const GridScene scene(noise(5), 9, {1, true});
  constexpr std::uint32_t kRays = 20000;
  const RandomRays random = scene.rays(kRays, 6);
  Answers<float> wanted(kRays), t(kRays);
  Answers<std::uint32_t> wanted_side(kRays), side(kRays);
  probe_of(*find_kernels("scalar"))
      .closest_rays(scene.view(), false, random.arrays(), wanted.data(), wanted_side.data());
  for (const KernelEntry* kernels : wide_kernels()) {
    for (const bool coherent : {false, true}) {
      probe_of(*kernels).closest_rays(scene.view(), coherent, random.arrays(), t.data(), side.data());
      for (std::uint32_t i = 0; i < kRays; ++i) {
        ASSERT_EQ(t[i], wanted[i]) << kernels->name << " ray " << i;
        ASSERT_EQ(side[i], wanted_side[i]) << kernels->name << " ray " << i;
      }
    }
    // Just before the hit nothing is in the way, just behind it something is.
    Answers<float> before(kRays), behind(kRays);
    Answers<std::uint8_t> occluded_before(kRays), occluded_behind(kRays);
    for (std::uint32_t i = 0; i < kRays; ++i) {
      before.data()[i] = std::isfinite(wanted[i]) ? wanted[i] : 1e30f;
      behind.data()[i] = std::nextafter(before[i], INFINITY);
    }
    kernels->occluded_rays(scene.view(), random.arrays(), before.data(), occluded_before.data());
    kernels->occluded_rays(scene.view(), random.arrays(), behind.data(), occluded_behind.data());
    for (std::uint32_t i = 0; i < kRays; ++i) {
      ASSERT_FALSE(occluded_before[i]) << i;
      ASSERT_EQ(occluded_behind[i] != 0, std::isfinite(wanted[i])) << i;
    }
  }
}

}  // namespace
}  // namespace norrsken
