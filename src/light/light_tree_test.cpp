// The tree over many lights: its probabilities against what it chooses, against closed forms, and on both sides of
// multiple importance sampling.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "compile/light_choice.h"
#include "light/lit_scene_testing.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::isa_host {
namespace {

double uniform(std::mt19937_64& random) { return std::uniform_real_distribution<double>(0, 1 - 1e-7)(random); }
glm::dvec3 anywhere(std::mt19937_64& random, double size) {
  return size * (2.0 * glm::dvec3(uniform(random), uniform(random), uniform(random)) - 1.0);
}

std::string place(const glm::dvec3& p, const glm::dvec3& target) {
  const auto text = [](const glm::dvec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
  const glm::dvec3 up =
      std::abs(target.y - p.y) > 0.9 * glm::length(target - p) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return fmt::format(R"(<lookat origin="{}" target="{}" up="{}"/>)", text(p), text(target), text(up));
}

/// Lights of every kind that has a place, anywhere and turned anyhow, of powers that differ a thousandfold.
std::string mixed_lights(int count) {
  std::mt19937_64 random(11);
  std::string scene;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 p = anywhere(random, 5);
    const std::string where = place(p, p + anywhere(random, 1)),
                      power = fmt::format("{}", std::pow(10, 3 * uniform(random)));
    const std::string area =
        R"(<emitter type="area"><rgb name="radiance" value=")" + power + R"("/></emitter></shape>)";
    const std::string turned = R"(<transform name="to_world"><scale value="0.1"/>)" + where + "</transform>";
    switch (i % 7) {
      case 0:
        scene += fmt::format(R"(<emitter type="point"><point name="position" x="{}" y="{}" z="{}"/>)", p.x, p.y, p.z) +
                 R"(<rgb name="intensity" value=")" + power + R"("/></emitter>)";
        break;
      case 1:
        scene += R"(<emitter type="spot"><float name="cutoff_angle" value="40"/><rgb name="intensity" value=")" +
                 power + R"("/><transform name="to_world">)" + where + "</transform></emitter>";
        break;
      case 2:
        scene += R"(<emitter type="projector"><float name="fov" value="50"/><rgb name="irradiance" value=")" + power +
                 R"("/><transform name="to_world">)" + where + "</transform></emitter>";
        break;
      case 3:
        scene +=
            fmt::format(
                R"(<shape type="sphere"><point name="center" x="{}" y="{}" z="{}"/><float name="radius" value="0.1"/>)",
                p.x, p.y, p.z) +
            area;
        break;
      case 4:
        scene += R"(<shape type="disk">)" + turned + area;
        break;
      case 5:
        scene += R"(<shape type="cylinder">)" + turned + area;
        break;
      default:
        scene += R"(<shape type="rectangle">)" + turned + area;
    }
  }
  return scene;
}
const std::string kAround = R"(<emitter type="constant"/><emitter type="directional"/>)";

/// The environment is chosen three times as often as those with a place together, the directions seldom.
const std::string kWeighted = R"(<emitter type="constant"><float name="sampling_weight" value="3"/></emitter>)"
                              R"(<emitter type="directional"><float name="sampling_weight" value="0.01"/></emitter>)"
                              R"(<emitter type="directional"><float name="sampling_weight" value="0.25"/></emitter>)"
                              R"(<emitter type="point"><float name="sampling_weight" value="20"/></emitter>)";

class ManyLights : public ::testing::TestWithParam<std::string> {
 protected:
  LitScene scene_{mixed_lights(140) + GetParam()};
  std::uint32_t count() const { return scene_.view.light_count; }
  double prob(std::uint32_t light, const glm::dvec3& reference) const {
    return double{light_prob_by_place(scene_.view, UInt(light), lanes(reference), kOn).v};
  }
};
INSTANTIATE_TEST_SUITE_P(, ManyLights, ::testing::Values("", kAround, kWeighted), [](const auto& set) {
  return set.param.empty() ? "alone" : set.param == kAround ? "with_lights_around" : "weighted";
});

TEST_P(ManyLights, ProbabilitiesSumToOneEverywhere) {
  ASSERT_NE(scene_.view.light_nodes, nullptr);
  std::mt19937_64 random(1);
  std::vector<glm::dvec3> places{glm::dvec3(0), {1e4, -1e4, 3e3}, {1e9, 0, 0}};
  for (int i = 0; i < 300; ++i) places.push_back(anywhere(random, i % 3 == 0 ? 20 : 5));
  for (std::uint32_t i = 0; i < count(); ++i) places.push_back(doubles(scene_.view.lights[i].origin));
  for (const glm::dvec3& p : places) {
    double sum = 0;
    for (std::uint32_t i = 0; i < count(); ++i) {
      EXPECT_GT(prob(i, p), 0);
      sum += prob(i, p);
    }
    EXPECT_NEAR(sum, 1, 1e-5) << p.x << " " << p.y << " " << p.z;
  }
}

TEST_P(ManyLights, AreChosenAsOftenAsTheirProbabilitySays) {
  statistics::StatisticalTest test;
  std::mt19937_64 random(2);
  for (const glm::dvec3& p : {glm::dvec3(0.2, 0.1, -0.3), glm::dvec3(4, -4.5, 3), glm::dvec3(30, 2, 1)}) {
    constexpr int kSamples = 300'000;
    std::vector<double> chosen(count());
    for (int i = 0; i < kSamples; ++i) {
      const Vec2f u{float(uniform(random)), float(uniform(random))};
      const PickedLight picked = pick_light_by_place(scene_.view, lanes(p), any_receiver(), u, kOn);
      ++chosen.at(picked.light.v);
      if (i < 1000) {
        EXPECT_NEAR(double{picked.prob.v} / prob(picked.light.v, p), 1, 1e-5);
        EXPECT_EQ(picked.prob.v, picked.weight_prob.v);
      }
    }
    std::vector<double> probs;
    for (std::uint32_t i = 0; i < count(); ++i) probs.push_back(prob(i, p));
    EXPECT_TRUE(test.chi_square(statistics::cells_of_counts(chosen, probs), {"light", ""},
                                fmt::format("lights chosen at {}, {}, {}", p.x, p.y, p.z)));
  }
}

/// Lights below the surface are hardly chosen; of all lights nothing is lost.
TEST_P(ManyLights, AreChosenForWhatASurfaceTakes) {
  std::mt19937_64 random(6);
  for (const glm::dvec3& p : {glm::dvec3(0.2, 0.1, -0.3), glm::dvec3(-2, 1, 3)}) {
    const Receiver receivers[2] = {any_receiver(), {lanes(glm::normalize(glm::dvec3(1, 2, -1))), 0.05f}};
    double below[2] = {}, shares[2] = {}, squares = 0;
    constexpr int kSamples = 100'000;
    for (int i = 0; i < kSamples; ++i) {
      const Vec2f u{float(uniform(random)), float(uniform(random))};
      for (int k = 0; k < 2; ++k) {
        const PickedLight picked = pick_light_by_place(scene_.view, lanes(p), receivers[k], u, kOn);
        const double share = double{picked.weight_prob.v} / double{picked.prob.v};
        shares[k] += share / kSamples;
        if (k == 1) squares += share * share / kSamples;
        if (scene_.view.light_leaves[picked.light.v] == kNone) continue;
        const glm::dvec3 to_light = doubles(scene_.view.lights[picked.light.v].origin) - p;
        if (glm::dot(to_light, doubles(receivers[1].normal)) < -0.5) ++below[k];
        if (i < 300) {
          EXPECT_NEAR(double{picked.weight_prob.v} / prob(picked.light.v, p), 1, 1e-5);
        }
      }
    }
    EXPECT_NEAR(shares[0], 1, 1e-6);
    EXPECT_NEAR(shares[1], 1, 5 * std::sqrt((squares - shares[1] * shares[1]) / kSamples));
    EXPECT_LT(below[1], 0.25 * below[0]);
  }
}

/// A ray starts a rounding bound off the surface point for which lights were sampled.
TEST_P(ManyLights, ProbabilitiesAreContinuous) {
  std::mt19937_64 random(3);
  double worst = 0, mean = 0;
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec3 p = anywhere(random, 6), q = p + anywhere(random, 2e-6);
    const auto light = static_cast<std::uint32_t>(uniform(random) * count());
    const double change = std::abs(prob(light, p) / prob(light, q) - 1);
    worst = std::max(worst, change), mean += change / 20'000;
  }
  // The worst is where a light begins to shine, next to nothing.
  EXPECT_LT(worst, 0.1);
  EXPECT_LT(mean, 2e-5);
}

TEST_P(ManyLights, HaveTheDensityThatTheyAreSampledWith) {
  std::mt19937_64 random(4);
  int compared = 0;
  for (int i = 0; i < 12'000; ++i) {
    const glm::dvec3 p = anywhere(random, 6);
    const Vec2f pick{float(uniform(random)), float(uniform(random))}, u{float(uniform(random)), float(uniform(random))};
    const LightChoice choice = sample_one_light(scene_.view, lanes(p), any_receiver(), pick, u, kOn);
    if (!choice.sample.valid.v || choice.delta.v) continue;
    const PickedLight picked = pick_light_by_place(scene_.view, lanes(p), any_receiver(), pick, kOn);
    const glm::dvec3 to_light = doubles(choice.sample.point) - p;
    const Float pdf = light_pdf_sa(scene_.view, picked.light, lanes(p), lanes(glm::normalize(to_light)),
                                   float(glm::length(to_light)), kOn);
    const double sampled = double{choice.prob.v} * double{choice.sample.pdf_sa.v};
    // At a grazing angle the rounding bound by which the point is off its light changes the cosine.
    const double area = scene_.view.lights[picked.light.v].area;
    if (glm::dot(to_light, to_light) / (double{choice.sample.pdf_sa.v} * area) < 0.1) continue;
    EXPECT_NEAR(double{pdf.v}, sampled, 1e-2 * sampled);
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

/// The second moment of choosing a light and taking all that it sends, against that of choosing by power.
TEST_P(ManyLights, AreChosenWhereTheyMatter) {
  std::mt19937_64 random(5);
  double worst = 0, logarithms = 0;
  constexpr int kPlaces = 300;
  for (int i = 0; i < kPlaces; ++i) {
    const glm::dvec3 p = anywhere(random, 5);
    double by_place = 0, by_power = 0;
    for (std::uint32_t k = 0; k < count(); ++k) {
      if (scene_.view.light_leaves[k] == kNone) continue;
      SceneView one = scene_.view;
      one.lights += k, one.light_count = 1, one.light_nodes = nullptr;
      double sent = 0;  // the mean of a few points of the light
      for (int n = 0; n < 8; ++n) {
        const Vec2f u{float(uniform(random)), float(uniform(random))};
        const LightChoice choice =
            sample_one_of_many_lights(one, lanes(p), any_receiver(), {Float(0.0f), Float(0.0f)}, u, kOn);
        if (choice.sample.valid.v) sent += double{choice.sample.radiance.g.v} / double{choice.sample.pdf_sa.v} / 8;
      }
      by_place += sent * sent / prob(k, p);
      by_power += sent * sent / double{scene_.view.lights[k].prob};
    }
    worst = std::max(worst, by_place / by_power);
    logarithms += std::log(by_place / by_power) / kPlaces;
  }
  std::printf("second moment by place over that by power: %.3g, at worst %.3g\n", std::exp(logarithms), worst);
  EXPECT_LT(std::exp(logarithms), 0.6);
  // A weak light right beside the point, which choosing by power takes for one of average power.
  EXPECT_LT(worst, 10);
}

// --- closed forms ----------------------------------------------------------------------------------------------------

/// The tree over the lights of a scene, however few.
struct TreeScene {
  LitScene scene;
  explicit TreeScene(const std::string& elements) : scene(elements) {}
  TreeScene(const std::string& elements, std::vector<LightPower> powers) : scene(elements) {
    SceneTables& t = scene.compiled.scene->tables;
    build_light_tree(t, powers);
    scene.view.light_nodes = t.light_nodes.data();
    scene.view.light_leaves = t.light_leaves.data();
    scene.view.lights_around = t.lights_around.data();
    scene.view.lights_around_count = static_cast<std::uint32_t>(t.lights_around.size());
  }
  double prob(std::uint32_t light, const glm::dvec3& reference) const {
    return double{light_prob_by_place(scene.view, UInt(light), lanes(reference), kOn).v};
  }
};
LightBounds at(const glm::dvec3& p) { return {.lower = p, .upper = p}; }
const std::string kTwoPoints = R"(<emitter type="point"/><emitter type="point"/>)";

/// A tenth is dealt out evenly.
double weight(double intensity, double total, int lights) { return 0.9 * intensity / total + 0.1 / lights; }

TEST(LightTree, TwoPointsShareByIntensityOverSquaredDistance) {
  const TreeScene two(kTwoPoints,
                      {point_power(glm::dvec3(3), at({0, 0, 0})), point_power(glm::dvec3(1), at({10, 0, 0}))});
  for (const glm::dvec3& p : {glm::dvec3(5, 0, 0), glm::dvec3(1, 2, 0), glm::dvec3(9, 0, -1), glm::dvec3(100, 50, 0)}) {
    const glm::dvec3 q = p - glm::dvec3(10, 0, 0);
    const double a = weight(3, 4, 2) / glm::dot(p, p), b = weight(1, 4, 2) / glm::dot(q, q);
    EXPECT_NEAR(two.prob(0, p), a / (a + b), 1e-5);
    EXPECT_NEAR(two.prob(1, p), b / (a + b), 1e-5);
  }
}

TEST(LightTree, AConeShinesAsFarAsItsSlopeSays) {
  LightBounds cone = at({0, 0, 0});
  cone.normals = 0.3, cone.emission = 0.5;
  const TreeScene two(kTwoPoints, {point_power(glm::dvec3(1), cone), point_power(glm::dvec3(1), at({0, 0, 1e-3}))});
  const auto share = [&](double angle) { return two.prob(0, 100.0 * glm::dvec3(std::sin(angle), 0, std::cos(angle))); };
  // Its power is that of the other, which shines everywhere.
  double mean = 0;
  constexpr int kSteps = 10'000;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = (i + 0.5) / kSteps * M_PI, off = std::max(0.0, angle - 0.3);
    const double facing = (std::cos(off) - std::cos(0.5)) / (1 - std::cos(0.5));
    if (off < 0.5) mean += facing * std::sin(angle) / 2 * M_PI / kSteps;
  }
  const auto expected = [&](double facing) { return facing / (mean + facing); };
  EXPECT_NEAR(share(0), expected(1), 1e-3);
  EXPECT_NEAR(share(0.29), expected(1), 1e-3);
  EXPECT_NEAR(share(0.6), expected((std::cos(0.3) - std::cos(0.5)) / (1 - std::cos(0.5))), 1e-3);
  EXPECT_NEAR(share(0.81), expected(double{kLeastFacing}), 1e-3);
  EXPECT_NEAR(share(M_PI), expected(double{kLeastFacing}), 1e-3);
}

TEST(LightTree, WhatHasNoPowerIsNeverChosen) {
  const TreeScene three(kTwoPoints + R"(<emitter type="point"/>)",
                        {point_power(glm::dvec3(1), at({0, 0, 0})), point_power(glm::dvec3(0), at({1, 0, 0})),
                         point_power(glm::dvec3(1), at({2, 0, 0}))});
  EXPECT_EQ(three.scene.view.light_leaves[1], kNone);
  EXPECT_NEAR(three.prob(0, {1, 0, 0}) + three.prob(2, {1, 0, 0}), 1, 1e-6);
}

TEST(LightTree, LightsInOnePlaceShareByIntensity) {
  std::vector<LightPower> powers;
  std::string lights;
  for (int i = 1; i <= 9; ++i) {
    powers.push_back(point_power(glm::dvec3(i), at({1, 2, 3})));
    lights += R"(<emitter type="point"/>)";
  }
  const TreeScene same(lights, powers);
  for (std::uint32_t i = 0; i < 9; ++i) EXPECT_NEAR(same.prob(i, {0, 0, 0}), weight(i + 1, 45, 9), 1e-5);
}

TEST(LightTree, IsWorthItForManyLights) {
  const auto nodes = [](std::size_t lights, const std::string& others) {
    std::string elements = others;
    for (std::size_t i = 0; i < lights; ++i) elements += R"(<emitter type="point"/>)";
    return LitScene(elements).compiled.tables().light_nodes.size();
  };
  EXPECT_EQ(nodes(kLightTreeFrom - 1, ""), 0u);
  EXPECT_EQ(nodes(kLightTreeFrom, ""), 2 * kLightTreeFrom - 1);
  std::string curtain;
  for (std::size_t i = 0; i < kLargeScene / 2; ++i) curtain += R"(<shape type="rectangle"/>)";
  EXPECT_EQ(nodes(2, curtain), 3u) << "where rays cost more";
  EXPECT_EQ(nodes(1, curtain), 0u);
  EXPECT_EQ(nodes(kLightTreeFrom, R"(<integrator type="ptracer"/>)"), 2 * kLightTreeFrom - 1)
      << "whatever the integrator: the scene may be looked at with another one";
}

void expect_bounds(const LightNode& node, const LightNode& leaf) {
  const LightCone outer = light_cone(broadcast_light_node(node)), inner = light_cone(broadcast_light_node(leaf));
  const double distance = glm::length(doubles(leaf.center) - doubles(node.center));
  EXPECT_LE(distance, std::sqrt(double{outer.radius2.v}) * 1.0001);
  const auto angle = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
  const double between = angle(glm::dot(glm::normalize(doubles(inner.axis)), glm::normalize(doubles(outer.axis))));
  const double reach = std::min(between + angle(double{inner.normals.cos.v}), M_PI);
  EXPECT_LE(reach, angle(double{outer.normals.cos.v}) + 1e-2) << "within what ten bits for a component tell";
  EXPECT_GE(inner.slope.v, outer.slope.v * 0.9999f);
}

TEST(LightTree, NodesBoundWhatIsBelow) {
  const LitScene scene(mixed_lights(140));
  const auto& nodes = scene.compiled.tables().light_nodes;
  std::vector<int> leaves(scene.view.light_count);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const LightNode& node = nodes[i];
    if ((node.content & kLightLeafBit) != 0) {
      ++leaves.at(node.content & ~kLightLeafBit);
      EXPECT_EQ(scene.view.light_leaves[node.content & ~kLightLeafBit], i);
      for (std::uint32_t k = node.parent; k != kNone; k = nodes.at(k).parent) expect_bounds(nodes[k], node);
      continue;
    }
    for (const std::uint32_t k : {node.content, node.content + 1}) EXPECT_EQ(nodes.at(k).parent, i);
  }
  for (const int n : leaves) EXPECT_EQ(n, 1);
}

TEST(LightTree, NeverChoosesWhatHasNoWeight) {
  const TreeScene tree(
      R"(<emitter type="point"/><emitter type="point"/><emitter type="directional"/><emitter type="directional"/>)",
      {{.own = 1}, {.own = 4, .weight = 0}, {.per_cross_section = 1, .weight = 0}, {.per_cross_section = 1}});
  const SceneTables& t = tree.scene.compiled.scene->tables;
  EXPECT_EQ(t.light_nodes.size(), 1u);
  EXPECT_EQ(t.light_leaves[1], kNone);
  ASSERT_EQ(t.lights_around.size(), 2u);
  EXPECT_EQ(t.lights_around[0].light, 3u);
  EXPECT_EQ(t.lights_around[0].prob, 0.5f);
}

}  // namespace
}  // namespace norrsken::isa_host
