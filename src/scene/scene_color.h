// A colour as the scene says it.
#pragma once

#include <glm/vec3.hpp>
#include <utility>
#include <variant>
#include <vector>

#include "scene/parameter.h"

namespace norrsken {

/// Grey, linear sRGB, or a spectrum with its wavelengths: what was said is kept until somebody needs three numbers.
class SceneColor {
 public:
  using Spectrum = std::vector<std::pair<double, double>>;  ///< nm and values; one pair (0, v) is the constant v
  using Said = std::variant<double, glm::dvec3, Spectrum>;

  explicit SceneColor(double grey = 0) : said_(grey) {}
  explicit SceneColor(const glm::dvec3& rgb) : said_(rgb) {}
  /// `range` is that of the parameter: a saturated spectrum lies outside sRGB, and takes the nearest colour within.
  SceneColor(Spectrum spectrum, ColorOf of, const Range& range) : said_(std::move(spectrum)), of_(of), range_(range) {}

  const Said& said() const { return said_; }
  /// Linear sRGB. This is the one place where colours of a scene are turned into it.
  glm::dvec3 rgb() const;
  /// Of the components; what a colour counts for where a number is asked for.
  double mean() const;
  bool is_black() const { return rgb() == glm::dvec3(0); }

 private:
  Said said_;
  ColorOf of_ = ColorOf::surface;
  Range range_;
};

}  // namespace norrsken
