#include "compile/light_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace norrsken {
namespace {

std::vector<LightRecord> chosen_by(const std::vector<double>& powers) {
  std::vector<LightRecord> lights(powers.size());
  fill_alias_table(lights, powers);
  return lights;
}

/// The probability that the table gives to each light: its own share of its column and what others lend it.
std::vector<double> probabilities_of_table(const std::vector<LightRecord>& lights) {
  std::vector<double> result(lights.size(), 0.0);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    EXPECT_GE(lights[i].alias_prob, 0);
    EXPECT_LE(lights[i].alias_prob, 1);
    result[i] += lights[i].alias_prob;
    result.at(lights[i].alias) += 1 - double{lights[i].alias_prob};
  }
  for (double& p : result) p /= static_cast<double>(lights.size());
  return result;
}

void expect_proportional(const std::vector<double>& powers) {
  const auto lights = chosen_by(powers);
  double total = 0, prob_total = 0;
  for (const double power : powers) total += power;
  const auto table = probabilities_of_table(lights);
  for (std::size_t i = 0; i < powers.size(); ++i) {
    EXPECT_NEAR(lights[i].prob, powers[i] / total, 1e-7) << i;
    EXPECT_NEAR(table[i], powers[i] / total, 1e-7) << i;
    prob_total += lights[i].prob;
  }
  EXPECT_NEAR(prob_total, 1, 1e-5);
}

TEST(LightChoice, TableAndProbabilitiesAreProportionalToPower) {
  expect_proportional({7});
  expect_proportional({1, 1, 1});
  expect_proportional({1, 2, 3, 4});
  expect_proportional({1000, 1, 1, 1, 1});
  expect_proportional({0, 0, 5, 0, 1});
  std::mt19937 random(1);
  std::vector<double> many(1000);
  for (double& power : many) power = std::exp(std::normal_distribution<double>(0, 3)(random));
  expect_proportional(many);
}

TEST(LightChoice, LightsWithoutPowerAreNeverChosen) {
  const auto lights = chosen_by({0, 3, 0, 1e-3, 0});
  for (const std::size_t i : {0u, 2u, 4u}) {
    EXPECT_EQ(lights[i].prob, 0);
    EXPECT_EQ(probabilities_of_table(lights)[i], 0);
  }
}

TEST(LightChoice, WithoutAnyPowerAllAreAlike) {
  const auto lights = chosen_by({0, 0, 0, 0});
  for (const LightRecord& light : lights) EXPECT_EQ(light.prob, 0.25f);
  for (const double p : probabilities_of_table(lights)) EXPECT_EQ(p, 0.25);
}

TEST(LightChoice, NoLightsAreNoTrouble) { fill_alias_table({}, {}); }

TEST(LightChoice, HalfOfTheChoiceIsByPowerAndHalfIsEven) {
  const std::vector<LightPower> lights = {{.own = 9}, {.own = 1}, {.own = 0}};
  const auto shares = shares_of_choice(lights);
  EXPECT_NEAR(shares[0], 0.7, 1e-12);
  EXPECT_NEAR(shares[1], 0.3, 1e-12);
  EXPECT_EQ(shares[2], 0);
}

TEST(LightChoice, WeightsAreFactorsOnShares) {
  const std::vector<LightPower> lights = {
      {.own = 9, .weight = 2}, {.own = 1}, {.own = 5, .weight = 0}, {.per_cross_section = 4, .weight = 3}};
  const auto shares = shares_of_choice(lights);
  EXPECT_NEAR(shares[0], 1.4, 1e-12);
  EXPECT_NEAR(shares[1], 0.3, 1e-12);
  EXPECT_EQ(shares[2], 0);
  EXPECT_EQ(shares[3], 3);
}

TEST(LightChoice, WhatSurroundsTheSceneIsChosenAsOftenAsAllThatIsInIt) {
  const std::vector<LightPower> lights = {{.own = 3}, {.per_cross_section = 1e9}, {.own = 3}, {.per_cross_section = 1}};
  const auto shares = shares_of_choice(lights);
  EXPECT_NEAR(shares[0] + shares[2], 1, 1e-12);
  EXPECT_EQ(shares[1], 1);
  EXPECT_EQ(shares[3], 1);
}

TEST(LightPower, IsLuminanceTimesAreaTimesSolidAngle) {
  EXPECT_NEAR(surface_power(4, glm::dvec3(10), {}).own, 40 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(point_power(glm::dvec3(10), {}).own, 40 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(point_power({0, 10, 0}, {}).own / (40 * std::numbers::pi), 0.7152, 1e-4);
  EXPECT_NEAR(environment_power(glm::dvec3(10)).per_cross_section, 40 * std::numbers::pi, 1e-9);
}

}  // namespace
}  // namespace norrsken
