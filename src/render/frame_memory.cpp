#include "render/frame_memory.h"

#include <fmt/format.h>

#include "render/wave_arena.h"
#include "scene/within_memory.h"
#include "tables/film_memory.h"

namespace norrsken {

std::optional<MemoryReservation> reserve_frame(const LoadedScene& scene, const SceneFrame& frame_of_scene,
                                               const FilmSettings& film, const SceneLayers& layers, int threads,
                                               Diagnostics& diagnostics) {
  const bool from_lights = frame_of_scene.integrator.from_lights;
  const WaveNeeds needs = WaveNeeds::of(frame_of_scene.integrator);
  const auto pixels = static_cast<std::uint64_t>(std::int64_t{film.width} * film.height);
  const MemoryScope scope(scene.memory);
  MemoryReservation frame(0);
  try {
    within_memory({}, fmt::format("a film of {} x {} pixels with its image", film.width, film.height), diagnostics,
                  [&] {
                    frame.grow(pixels * (film_bytes_per_pixel(film, frame_of_scene.sampler.kind, layers, from_lights) +
                                         image_bytes_per_pixel(film, layers)));
                  });
    within_memory({}, fmt::format("what {} thread{} work on", threads, threads == 1 ? "" : "s"), diagnostics,
                  [&] { frame.grow(static_cast<std::uint64_t>(threads) * WaveArena::bytes(kWaveSlots, needs)); });
  } catch (const LoadingStopped&) {
    return std::nullopt;
  }
  return frame;
}

}  // namespace norrsken
