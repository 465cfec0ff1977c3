// Nested <spectrum> and <texture> plugins that have one value wherever they are looked at.
#pragma once

#include "scene/description.h"

namespace norrsken {

class Parameters;

/// Whether the node is a `spectrum` or a `texture`. Mitsuba does not tell them apart, and neither do we.
bool is_spectrum_or_texture(const Node& node);

/// Whether it is one of: blackbody, d65 of no texture, irregular, rawconstant, regular, rgb, srgb, uniform.
bool is_constant_spectrum(const Node& node);

/// The texture in a `d65` node, or null: a colour that differs from place to place, lit by daylight. In RGB it is what that
/// texture is, and so are Mitsuba's.
const Node* texture_in_daylight(const Node& node);
/// What else such a node may have, which does nothing beside a texture.
void read_daylight(Parameters& node);

inline constexpr double kMaxTemperature = 1e12;  ///< of a black body, K
/// The radiance of a black body of `temperature` in kelvin, times `scale`.
Property::Spectrum blackbody_spectrum(double temperature, double scale = 1);

/// The value of such a node, as the property that would say the same: a number, a colour or a spectrum. After a
/// complaint anything.
Property::Value read_constant_spectrum(Parameters& node);

}  // namespace norrsken
