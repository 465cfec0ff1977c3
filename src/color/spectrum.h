// From spectra to linear sRGB: weighed with the CIE 1931 2-degree observer (color/cie_tables.h).
#pragma once

#include <span>
#include <utility>

#include "color/srgb.h"

namespace norrsken {

/// (wavelength in nm, value), ascending: linear in between, 0 outside, as in Mitsuba. One pair (0, v) stands for the
/// constant v.
using SpectrumSamples = std::span<const std::pair<double, double>>;

/// The CIE 1931 colour matching functions x, y, z at a wavelength in nm; 0 outside of 360 to 830.
ColorVector cie_matching(double wavelength);

/// The colour of a surface in daylight, the standard illuminant D65, which is sRGB's white: the constant r becomes
/// (r, r, r). Saturated spectra lie outside sRGB and get components below 0 or above 1.
ColorVector rgb_of_reflectance(SpectrumSamples samples);

/// The colour of a light, scaled so that luminance is the mean of the spectrum weighed with y. Equal energy at all
/// wavelengths, the constant too, is slightly red.
ColorVector rgb_of_emission(SpectrumSamples samples);

/// Spectral radiance of a black body in W/(m^2 sr nm); wavelength in nm, temperature in kelvin.
/// Source: Planck's law; CODATA 2018 constants.
double blackbody_radiance(double wavelength, double temperature);

}  // namespace norrsken
