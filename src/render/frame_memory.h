// The memory that a rendering takes beside its scene.
#pragma once

#include <memory>
#include <optional>

#include "accel/build.h"
#include "compile/compile.h"

namespace norrsken {

/// Of film, image and threads, out of the scene's budget and before any of them is allocated. Empty after a complaint.
std::optional<MemoryReservation> reserve_frame(const LoadedScene& scene, const FilmSettings& film,
                                               const SceneLayers& layers, int threads, Diagnostics& diagnostics);

/// The acceleration structure, in the scene's budget. Null after a complaint.
std::unique_ptr<const Accel> build_accel(const LoadedScene& scene, AccelKind kind, int threads,
                                         Diagnostics& diagnostics);

}  // namespace norrsken
