// What a scene and the options of a rendering ask for: its film, its layers, its samples.
#pragma once

#include <cstdint>
#include <limits>

#include "film/film.h"
#include "norrsken/render.h"
#include "render/sample_schedule.h"
#include "render/work_plan.h"

namespace norrsken {

inline constexpr std::uint32_t kMostSamples = std::numeric_limits<int>::max();

/// Complains about options that have no meaning, alone, together or with this scene.
void check_options(const Scene& scene, const RenderOptions& options, Diagnostics& diagnostics);

FilmSettings film_settings(const Scene& scene);

/// The scene's own, and those that are asked for.
SceneLayers layers(const Scene& scene, const RenderOptions& options);

/// The samples that are asked for, by the scene if nobody else does.
SampleRange sample_range(const Scene& scene, const RenderOptions& options);

/// The samples that layers take: scenes that name layers get them of as many as the image, others of the first few of all.
SampleRange feature_range(const Scene& scene, const RenderOptions& options, SampleRange samples);

/// When `samples` have been taken, or an error or a time is reached.
SampleSchedule make_schedule(SampleRange samples, const RenderOptions& options);

}  // namespace norrsken
