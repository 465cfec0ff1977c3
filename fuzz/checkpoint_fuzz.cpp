// Checkpoints: joined as `norrsken merge` does, and gone on with. Inputs are whole files; to be gone on with, each is
// taken for one of this program's scenes, so that inputs stay of use when scenes' fingerprints or the version change.

#include <cstdlib>
#include <optional>

#include "fuzz/memory_file.h"
#include "fuzz/sections.h"
#include "norrsken/merge.h"
#include "norrsken/render.h"
#include "norrsken/scene.h"
#include "tests/temporary_folder.h"

namespace {

using namespace norrsken;

constexpr const char* kPathScene = R"(<scene version="3.0.0">
  <integrator type="aov"><string name="aovs" value="d:depth"/><integrator type="moment"><integrator type="path"/>
  </integrator></integrator>
  <sensor type="perspective"><sampler type="sobol"/><film type="hdrfilm"><integer name="width" value="5"/>
    <integer name="height" value="3"/><string name="pixel_format" value="rgba"/></film></sensor>
  <shape type="sphere"><point name="center" x="0" y="0" z="4"/></shape><emitter type="constant"/></scene>)";
constexpr const char* kLightScene = R"(<scene version="3.0.0"><integrator type="ptracer"/>
  <sensor type="perspective"><sampler type="independent"/><film type="hdrfilm"><integer name="width" value="5"/>
    <integer name="height" value="3"/></film></sensor>
  <shape type="sphere"><point name="center" x="0" y="0" z="4"/></shape><emitter type="point"/></scene>)";

constexpr SampleRange kSamples{0, 4};

RenderOptions options_for(const std::string& checkpoint) {
  RenderOptions options;
  options.samples = kSamples;
  options.threads = 1;
  options.isa = "scalar";
  options.checkpoint = checkpoint;
  return options;
}

/// A scene, and the traits that its checkpoints begin with.
struct Subject {
  explicit Subject(const char* xml) {
    const fuzz::MemoryFile file(xml);
    Result<Scene> loaded = Scene::load(file.path());
    fuzz::require(loaded.has_value(), "the scene is good");
    scene = *std::move(loaded);
    const TemporaryFolder folder;
    const std::string path = folder.file("checkpoint");
    const auto render = Render::create(*scene, options_for(path));
    fuzz::require(render && (*render)->run().checkpoint_error.empty(), "the scene can be rendered");
    checkpoint = read(path);
    traits = fuzz::take_apart(checkpoint).sections.at(0).content;
  }

  static std::string read(const std::string& path) {
    std::string bytes(1 << 20, '\0');
    std::FILE* file = std::fopen(path.c_str(), "rb");
    fuzz::require(file != nullptr, "a checkpoint was written");
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file));
    std::fclose(file);
    return bytes;
  }

  std::optional<Scene> scene;
  std::string checkpoint, traits;
};

const Subject& subject(bool from_lights) {
  static const Subject along_paths(kPathScene), from_the_lights(kLightScene);
  return from_lights ? from_the_lights : along_paths;
}

void resume(fuzz::SectionFile file, const Subject& subject) {
  if (!file.sections.empty()) file.sections.front().content = subject.traits;
  const fuzz::MemoryFile input(fuzz::put_together(file));
  const auto created = Render::create(*subject.scene, options_for(input.path()));
  fuzz::check_complaints(created.has_value(), created.diagnostics());
  if (!created) return;
  Render* const render = created->get();
  const RenderStatistics statistics = render->run();
  fuzz::require(!statistics.cancelled && statistics.has_image, "a rendering that goes on comes to its end");
  fuzz::require(render->image(true).find("R") != nullptr, "it has an image");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile input(fuzz::text_of(data, size));
  const Result<MergedRender> merged = merge_renders({input.path()}, true);
  fuzz::require(!merged || !merged->samples.empty(), "what was merged has samples");
  const Result<MergedRender> twice = merge_renders({input.path(), input.path()}, true);
  fuzz::require(!twice || !merged || merged->samples.empty(), "samples are not counted twice");

  const fuzz::SectionFile file = fuzz::take_apart(fuzz::text_of(data, size));
  for (const bool from_lights : {false, true}) resume(file, subject(from_lights));
  return 0;
}

/// FOLDER in NORRSKEN_FUZZ_SEEDS: writes the checkpoints of the scenes there, to begin with.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  if (const char* folder = std::getenv("NORRSKEN_FUZZ_SEEDS")) {
    for (const bool from_lights : {false, true}) {
      const std::string path = std::string(folder) + (from_lights ? "/from_lights" : "/paths");
      std::FILE* file = std::fopen(path.c_str(), "wb");
      fuzz::require(file != nullptr, "seeds can be written");
      const std::string& bytes = subject(from_lights).checkpoint;
      std::fwrite(bytes.data(), 1, bytes.size(), file);
      std::fclose(file);
    }
  }
  return 0;
}
