// What both kinds of media are told, and what becomes of it.
#pragma once

#include "compile/media.h"

namespace norrsken {

/// More is no medium but a wall, and beyond what can be calculated with.
inline constexpr double kMostExtinction = 1e15;

inline constexpr ColorParameter kSigmaT{
    .name = "sigma_t",
    .fallback = 1,
    .range = kFromZero,
    .text = "extinction: what is scattered and absorbed of light on a unit of length"};
inline constexpr ColorParameter kAlbedo{
    .name = "albedo",
    .fallback = 0.75,
    .range = kShare,
    .text = "share of the extinguished light that is scattered, the rest is absorbed"};
inline constexpr NumberParameter kScale{
    .name = "scale", .fallback = 1, .range = kFromZero, .text = "factor on sigma_t"};
inline constexpr BooleanParameter kSampleEmitters{
    .name = "sample_emitters",
    .fallback = true,
    .text = "whether light is looked for where the medium scatters, or found by chance alone"};

/// Reads everything but the extinction: albedo, sample_emitters, phase function.
void read_scattering(Parameters& p, Media& media, MediumRecord& record);

/// The largest factor that the flakes of an `sggx`, which the record has, are on the extinction.
double largest_area(const SceneTables& tables, const MediumRecord& record);

/// Makes a medium heterogeneous with the extinction `scale` times `volume`. `what`: of which parameter.
void set_extinction(Parameters& p, Media& media, const Volume& volume, double scale, MediumRecord& record);

/// A warning if a volume's values are out of range: they are clamped as they are looked up.
void warn_beyond(Parameters& p, std::string_view name, const Volume& volume, const Range& range);

}  // namespace norrsken
