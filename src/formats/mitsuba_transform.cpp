// The steps of a <transform>, as Mitsuba 3 defines them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "formats/mitsuba_values.h"

namespace norrsken {
namespace {

using Matrix = std::optional<glm::dmat4>;

Matrix translate(const Element& step, RotationAxis, Diagnostics& diagnostics) {
  const auto by = read_coordinates(step, 0.0, diagnostics);
  return by ? Matrix(glm::translate(glm::dmat4(1), *by)) : std::nullopt;
}

Matrix scale(const Element& step, RotationAxis, Diagnostics& diagnostics) {
  const auto by = read_coordinates(step, 1.0, diagnostics);
  return by ? Matrix(glm::scale(glm::dmat4(1), *by)) : std::nullopt;
}

// Rodrigues' formula, cos I + sin [a] + (1 - cos) a a^T, for a vector of any length.
glm::dmat4 rodrigues(const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle);
  const glm::dmat3 cross(0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0);
  return glm::dmat4(glm::dmat3(c) + std::sin(angle) * cross + (1 - c) * glm::outerProduct(axis, axis));
}

Matrix rotate(const Element& step, RotationAxis meaning, Diagnostics& diagnostics) {
  const auto axis = read_coordinates(step, 0.0, diagnostics);
  const auto degrees = read_float(*step.find("angle"), diagnostics);
  if (!axis || !degrees) return std::nullopt;
  const double angle = *degrees * std::numbers::pi / 180, length = glm::length(*axis);
  if (!(length > 0) || !std::isfinite(length)) {
    diagnostics.error(step.location, fmt::format("({}, {}, {}) is no axis to rotate about", axis->x, axis->y, axis->z),
                      "a direction such as x=\"1\"");
    return std::nullopt;
  }
  constexpr double kFewDigits = 1e-3;  // off a unit vector by no more than its decimals are
  if (meaning == RotationAxis::direction || std::abs(length - 1) < kFewDigits || angle == 0)
    return rodrigues(*axis / length, angle);
  diagnostics.warning(
      step.location,
      fmt::format("the axis is {:.4g} long, and the step no rotation: it stretches besides, as in Mitsuba 3", length),
      fmt::format("the axis value=\"{:.6g} {:.6g} {:.6g}\" for a rotation", axis->x / length + 0.0,
                  axis->y / length + 0.0, axis->z / length + 0.0));
  return rodrigues(*axis, angle);
}

// The upward direction where none is given: which one is a convention, and Mitsuba's decides how the picture is rolled.
// Source: the first vector of Duff et al., "Building an Orthonormal Basis, Revisited", 2017, listing 3.
glm::dvec3 default_up(glm::dvec3 forward) {
  const double sign = std::copysign(1.0, forward.z);
  const double a = -1 / (sign + forward.z);
  return {1 + sign * forward.x * forward.x * a, sign * forward.x * forward.y * a, -sign * forward.x};
}

// What a view is made of; `up` of length 0 is none. Complaints about a point or direction are told at its place.
struct View {
  glm::dvec3 origin, target, up;
  SourceLocation target_place, up_place;
};

// Looks along +z with +y up and +x to the left, as Mitsuba's sensors do.
Matrix look(const View& view, Diagnostics& diagnostics) {
  const double distance = glm::length(view.target - view.origin);
  if (!(distance > 0) || !std::isfinite(distance)) {
    diagnostics.error(view.target_place, "'target' is the same point as 'origin'", "a point to look at, some way off");
    return std::nullopt;
  }
  const glm::dvec3 forward = (view.target - view.origin) / distance;
  const double up_length = glm::length(view.up);
  const glm::dvec3 up_direction = up_length > 0 ? view.up / up_length : default_up(forward);
  const glm::dvec3 left = glm::cross(up_direction, forward);
  if (!(glm::length(left) > 1e-14)) {
    diagnostics.error(view.up_place, "'up' points along the line of sight", "a direction that does not");
    return std::nullopt;
  }
  const glm::dvec3 x = glm::normalize(left);
  return glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(forward, x), 0), glm::dvec4(forward, 0),
                    glm::dvec4(view.origin, 1));
}

Matrix lookat(const Element& step, RotationAxis, Diagnostics& diagnostics) {
  const Literal &target_text = *step.find("target"), *up_text = step.find("up");
  const auto origin = read_vector(*step.find("origin"), diagnostics);
  const auto target = read_vector(target_text, diagnostics);
  const auto up = up_text ? read_vector(*up_text, diagnostics) : std::optional(glm::dvec3(0));
  if (!origin || !target || !up) return std::nullopt;
  return look({*origin, *target, *up, target_text.location(), up_text ? up_text->location() : step.location},
              diagnostics);
}

Matrix lookat_of_numbers(const Element& step, RotationAxis, Diagnostics& diagnostics) {
  glm::dvec3 points[3] = {};
  bool good = true;
  for (int i = 0; i < 9; ++i) {
    const Literal* number = step.find(std::string{"otu"[i / 3], "xyz"[i % 3]});
    const auto value = number ? read_float(*number, diagnostics) : std::optional(0.0);
    good = good && value;
    points[i / 3][i % 3] = value.value_or(0);
  }
  if (!good) return std::nullopt;
  const auto view = look({points[0], points[1], points[2], step.location, step.location}, diagnostics);
  return view ? Matrix(*view * glm::scale(glm::dmat4(1), glm::dvec3(-1, 1, 1))) : std::nullopt;
}

Matrix matrix(const Element& step, RotationAxis, Diagnostics& diagnostics) {
  const Literal& literal = *step.find("value");
  auto values = read_floats(literal, diagnostics);
  if (!values) return std::nullopt;
  if (values->size() != 16 && values->size() != 9) {
    diagnostics.error(literal.location(), fmt::format("a matrix of {} numbers", values->size()),
                      "16 numbers (4x4), or 9 (3x3), row after row");
    return std::nullopt;
  }
  const int size = values->size() == 16 ? 4 : 3;
  if (size == 4) {
    // Of a matrix that was printed with six decimals, the last row is not quite what it is.
    constexpr double kFewDigits = 1e-5;
    const double affine[] = {0, 0, 0, 1};
    double* last = values->data() + 12;
    if (std::equal(last, last + 4, affine, [](double a, double b) { return std::abs(a - b) < kFewDigits; }))
      std::copy_n(affine, 4, last);
  }
  glm::dmat4 result(1);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column)
      result[column][row] = (*values)[static_cast<std::size_t>(row * size + column)];
  }
  return result;
}

struct Step {
  std::string_view name;
  AttributeRules rules;
  Matrix (*read)(const Element&, RotationAxis, Diagnostics&);
};

const std::vector<Step>& steps() {
  static const std::vector<Step> all = {
      {"translate", {{}, {"value", "x", "y", "z"}}, translate},
      {"scale", {{}, {"value", "x", "y", "z"}}, scale},
      {"rotate", {{"angle"}, {"value", "x", "y", "z"}}, rotate},
      {"lookat", {{"origin", "target"}, {"up"}}, lookat},
      {"look_at", {{"origin", "target"}, {"up"}}, lookat},
      {"matrix", {{"value"}, {}}, matrix},
      {kLookatOfNumbers, {{"ox", "oy", "oz", "tx", "ty", "tz"}, {"ux", "uy", "uz"}}, lookat_of_numbers}};
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
  for (const Step& step : steps()) {
    if (step.name != kLookatOfNumbers) names.emplace_back(step.name);
  }
  return names;
}

std::optional<glm::dmat4> read_transform_step(const Element& step, RotationAxis axis, Diagnostics& diagnostics) {
  return find_step(step.name)->read(step, axis, diagnostics);
}

}  // namespace norrsken
