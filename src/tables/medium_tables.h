// Participating media as kernels see them: media, phase functions, volumes. Part of scene_tables.h.
#pragma once

#include <cstdint>

namespace norrsken {

inline constexpr std::uint32_t kNone = 0xffffffffu;
/// In place of a medium: the one that the ray is in already.
inline constexpr std::uint32_t kSameMedium = 0xfffffffeu;

/// Phase functions as kernels tell them apart; behind the models those that choose between others.
enum class PhaseKind : std::uint32_t {
#define NORRSKEN_PHASE(kind, Model) kind,
#include "lists/phase.def"
#undef NORRSKEN_PHASE
#define NORRSKEN_PHASE_ADAPTER(kind) kind,
#include "lists/phase_adapter.def"
#undef NORRSKEN_PHASE_ADAPTER
  count
};
inline constexpr std::uint32_t kPhaseModelCount = static_cast<std::uint32_t>(PhaseKind::blendphase);

/// A phase function in one word, as a material is: the kind, and the offset of its first float in `parameters`.
using PhaseWord = std::uint32_t;
inline constexpr PhaseWord kPhaseKindMask = 0xff000000u;
inline constexpr PhaseWord kPhaseOffsetMask = 0x00ffffffu;
constexpr PhaseWord make_phase(PhaseKind kind, std::uint32_t offset) {
  return (static_cast<std::uint32_t>(kind) << 24) | offset;
}

enum class VolumeFilter : std::uint32_t { trilinear, nearest };
/// Of coordinates beyond the unit cube.
enum class VolumeWrap : std::uint32_t { clamp, repeat, mirror };

/// Values over the unit cube of a space of its own.
struct VolumeRecord {
  float local_from_world[12];
  float size_x, size_y, size_z;  ///< values along each axis; 0: a constant
  std::uint32_t channels;        ///< of a grid: 1, 3 or 6, side by side
  std::uint32_t first;           ///< offset of a grid's values in `texels`, x fastest
  VolumeFilter filter;
  VolumeWrap wrap;
  float value[3];  ///< the constant
};

/// What a `blendphase` keeps in `parameters`.
struct PhaseBlend {
  float weight;          ///< share of the second
  std::uint32_t volume;  ///< that the weight differs with, or kNone
  PhaseWord first, second;
};

struct MediumRecord {
  float sigma_t[3];  ///< extinction per unit of length; of a heterogeneous medium the factor on that of its volume
  float albedo[3];   ///< share of it that is scattered, if there is no volume of it
  std::uint32_t albedo_volume = kNone;
  std::uint32_t sigma_volume = kNone;  ///< kNone: homogeneous
  std::uint32_t scatters = 0;          ///< 1: the albedo is not 0 everywhere
  std::uint32_t sample_emitters = 1;   ///< 0: lights are found by chance alone
  PhaseWord phase = 0;
  std::uint32_t flakes_volume = kNone;  ///< of an `sggx`, whose projected area is a factor on the extinction
  /// Of a heterogeneous medium: the box in the world that holds all of it, in cells that tell the largest extinction in them.
  float lower[3] = {}, upper[3] = {};
  float cells_x = 0, cells_y = 0, cells_z = 0;
  std::uint32_t majorants = 0;  ///< offset in `texels`, x fastest
};

}  // namespace norrsken
