#include "color/tone.h"

#include <algorithm>
#include <cmath>

#include "color/srgb.h"

namespace norrsken {

float filmic_curve(float linear) {
  // Written so that NaN becomes 0; the upper bound, far above the curve's white, keeps the squares finite.
  const float x = linear > 0 ? std::min(linear, 1000.0f) : 0.0f;
  return std::min((x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f), 1.0f);
}

ToneMapper::ToneMapper(const ToneMapping& tone) : curve_(tone.curve), scale_(std::exp2(tone.exposure)) {}

float ToneMapper::operator()(float radiance) const {
  // Black stays black at any exposure; 0 times an infinite scale would be NaN.
  if (!(radiance > 0)) return 0;
  const float exposed = radiance * scale_;
  const float display = curve_ == ToneMapping::Curve::filmic ? filmic_curve(exposed) : std::min(exposed, 1.0f);
  return display > 0 ? std::min(srgb_from_linear(display), 1.0f) : 0.0f;
}

std::uint8_t byte_from_unit(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

}  // namespace norrsken
