// Whole scenes of legal parts, rendered. The bytes choose what is in them (scene_writer.h); NORRSKEN_FUZZ_SHOW=1 prints
// the scene, and what became of it.
#include <algorithm>
#include <cmath>

#include "fuzz/memory_file.h"
#include "fuzz/scene_writer.h"
#include "norrsken/render.h"
#include "norrsken/scene.h"

namespace {

using namespace norrsken;

constexpr const char* kObj =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    "f 1/1/1 2/2/1 3/3/1 4/4/1\nf 1/1 2/2 5/3\nf 2 3 5\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float r\n"
    "property float g\nproperty float b\nproperty float weight\nelement face 2\n"
    "property list uchar int vertex_indices\nproperty float r\nproperty float g\nproperty float b\nend_header\n"
    "0 0 0 1 0 0 1\n1 0 0 0 1 0 .5\n0 1 0 0 0 1 0\n0 0 1 1 1 1 .1\n3 0 1 2 1 0 0\n3 0 1 3 0 1 0\n";
constexpr const char* kCurves = "-1 0 0 .2\n0 1 0 .1\n1 0 .5 .1\n2 1 0 0\n\n0 0 1 .1\n0 0 1 .1\n0 1 1 .3\n0 2 1 .1\n";

const fuzz::SceneFiles& scene_files() {
  static const fuzz::MemoryFile obj(kObj), ply(kPly), curves(kCurves);
  static const std::string assets = NORRSKEN_FUZZ_ASSETS;
  static const fuzz::SceneFiles files{obj.path(),           ply.path(),    assets + "/gear.serialized",
                                      assets + "/cell.vol", curves.path(), assets + "/relief.png",
                                      assets + "/sky.exr"};
  return files;
}

const char* const kAccelerators[] = {"auto", "embree", "auto", "planes", "moller_trumbore", "auto"};

void check_image(const Image& image, const RenderStatistics& statistics) {
  for (const Channel& channel : image.channels) {
    if (channel.name.size() != 1) continue;  // layers may say that nothing is known, or nothing is there
    fuzz::require(std::ranges::all_of(channel.values, [](float v) { return std::isfinite(v); }), "pixels are finite");
  }
  fuzz::require(statistics.has_image && !statistics.cancelled, "a rendering comes to its end");
  fuzz::require(statistics.dropped_samples <= statistics.samples || !statistics.samples_of_pixels,
                "no more samples are dropped than there are");
  fuzz::require((statistics.dropped_samples > 0) != statistics.dropped.empty() || !statistics.samples_of_pixels,
                "dropped samples are named");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool show = std::getenv("NORRSKEN_FUZZ_SHOW") != nullptr;
  fuzz::ByteSource choices(data, size);
  RenderOptions options;
  options.threads = 1;
  options.isa = "scalar";
  options.accelerator = kAccelerators[choices.below(6)];
  options.features = choices.flag();
  options.seed = choices.byte();
  const std::string xml = fuzz::write_scene(choices, scene_files());
  if (show) std::fputs(xml.c_str(), stderr);
  const fuzz::MemoryFile file(xml);

  const auto scene = Scene::load(file.path());
  fuzz::check_complaints(scene.has_value(), scene.diagnostics());
  Diagnostics diagnostics = scene.diagnostics();
  std::unique_ptr<Render> render;
  if (scene) {
    auto created = Render::create(*scene, options);
    diagnostics = created.diagnostics();
    if (created) render = *std::move(created);
  }
  if (show) {
    for (const Diagnostic& d : diagnostics.all()) std::fprintf(stderr, "%s\n", to_text(d).c_str());
  }
  if (!render) {
    fuzz::require(diagnostics.has_errors(), "what is not rendered is complained about");
    return 0;
  }
  const RenderStatistics statistics = render->run();
  if (show) std::fprintf(stderr, "%llu samples dropped\n", static_cast<unsigned long long>(statistics.dropped_samples));
  check_image(render->image(true), statistics);
  return 0;
}
