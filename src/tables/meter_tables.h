// The surface that a meter looks at or stands on, in pieces (SceneTables::meter): a power of two of them, of which the last
// may be empty.
#pragma once

#include <cstdint>

namespace norrsken {

/// Unit shapes: the triangle and the square with a corner in the origin, the disk around it, all facing +z; the sphere; the
/// cylinder around z from 0 to 1.
enum class MeterKind : std::uint32_t { triangle, parallelogram, disk, sphere, cylinder };

// Floats of a piece: where its share of the area begins, counted over all pieces, and how large it is; the kind; -1 where
// the normal is to be turned around; the affine map that places it, row by row, which takes the normal along: its third
// column is that of flat pieces.
inline constexpr std::uint32_t kMeterBegin = 0, kMeterShare = 1, kMeterKind = 2, kMeterSide = 3, kMeterPlace = 4,
                               kMeterPieceFloats = 16;

/// In place of a number of pieces: all that there is in the scene.
inline constexpr std::uint32_t kWholeScene = 0xffffffffu;

}  // namespace norrsken
