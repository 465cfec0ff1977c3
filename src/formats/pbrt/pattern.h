// A texture as a function of the surface's (u, v), which is how pbrt's trees of textures become images.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "formats/pbrt/context.h"

namespace norrsken::pbrt {

struct Pattern {
  static constexpr double kNoPeriod = Parameters::kInfinity;

  std::function<glm::dvec3(const glm::dvec2& uv)> at = {};  ///< linear sRGB; of a number all three alike
  bool is_constant = true;
  // Of those that are not constant:
  glm::dvec2 period{0};                   ///< in u and v; 0: does not change along it
  glm::dvec2 texels{0};                   ///< of one unit of u and v, which show it as finely as it is
  glm::dvec2 origin{0};                   ///< where the image begins, for those that are
  bool is_sharp = false;                  ///< each texel has one value all over
  std::shared_ptr<const Node> node = {};  ///< the texture that is this very pattern, where there is one
  /// Of one that has nothing else yet but its node: the same with the rest, for which the image has to be read.
  std::function<Pattern()> whole = {};

  static Pattern constant(const glm::dvec3& color);
  glm::dvec3 value() const { return at({0, 0}); }  ///< of a constant
  glm::dvec3 mean() const;
};

/// A pattern made of one or more others, point by point.
Pattern map(const Pattern& a, const std::function<glm::dvec3(const glm::dvec3&)>& f);
Pattern map(const std::vector<Pattern>& all, const std::function<glm::dvec3(const std::vector<glm::dvec3>&)>& f);

/// Gives a plugin its parameter: a number, a colour, or a texture (an image is drawn if need be).
void give_number(Context& context, Node& node, const std::string& name, const Pattern& pattern, const Place& place);
void give_color(Context& context, Node& node, const std::string& name, const Pattern& pattern, const Place& place);
/// The texture itself, also of a constant.
std::shared_ptr<const Node> texture_node(Context& context, const Pattern& pattern, const Place& place, bool grey);
/// A texture that holds an image which is looked up so that its first row is at v = 0.
Node image_node(Context& context, Image image, const Place& place);

}  // namespace norrsken::pbrt
