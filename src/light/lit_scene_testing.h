// For tests: lights as one lane sees them, of the text of a scene.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "compile/compile_testing.h"
#include "light/sample_lights.h"

namespace norrsken::isa_host {

inline const Mask kOn{true};

inline Vec3f lanes(const glm::dvec3& v) { return {float(v.x), float(v.y), float(v.z)}; }
inline glm::dvec3 doubles(const Vec3f& v) { return {v.x.v, v.y.v, v.z.v}; }
inline glm::dvec3 doubles(const Color& c) { return {c.r.v, c.g.v, c.b.v}; }
inline glm::dvec3 doubles(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// A scene and the part of its view that lights look at.
struct LitScene {
  norrsken::testing::Compiled compiled;
  SceneView view;

  explicit LitScene(const std::string& elements, const norrsken::testing::Files& files = {})
      : compiled(norrsken::testing::compile_elements(norrsken::testing::kSensor + norrsken::testing::kShape + elements,
                                                     files)) {
    for (const std::string& message : compiled.messages()) ADD_FAILURE() << message;
    const SceneTables& t = compiled.tables();
    view.lights = t.lights.data();
    view.light_count = static_cast<std::uint32_t>(t.lights.size());
    for (const LightRecord& light : t.lights) view.light_kinds |= 1u << static_cast<std::uint32_t>(light.kind);
    view.analytics = t.analytics.data();
    for (const AnalyticRecord& a : t.analytics) view.analytic_kinds |= 1u << static_cast<std::uint32_t>(a.kind);
    view.shapes = t.shapes.data();
    view.normals = t.normals.data();
    view.triangle_vertices = t.triangle_vertices.data();
    for (const ShapeRecord& shape : t.shapes) view.any_smooth = view.any_smooth || shape.smooth != 0;
    view.light_nodes = t.light_nodes.empty() ? nullptr : t.light_nodes.data();
    view.light_leaves = t.light_leaves.data();
    view.lights_around = t.lights_around.data();
    view.lights_around_count = static_cast<std::uint32_t>(t.lights_around.size());
    view.parameters = t.parameters.data();
    view.texels = t.texels.data();
    view.texture_kinds = t.texture_kinds;
    view.environment = t.environment;
    std::copy_n(t.center, 3, view.center);
    view.radius = t.radius;
  }
  const LightRecord& light() const { return view.lights[0]; }
  LightSample sample(const glm::dvec3& reference, double u, double v) const {
    return sample_one_light(view, lanes(reference), any_receiver(), {Float(0.0f), Float(0.0f)}, {float(u), float(v)},
                            kOn)
        .sample;
  }
  /// The irradiance that a delta light sends to a point of a plane with this normal.
  double irradiance(const glm::dvec3& point, const glm::dvec3& normal) const {
    const LightSample s = sample(point, 0.5, 0.5);
    if (!s.valid.v) return 0;
    return double{s.radiance.r.v} * std::max(0.0, glm::dot(normal, glm::normalize(doubles(s.point) - point)));
  }
};

}  // namespace norrsken::isa_host
