// The steps of a <transform>, as Mitsuba 3 defines them.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "formats/mitsuba_values.h"

namespace norrsken {
namespace {

using Matrix = std::optional<glm::dmat4>;

Matrix translate(const Element& step, Diagnostics& diagnostics) {
  const auto by = read_coordinates(step, 0.0, diagnostics);
  return by ? Matrix(glm::translate(glm::dmat4(1), *by)) : std::nullopt;
}

Matrix scale(const Element& step, Diagnostics& diagnostics) {
  const auto by = read_coordinates(step, 1.0, diagnostics);
  return by ? Matrix(glm::scale(glm::dmat4(1), *by)) : std::nullopt;
}

Matrix rotate(const Element& step, Diagnostics& diagnostics) {
  const auto axis = read_coordinates(step, 0.0, diagnostics);
  const auto degrees = read_float(*step.find("angle"), diagnostics);
  if (!axis || !degrees) return std::nullopt;
  if (const double length = glm::length(*axis); length > 0 && std::isfinite(length))
    return glm::rotate(glm::dmat4(1), *degrees * std::numbers::pi / 180, *axis);
  diagnostics.error(step.location, fmt::format("({}, {}, {}) is no axis to rotate about", axis->x, axis->y, axis->z),
                    "a direction such as x=\"1\"");
  return std::nullopt;
}

// The upward direction where none is given: which one is a convention, and Mitsuba's decides how the picture is rolled.
// Source: the first vector of Duff et al., "Building an Orthonormal Basis, Revisited", 2017, listing 3.
glm::dvec3 default_up(glm::dvec3 forward) {
  const double sign = std::copysign(1.0, forward.z);
  const double a = -1 / (sign + forward.z);
  return {1 + sign * forward.x * forward.x * a, sign * forward.x * forward.y * a, -sign * forward.x};
}

// Looks along +z with +y up and +x to the left, as Mitsuba's sensors do.
Matrix lookat(const Element& step, Diagnostics& diagnostics) {
  const auto origin = read_vector(*step.find("origin"), diagnostics);
  const auto target = read_vector(*step.find("target"), diagnostics);
  std::optional<glm::dvec3> up(glm::dvec3(0));
  if (const Literal* literal = step.find("up")) up = read_vector(*literal, diagnostics);
  if (!origin || !target || !up) return std::nullopt;

  const double distance = glm::length(*target - *origin);
  if (!(distance > 0) || !std::isfinite(distance)) {
    diagnostics.error(step.find("target")->location(), "'target' is the same point as 'origin'",
                      "a point to look at, some way off");
    return std::nullopt;
  }
  const glm::dvec3 forward = (*target - *origin) / distance;
  const double up_length = glm::length(*up);
  const glm::dvec3 up_direction = up_length > 0 ? *up / up_length : default_up(forward);
  const glm::dvec3 left = glm::cross(up_direction, forward);
  if (!(glm::length(left) > 1e-14)) {
    diagnostics.error(step.find("up")->location(), "'up' points along the line of sight", "a direction that does not");
    return std::nullopt;
  }
  const glm::dvec3 x = glm::normalize(left);
  return glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(forward, x), 0), glm::dvec4(forward, 0),
                    glm::dvec4(*origin, 1));
}

Matrix matrix(const Element& step, Diagnostics& diagnostics) {
  const Literal& literal = *step.find("value");
  const auto values = read_floats(literal, diagnostics);
  if (!values) return std::nullopt;
  if (values->size() != 16 && values->size() != 9) {
    diagnostics.error(literal.location(), fmt::format("a matrix of {} numbers", values->size()),
                      "16 numbers (4x4), or 9 (3x3), row after row");
    return std::nullopt;
  }
  const int size = values->size() == 16 ? 4 : 3;
  glm::dmat4 result(1);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column)
      result[column][row] = (*values)[static_cast<std::size_t>(row * size + column)];
  }
  return result;
}

struct Step {
  const char* name;
  AttributeRules rules;
  Matrix (*read)(const Element&, Diagnostics&);
};

const std::vector<Step>& steps() {
  static const std::vector<Step> all = {
      {"translate", {{}, {"value", "x", "y", "z"}}, translate},  {"scale", {{}, {"value", "x", "y", "z"}}, scale},
      {"rotate", {{"angle"}, {"value", "x", "y", "z"}}, rotate}, {"lookat", {{"origin", "target"}, {"up"}}, lookat},
      {"look_at", {{"origin", "target"}, {"up"}}, lookat},       {"matrix", {{"value"}, {}}, matrix}};
  return all;
}

const Step* find_step(std::string_view name) {
  for (const Step& step : steps()) {
    if (step.name == name) return &step;
  }
  return nullptr;
}

}  // namespace

std::optional<AttributeRules> transform_step_rules(std::string_view name) {
  const Step* step = find_step(name);
  return step ? std::optional(step->rules) : std::nullopt;
}

std::vector<std::string> transform_step_names() {
  std::vector<std::string> names;
  for (const Step& step : steps()) names.emplace_back(step.name);
  return names;
}

std::optional<glm::dmat4> read_transform_step(const Element& step, Diagnostics& diagnostics) {
  return find_step(step.name)->read(step, diagnostics);
}

}  // namespace norrsken
