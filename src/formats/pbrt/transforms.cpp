// The directives that change the current transforms.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "base/text.h"
#include "formats/pbrt/directives.h"

namespace norrsken::pbrt {

void DirectiveReader::concatenate(const glm::dmat4& by) {
  if (state_.changes_start) state_.transforms.start *= by;
  if (state_.changes_end) state_.transforms.end *= by;
}

void DirectiveReader::replace(const glm::dmat4& by) {
  if (state_.changes_start) state_.transforms.start = by;
  if (state_.changes_end) state_.transforms.end = by;
}

void DirectiveReader::read_identity(const Token& /*word*/) { replace(glm::dmat4(1)); }

void DirectiveReader::read_translate(const Token& word) {
  const auto n = take_numbers(word, 3);
  if (n) concatenate(glm::translate(glm::dmat4(1), glm::dvec3((*n)[0], (*n)[1], (*n)[2])));
}

void DirectiveReader::read_scale(const Token& word) {
  const auto n = take_numbers(word, 3);
  if (n) concatenate(glm::scale(glm::dmat4(1), glm::dvec3((*n)[0], (*n)[1], (*n)[2])));
}

void DirectiveReader::read_rotate(const Token& word) {
  const auto n = take_numbers(word, 4);
  if (!n) return;
  const glm::dvec3 axis((*n)[1], (*n)[2], (*n)[3]);
  if (glm::length(axis) == 0) return error(word.place, "Rotate has no axis", "an angle, and a vector that is not 0");
  concatenate(glm::rotate(glm::dmat4(1), glm::radians((*n)[0]), axis));
}

void DirectiveReader::read_look_at(const Token& word) {
  const auto n = take_numbers(word, 9);
  if (!n) return;
  const auto vector = [&](std::size_t i) { return glm::dvec3((*n)[i], (*n)[i + 1], (*n)[i + 2]); };
  const glm::dvec3 eye = vector(0), forward = vector(3) - eye, up = vector(6);
  const glm::dvec3 right = glm::cross(up, forward);
  if (glm::length(right) == 0)
    return error(word.place, "LookAt has no direction, or one along its up",
                 "two different points, and another direction");
  const glm::dvec3 z = glm::normalize(forward), x = glm::normalize(right);
  const glm::dmat4 world_from_camera(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0),
                                     glm::dvec4(eye, 1));
  concatenate(glm::inverse(world_from_camera));
}

std::optional<glm::dmat4> DirectiveReader::take_matrix(const Token& word) {
  const auto n = take_numbers(word, 16);
  if (!n) return std::nullopt;
  glm::dmat4 matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = (*n)[i];
  if (matrix[0][3] == 0 && matrix[1][3] == 0 && matrix[2][3] == 0 && matrix[3][3] == 1) return matrix;
  error(word.place, fmt::format("the matrix of {} is not affine", word.text),
        "0, 0, 0 and 1 as its 4th, 8th, 12th and 16th number");
  return std::nullopt;
}

void DirectiveReader::read_transform(const Token& word) {
  if (const auto matrix = take_matrix(word)) replace(*matrix);
}

void DirectiveReader::read_concat_transform(const Token& word) {
  if (const auto matrix = take_matrix(word)) concatenate(*matrix);
}

void DirectiveReader::read_coordinate_system(const Token& word) {
  if (const auto name = take_string(word, "a name")) coordinate_systems_[name->value] = state_.transforms;
}

void DirectiveReader::read_coord_sys_transform(const Token& word) {
  const auto name = take_string(word, "a name");
  if (!name) return;
  if (const auto found = coordinate_systems_.find(name->value); found != coordinate_systems_.end()) {
    state_.transforms = found->second;
    return;
  }
  std::vector<std::string> known;
  for (const auto& [other, transforms] : coordinate_systems_) known.push_back(other);
  context_.diagnostics.warning(
      name->place.location(),
      fmt::format("there is no coordinate system {}{}", quoted(name->value), did_you_mean(name->value, known)),
      known.empty() ? "one that CoordinateSystem names" : listed(known));
}

void DirectiveReader::read_active_transform(const Token& word) {
  static const std::vector<std::string> kTimes = {"All", "EndTime", "StartTime"};
  const Token* next = lexer_->peek();
  const std::string time(next ? next->text : std::string_view());
  if (std::ranges::find(kTimes, time) == kTimes.end())
    return error(next ? next->place : lexer_->end(),
                 fmt::format("unknown time {} of ActiveTransform{}", quoted(time), did_you_mean(time, kTimes)),
                 join(kTimes));
  lexer_->take();
  state_.changes_start = time != "EndTime";
  state_.changes_end = time != "StartTime";
  if (!(state_.changes_start && state_.changes_end))
    context_.tell(word.place, "motion is not supported", "everything where it is as the shutter opens");
}

void DirectiveReader::read_transform_times(const Token& word) { take_numbers(word, 2); }

}  // namespace norrsken::pbrt
