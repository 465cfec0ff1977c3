// From linear radiance to the values and bytes that a screen shows.
#pragma once

#include <cstdint>

#include "norrsken/image.h"

namespace norrsken {

/// Narkowicz's fit of the ACES reference and sRGB output transforms, with the fit's own exposure (1 becomes 0.80):
/// linear scene value in, linear display value in [0,1] out; 0 at 0, 1 from about 7.24 on.
/// Departure: none; negative values and NaN give 0.
/// Source: Krzysztof Narkowicz, "ACES Filmic Tone Mapping Curve", 2016,
/// https://knarkowicz.wordpress.com/2016/01/06/aces-filmic-tone-mapping-curve/
float filmic_curve(float linear);

/// Applies a ToneMapping to one channel after another; the exposure's power is taken once.
class ToneMapper {
 public:
  explicit ToneMapper(const ToneMapping& tone);

  /// The sRGB-encoded display value in [0,1] of a radiance. Radiance above white and +infinity give 1, negative
  /// radiance, -infinity and NaN give 0.
  float operator()(float radiance) const;

 private:
  ToneMapping::Curve curve_;
  float scale_;
};

/// The byte of a value in [0,1], rounded to nearest.
std::uint8_t byte_from_unit(float value);

}  // namespace norrsken
