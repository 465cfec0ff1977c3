// The memory that a rendering takes beside its scene.
#pragma once

#include <optional>

#include "compile/compile.h"

namespace norrsken {

/// Of film, image and threads, out of the scene's budget and before any of them is allocated. Empty after a complaint.
std::optional<MemoryReservation> reserve_frame(const LoadedScene& scene, const SceneFrame& frame,
                                               const FilmSettings& film, const SceneLayers& layers, int threads,
                                               Diagnostics& diagnostics);

}  // namespace norrsken
