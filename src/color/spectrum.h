// From measured spectra to linear sRGB.
//
// Colour matching: the multi-lobe fit of the CIE 1931 2-degree observer by Wyman, Sloan and Shirley, "Simple Analytic
// Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013, equation 4.
#pragma once

#include <span>
#include <utility>

#include "color/srgb.h"

namespace norrsken {

/// (wavelength in nm, value), ascending: linear in between, 0 outside, as in Mitsuba. One pair (0, v) stands for the
/// constant v.
using SpectrumSamples = std::span<const std::pair<double, double>>;

/// The CIE 1931 colour matching functions x, y, z at a wavelength in nm.
ColorVector cie_matching(double wavelength);

/// The colour of a surface under light of equal energy at all wavelengths, with that light's white carried over to
/// sRGB's (Bradford transform): the constant r becomes (r, r, r). Saturated spectra lie outside sRGB and get components
/// below 0 or above 1.
ColorVector rgb_of_reflectance(SpectrumSamples samples);

/// The colour of a light, scaled so that luminance is the mean of the spectrum weighed with y. The constant v means
/// "white" and becomes (v, v, v), as in Mitsuba's RGB modes; a spectrum that spells out equal energy is slightly red.
ColorVector rgb_of_emission(SpectrumSamples samples);

}  // namespace norrsken
