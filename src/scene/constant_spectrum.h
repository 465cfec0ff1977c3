// Nested <spectrum> and <texture> plugins that have one value wherever they are looked at.
#pragma once

#include "scene/description.h"

namespace norrsken {

class Parameters;

/// Whether the node is a `spectrum` or a `texture`. Mitsuba does not tell them apart, and neither do we.
bool is_spectrum_or_texture(const Node& node);

/// Whether it is one of: blackbody, d65, irregular, rawconstant, regular, srgb, uniform.
bool is_constant_spectrum(const Node& node);

inline constexpr double kMaxTemperature = 1e12;  ///< of a black body, K
/// The radiance of a black body of `temperature` in kelvin, times `scale`.
Property::Spectrum blackbody_spectrum(double temperature, double scale = 1);

/// The value of such a node, as the property that would say the same: a number, a colour or a spectrum. After a
/// complaint anything.
Property read_constant_spectrum(Parameters& node);

}  // namespace norrsken
