// For tests: every kind of light of lists/light.def in every scene of light_test_cases.def.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "light/light_testing.h"
#include "light/lit_scene_testing.h"
#include "tests/statistics/case_name.h"

namespace norrsken::isa_host {

struct LightCase {
  LightKind kind;
  std::string_view name, kind_name, elements;
  bool is_delta;
};
inline void PrintTo(const LightCase& c, std::ostream* out) { *out << c.kind_name << ", " << c.name; }

constexpr bool is_delta(LightKind light) {
  switch (light) {
#define NORRSKEN_LIGHT(kind, Model, is_delta) \
  case LightKind::kind:                       \
    return is_delta;
#include "lists/light.def"
#undef NORRSKEN_LIGHT
    default:
      return false;
  }
}

inline constexpr LightCase kLightCaseTable[] = {
#define NORRSKEN_LIGHT_CASE(kind, name, elements) {LightKind::kind, name, #kind, elements, is_delta(LightKind::kind)},
#include "light/light_test_cases.def"
#undef NORRSKEN_LIGHT_CASE
};

#define NORRSKEN_LIGHT(the_kind, Model, is_delta)                                              \
  static_assert(std::any_of(std::begin(kLightCaseTable), std::end(kLightCaseTable),            \
                            [](const LightCase& c) { return c.kind == LightKind::the_kind; }), \
                "light_test_cases.def needs a line for " #the_kind);
#include "lists/light.def"
#undef NORRSKEN_LIGHT

/// An environment of 8 x 5 texels: dark and bright, black in places, at a pole too, and one as bright as a sun.
inline constexpr int kEnvironmentWidth = 8, kEnvironmentHeight = 5;
inline double environment_texel(int x, int y) {
  return x == 6 && y == 1 ? 512 : (3 * x + 5 * y) % 4 == 0 ? 0 : (x * 7 + y * 3) % 5 / 4.0;
}

/// What the scenes may name.
inline norrsken::testing::Files light_files() {
  std::vector<std::array<double, 3>> texels;
  for (int y = 0; y < kEnvironmentHeight; ++y) {
    for (int x = 0; x < kEnvironmentWidth; ++x) {
      const double t = environment_texel(x, y);
      texels.push_back({t, t / 2, t / 4});
    }
  }
  using norrsken::testing::radiance_file;
  return {{"env.hdr", radiance_file(kEnvironmentWidth, kEnvironmentHeight, texels)},
          {"slide.hdr", radiance_file(2, 2, {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}})},
          {"triangle.obj", "v -1 -1 1\nv -1 2 1.5\nv 2 -1 1\nvt 0 0\nvt 0 1\nvt 1 0\nf 1/1 2/2 3/3\n"}};
}

inline LitScene scene_of(const LightCase& c) {
  return LitScene(R"(<integrator type="ptracer"/>)" + std::string(c.elements), light_files());
}

/// Points and vectors in the local space of the scene's one analytic shape.
inline glm::dvec3 local_of(const LitScene& scene, const glm::dvec3& v, double w) {
  glm::dvec3 out;
  for (int i = 0; i < 3; ++i) {
    const float* row = scene.compiled.tables().analytics[0].place.local_from_world + 4 * i;
    out[i] = double{row[0]} * v.x + double{row[1]} * v.y + double{row[2]} * v.z + double{row[3]} * w;
  }
  return out;
}
inline bool is_disk(const LitScene& scene) { return scene.compiled.tables().analytics[0].kind == AnalyticKind::disk; }

/// Shares b1, b2 of the edges in the way from the origin of a flat light.
inline std::array<double, 2> barycentric(const LightRecord& light, const glm::dvec3& point) {
  const glm::dvec3 q = point - doubles(light.origin), normal = doubles(light.normal);
  const glm::dvec3 e1 = doubles(light.edge1), e2 = doubles(light.edge2);
  const double area = glm::dot(glm::cross(e1, e2), normal);
  return {glm::dot(glm::cross(q, e2), normal) / area, glm::dot(glm::cross(e1, q), normal) / area};
}

/// Where a ray meets the light's front, in double precision.
inline std::optional<double> distance_to_light(const LitScene& scene, const glm::dvec3& from,
                                               const glm::dvec3& direction) {
  const LightRecord& light = scene.light();
  const glm::dvec3 to_origin = doubles(light.origin) - from;
  switch (light.kind) {
    case LightKind::constant:
    case LightKind::envmap:
      return 2.0 * double{scene.view.radius};
    case LightKind::sphere: {
      const double radius = light.edge1[0], b = glm::dot(to_origin, direction);
      const double d = b * b - glm::dot(to_origin, to_origin) + radius * radius;
      if (light.edge1[1] > 0) return d > 0 && b + std::sqrt(d) > 0 ? std::optional(b + std::sqrt(d)) : std::nullopt;
      return d > 0 && b > 0 ? std::optional(b - std::sqrt(d)) : std::nullopt;
    }
    case LightKind::analytic: {
      const glm::dvec3 o = local_of(scene, from, 1), d = local_of(scene, direction, 0);
      if (is_disk(scene)) {
        const double t = -o.z / d.z, x = o.x + t * d.x, y = o.y + t * d.y;
        return d.z < 0 && t > 0 && x * x + y * y <= 1 ? std::optional(t) : std::nullopt;
      }
      // The entry into the unit cylinder; behind it is the back, which does not shine.
      const double a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y, c = o.x * o.x + o.y * o.y - 1;
      const double t = (-b - std::sqrt(b * b - a * c)) / a, z = o.z + t * d.z;
      return t > 0 && z >= 0 && z <= 1 ? std::optional(t) : std::nullopt;
    }
    case LightKind::triangle:
    case LightKind::parallelogram: {
      const double facing = -glm::dot(direction, doubles(light.normal));
      const double t = -glm::dot(to_origin, doubles(light.normal)) / facing;
      if (!(facing > 0 && t > 0)) return std::nullopt;
      const auto [b1, b2] = barycentric(light, from + t * direction);
      const bool inside = light.kind == LightKind::triangle ? b1 + b2 <= 1 : b1 <= 1 && b2 <= 1;
      return b1 >= 0 && b2 >= 0 && inside ? std::optional(t) : std::nullopt;
    }
    default:
      ADD_FAILURE() << "a kind of light that no ray is known to meet";
      return std::nullopt;
  }
}

class EveryLight : public ::testing::TestWithParam<LightCase> {};

inline std::string light_test_name(const ::testing::TestParamInfo<LightCase>& tested) {
  return statistics::case_name(tested.param.kind_name, tested.param.name);
}

}  // namespace norrsken::isa_host
