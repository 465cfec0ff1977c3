// What every scattering model gives to the shading stage. Directions are local, z is the shading normal on the side
// that the ray came from; `wo` points back along the ray, `wi` to where light comes from; both unit.
//
// A model is a struct with
//   static constexpr bool kDelta;              all of it is delta functions: nothing to evaluate
//   static constexpr bool kUsesLobe;           sample looks at `lobe`
//   struct Stored;                             its block of parameters, which the host fills (tables/slots.h), with its kKind
//   struct Parameters;                         what comes of it, in lanes
//   static Parameters load(const ParameterReader&);
//   static Color evaluate(const Parameters&, wo, wi);                f times |cos(wi)|
//   static Float pdf_sa(const Parameters&, wo, wi);
//   static BsdfSample sample(const Parameters&, wo, Float lobe, Vec2f direction);
//   static Color albedo(const Parameters&);    for the feature layer
//   static Color straight_on(const Parameters&, wo);    only of some delta models: the share of light that passes as if
//                                                       nothing were there. They scatter by that or by reflection
//   static Float refracted_eta(const Parameters&);    only if evaluate refracts: index of refraction beyond over this side
//   static Mask transmits(const Parameters&);         only if evaluate may be other than 0 for wi.z < 0: where it may be
// Of a model with both, evaluate and pdf_sa leave the delta part out. wi.z < 0 is transmission.
#pragma once

#include "math/warp.h"
#include "texture/parameter_reader.h"

namespace norrsken::NORRSKEN_ISA {

struct BsdfSample {
  Vec3f wi;
  Color weight;      ///< f |cos| / pdf_sa; for a delta direction its share of the light
  Float pdf_sa;      ///< 0 for a delta direction
  Mask valid;        ///< false: nothing scatters here, the path ends
  Float eta = 1.0f;  ///< index of refraction beyond over that on this side, if the direction crosses; else 1
};

}  // namespace norrsken::NORRSKEN_ISA
