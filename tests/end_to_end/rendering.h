// Rendering through the public interface, as the end-to-end tests need it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "norrsken/render.h"
#include "norrsken/scene.h"
#include "tests/statistics/estimate.h"

namespace norrsken::end_to_end {

using SceneParameters = std::vector<std::pair<std::string, std::string>>;

/// Threads of every rendering that is not about threads.
inline constexpr int kThreads = 2;

/// Whether a scene may be one that is warned of.
enum class Warnings { unexpected, expected };

/// Loads a scene by name, or a file of tests/scenes. Throws std::runtime_error with the complaints if there are any.
Scene load(const std::string& path_or_name, const LoadOptions& options = {}, Warnings warnings = Warnings::unexpected);
/// A file of tests/scenes.
Scene load_test_scene(const std::string& file, const SceneParameters& parameters = {});
Scene load_test_scene_with(const std::string& file, const LoadOptions& options);

/// The environment's NORRSKEN_TEST_ISA, or "auto".
std::string test_isa();

/// Renders to the end; an instruction set that is left to choose is `test_isa`. Throws std::runtime_error with the complaints if there are any, if a sample was dropped, or if another
/// instruction set or accelerator was used than was asked for.
Image render_image(const Scene& scene, RenderOptions options, bool layers = false);

/// All channels, bit for bit.
bool identical(const Image& a, const Image& b);

/// R, G, B of an image.
statistics::Picture picture_of(const Image& image);

/// Images of `seeds` different seeds from `first_seed` on, other options as given, averaged over the regions.
statistics::RegionMeans render_replicates(const Scene& scene, RenderOptions options, int seeds,
                                          std::vector<statistics::Region> regions, std::uint64_t first_seed = 1);

}  // namespace norrsken::end_to_end
