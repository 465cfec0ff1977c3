// How much light a rough dielectric coat lets through and holds back: what roughplastic is tabulated from.
#pragma once

#include <cstdint>
#include <vector>

namespace norrsken {

struct RoughCoat {
  std::vector<double> transmittances;  ///< from outside, for cosines evenly from 0 to 1
  double from_inside;                  ///< reflectance for diffuse light from below
};

/// Integrates over the normals that are visible, as roughplastic.h samples them; facets that others mask absorb.
/// `eta`: index of refraction inside over that outside, not 1. Where it is above 1, within 1e-3 of the integrals; below,
/// where total reflection has an edge, within 1e-2. A third of a millisecond.
RoughCoat integrate_rough_coat(float alpha, bool ggx, double eta, std::uint32_t cosines);

/// The same, for the price of a look if this thread has lately computed it: scenes use the same few coats for many
/// materials, and are loaded again with other parameters.
RoughCoat rough_coat(double alpha, bool ggx, double eta, std::uint32_t cosines);

}  // namespace norrsken
