#include "tests/end_to_end/rendering.h"
#include "tests/told.h"

#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace norrsken::end_to_end {

namespace {

[[noreturn]] void fail(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.all()) text += to_text(diagnostic) + '\n';
  throw std::runtime_error(text);
}

}  // namespace

Scene load(const std::string& path_or_name, const LoadOptions& options, Warnings warnings) {
  Diagnostics diagnostics;
  auto scene = told(Scene::load(path_or_name, options), diagnostics);
  if (!scene || (warnings == Warnings::unexpected && !diagnostics.all().empty())) fail(diagnostics);
  return *scene;
}

Scene load_test_scene(const std::string& file, const SceneParameters& parameters) {
  return load_test_scene_with(file, {.parameters = parameters});
}

Scene load_test_scene_with(const std::string& file, const LoadOptions& options) {
  return load(NORRSKEN_TEST_SCENES "/" + file, options);
}

std::string test_isa() {
  const char* isa = std::getenv("NORRSKEN_TEST_ISA");
  return isa != nullptr ? isa : "auto";
}

Image render_image(const Scene& scene, RenderOptions options, bool layers) {
  if (options.isa == "auto") options.isa = test_isa();
  Diagnostics diagnostics;
  const auto render = told(Render::create(scene, options), diagnostics);
  if (!render) fail(diagnostics);
  const RenderStatistics statistics = render->run();
  if (statistics.dropped_samples > 0) throw std::runtime_error("samples were dropped");
  if (options.isa != "auto" && statistics.isa != options.isa) throw std::runtime_error("rendered by " + statistics.isa);
  if (options.accelerator != "auto" && statistics.accelerator != options.accelerator) {
    throw std::runtime_error("rendered with " + statistics.accelerator);
  }
  return render->image(layers);
}

bool identical(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.channels.size() != b.channels.size()) return false;
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    const Channel &x = a.channels[c], &y = b.channels[c];
    if (x.name != y.name || x.values.size() != y.values.size()) return false;
    if (std::memcmp(x.values.data(), y.values.data(), x.values.size() * sizeof(float)) != 0) return false;
  }
  return true;
}

statistics::Picture picture_of(const Image& image) {
  statistics::Picture picture(image.width, image.height);
  const Channel* const channels[] = {image.find("R"), image.find("G"), image.find("B")};
  for (std::size_t c = 0; c < 3; ++c) {
    if (!channels[c] || channels[c]->values.size() != picture.pixels.size()) {
      throw std::runtime_error("the image lacks R, G or B, or they are not of its size");
    }
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      picture.pixels[i][c] = static_cast<double>(channels[c]->values[i]);
    }
  }
  return picture;
}

statistics::RegionMeans render_replicates(const Scene& scene, RenderOptions options, int seeds,
                                          std::vector<statistics::Region> regions, std::uint64_t first_seed) {
  statistics::RegionMeans means(std::move(regions));
  for (int i = 0; i < seeds; ++i) {
    options.seed = first_seed + static_cast<std::uint64_t>(i);
    means.add(picture_of(render_image(scene, options)));
  }
  return means;
}

}  // namespace norrsken::end_to_end
