// Checkpoints through the public interface: renderings that are interrupted, prolonged and split end in the same bits,
// and what does not belong together is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "fuzz/sections.h"
#include "norrsken/merge.h"
#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/rendering.h"
#include "tests/temporary_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Errors and warnings as lines, the file's folder left out.
std::vector<std::string> messages(const Diagnostics& diagnostics) {
  std::vector<std::string> lines;
  for (const Diagnostic& d : diagnostics.all()) {
    lines.push_back((d.severity == Diagnostic::Severity::error ? "error: " : "warning: ") +
                    fs::path(d.location.file).filename().string() + ": " + d.message +
                    (d.accepted.empty() ? "" : " [" + d.accepted + "]"));
  }
  return lines;
}

std::vector<std::string> messages_of(const Scene& scene, const RenderOptions& options) {
  Diagnostics diagnostics;
  const auto render = told(Render::create(scene, options), diagnostics);
  EXPECT_EQ(render == nullptr, diagnostics.has_errors());
  return messages(diagnostics);
}

/// Why files cannot be merged; empty if they are, into `merged`.
std::string merge_error(const std::vector<std::string>& files, bool layers, MergedRender& merged) {
  Result<MergedRender> result = merge_renders(files, layers);
  if (result) merged = *std::move(result);
  return result.error();
}

struct Outcome {
  RenderStatistics statistics;
  Image image;
};

/// Cancelled after so long.
Outcome run_for(const Scene& scene, const RenderOptions& options, std::chrono::microseconds time) {
  Diagnostics diagnostics;
  const auto render = told(Render::create(scene, options), diagnostics);
  if (!render) throw std::runtime_error(to_text(diagnostics.all().front()));
  std::jthread killer([&](const std::stop_token& stop) {
    const auto end = std::chrono::steady_clock::now() + time;
    while (!stop.stop_requested() && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    render->cancel();
  });
  Outcome run{render->run(), {}};
  killer.request_stop();
  run.image = render->image(true);
  return run;
}

struct Case {
  std::string name, scene, integrator, sampler;
  SceneParameters parameters;
  bool features = false;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class Checkpoints : public testing::TestWithParam<Case> {
 protected:
  Scene scene() const {
    const Case& c = GetParam();
    LoadOptions options{.parameters = c.parameters, .width = 93, .height = 71};
    if (!c.integrator.empty()) options.integrator = c.integrator;
    if (!c.sampler.empty()) options.sampler = c.sampler;
    return load(c.scene, options);
  }
  RenderOptions options(int samples, int threads = kThreads) const {
    return {.samples_per_pixel = samples, .seed = 9, .threads = threads, .features = GetParam().features};
  }
  RenderOptions kept(int samples, int threads = kThreads) const {
    RenderOptions kept = options(samples, threads);
    kept.checkpoint = folder_.file("room.ckpt");
    kept.checkpoint_seconds = 0.001;
    return kept;
  }
  /// Saves samples first to end - 1 and returns the file's name.
  std::string part(const Scene& of_scene, std::uint32_t first, std::uint32_t end) const {
    RenderOptions part = options(1);
    part.samples = SampleRange{first, end};
    part.checkpoint = folder_.file(std::to_string(first) + "_" + std::to_string(end));
    render_image(of_scene, part);
    return part.checkpoint;
  }

  TemporaryFolder folder_;
};

TEST_P(Checkpoints, InterruptionsChangeNoBit) {
  const Scene room = scene();
  const Image whole = render_image(room, options(70), true);
  std::mt19937 random(1);
  int interruptions = 0;
  for (;; ++interruptions) {
    ASSERT_LT(interruptions, 5000) << "it does not come to an end";
    const int threads[] = {1, 2, 7};
    // Longer and longer: the slowest of machines and sanitizers comes to an end.
    const std::chrono::microseconds time(random() % 20000 + 200 * static_cast<unsigned>(interruptions));
    const Outcome run = run_for(room, kept(70, threads[interruptions % 3]), time);
    EXPECT_THAT(run.statistics.checkpoint_error, IsEmpty());
    if (run.statistics.cancelled) continue;
    EXPECT_TRUE(identical(run.image, whole));
    EXPECT_EQ(run.statistics.samples, 70u * 93 * 71);
    break;
  }
  EXPECT_GT(interruptions, 2);
}

TEST_P(Checkpoints, MoreSamplesLaterAreAsIfAskedForAtFirst) {
  const Scene room = scene();
  for (const int samples : {1, 3, 16, 21, 64, 70}) {
    const Image resumed = render_image(room, kept(samples), true);
    EXPECT_TRUE(identical(resumed, render_image(room, options(samples), true))) << samples;
  }
  const Outcome again = run_for(room, kept(70), std::chrono::hours(1));
  EXPECT_EQ(again.statistics.samples_resumed, again.statistics.samples);
  EXPECT_EQ(again.statistics.closest_rays, 0u) << "there was nothing to do";
  EXPECT_THAT(
      messages_of(room, kept(69)),
      ElementsAre("error: room.ckpt: the checkpoint holds 70 samples per pixel, more than the 69 asked for [70 or "
                  "more]"));
}

TEST_P(Checkpoints, RangesJoinToTheSameBitsInAnyOrder) {
  const Scene room = scene();
  const Image whole = render_image(room, options(40), true);
  std::vector<std::string> parts = {part(room, 0, 3), part(room, 3, 10), part(room, 10, 31), part(room, 31, 40)};
  std::mt19937 random(5);
  for (int order = 0; order < 6; ++order) {
    MergedRender merged;
    EXPECT_EQ(merge_error(parts, true, merged), "");
    EXPECT_TRUE(identical(merged.image, whole)) << "order " << order;
    EXPECT_THAT(merged.samples, ElementsAre(SampleRange{0, 40}));
    EXPECT_THAT(merged.gaps, IsEmpty());
    std::ranges::shuffle(parts, random);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Checkpoints,
    testing::Values(Case{"sobol", "hexagon_room", "", "sobol", {{"shadow_rays", "1"}}},
                    Case{"independent", "hexagon_room", "", "independent", {{"shadow_rays", "1"}}},
                    Case{"features", "hexagon_room", "", "sobol", {{"shadow_rays", "2"}}, true},
                    Case{"from_lights", "hexagon_room", "ptracer", "sobol", {{"shadow_rays", "1"}}}),
    kParamName);

/// One finished checkpoint of the room, and what asks for it again.
class Refusals : public testing::Test {
 protected:
  static Scene room(const LoadOptions& changes = {}) {
    LoadOptions options = changes;
    options.parameters.insert(options.parameters.begin(), {"shadow_rays", "1"});
    if (!options.width) options.width = 40, options.height = 30;
    return load("hexagon_room", options);
  }
  RenderOptions options(int samples = 20) const {
    return {.samples_per_pixel = samples, .threads = 1, .isa = "scalar", .checkpoint = folder_.file("room.ckpt")};
  }
  void SetUp() override { whole_ = render_image(room(), options()); }
  static std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void put(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
  static std::string refusal(const std::string& reason) {
    return "error: room.ckpt: the checkpoint is of another rendering: " + reason +
           " [the settings and files that it was made with, or another checkpoint]";
  }

  TemporaryFolder folder_;
  Image whole_;
};

TEST_F(Refusals, NameWhatDiffers) {
  const auto of = [&](const LoadOptions& changes) { return messages_of(room(changes), options()); };
  EXPECT_THAT(of({}), IsEmpty());
  EXPECT_THAT(of({.parameters = {}, .sampler = "independent"}),
              ElementsAre(refusal("sampler is sobol, not independent")));
  EXPECT_THAT(of({.parameters = {}, .width = 41, .height = 30}),
              ElementsAre(HasSubstr("size is 40x30 at (0, 0) of 40x30, not 41x30")));
  EXPECT_THAT(of({.parameters = {{"bounces", "7"}}}), ElementsAre(HasSubstr("rendering: integrator is ")));
  EXPECT_THAT(of({.parameters = {{"light", "point"}}}), ElementsAre(HasSubstr("other lights")));
  const auto with = [&](auto change) {
    RenderOptions changed = options();
    change(changed);
    return messages_of(room(), changed);
  };
  EXPECT_THAT(with([](RenderOptions& o) { o.seed = 1; }), ElementsAre(refusal("seed is 0, not 1")));
  EXPECT_THAT(with([](RenderOptions& o) { o.accelerator = "embree"; }),
              ElementsAre(refusal("accelerator is planes, not embree")));
  EXPECT_THAT(with([](RenderOptions& o) { o.features = true; }),
              ElementsAre(HasSubstr("layers is none, not depth.Z=0")));
  EXPECT_THAT(
      with([](RenderOptions& o) {
        o.samples = SampleRange{4, 20};
      }),
      ElementsAre("error: room.ckpt: the checkpoint begins with sample 0, not 4 [the settings and files that it "
                  "was made with, or another checkpoint]"));
  EXPECT_THAT(with([](RenderOptions& o) { o.threads = 7; }), IsEmpty());
  EXPECT_THAT(with([](RenderOptions& o) { o.samples_per_pixel = 21; }), IsEmpty());
  for (const std::string& isa : usable_isas()) {
    if (isa == "scalar") continue;
    EXPECT_THAT(with([&](RenderOptions& o) { o.isa = isa; }),
                ElementsAre(HasSubstr("instruction set is scalar, not " + isa)));
  }
}

/// A mesh or a texture that was edited, though nothing in the scene file was.
TEST_F(Refusals, NoticeAChangedMeshAndAChangedTexture) {
  const auto write_files = [&](float height, float red) {
    folder_.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 " + std::to_string(height) + "\nf 1 2 3\n");
    Image image;
    image.width = image.height = 2;
    for (const char* name : {"R", "G", "B"}) image.channel(name).values.assign(4, *name == 'R' ? red : 0.5f);
    ASSERT_TRUE(write_image(folder_.file("texture.exr"), image));
  };
  folder_.write("scene.xml", R"(<scene version="3.0.0"><sensor type="perspective">
    <film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/></film></sensor>
    <emitter type="constant"/>
    <shape type="obj"><string name="filename" value="mesh.obj"/>
      <bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="texture.exr"/>
      </texture></bsdf></shape></scene>)");
  RenderOptions kept = options(4);
  kept.checkpoint = folder_.file("mesh.ckpt");
  const auto complaints = [&] {
    return messages_of(
        *[&] {
          Diagnostics diagnostics;
          auto scene = told(Scene::load(folder_.file("scene.xml"), {}), diagnostics);
          if (!scene) throw std::runtime_error(to_text(diagnostics.all().front()));
          return scene;
        }(),
        kept);
  };
  write_files(0, 0.25f);
  {
    Diagnostics diagnostics;
    const auto scene = told(Scene::load(folder_.file("scene.xml"), {}), diagnostics);
    ASSERT_TRUE(scene);
    render_image(*scene, kept);
  }
  EXPECT_THAT(complaints(), IsEmpty());
  write_files(0, 0.26f);
  EXPECT_THAT(complaints(), ElementsAre(HasSubstr("other textures")));
  write_files(0.5f, 0.25f);
  EXPECT_THAT(complaints(), ElementsAre(testing::AllOf(HasSubstr("other shapes"), testing::Not(HasSubstr("texture")))));
}

/// Wherever a checkpoint is damaged, the older one is taken or the rendering refused: its sums are never believed.
TEST_F(Refusals, NoDamagedCheckpointIsBelieved) {
  const Scene scene = room();
  const std::string newest = options().checkpoint, older = newest + ".1";
  const std::string older_bytes = contents(newest);
  render_image(scene, options(24));
  const std::string bytes = contents(newest);
  const Image whole = render_image(scene, {.samples_per_pixel = 24, .threads = 1, .isa = "scalar"}, true);

  std::mt19937_64 random(8);
  for (int i = 0; i < 300; ++i) {
    std::string damaged = bytes;
    // The heads and the small sections at the beginning as often as the sums.
    const std::size_t at = random() % (i % 2 == 0 ? bytes.size() : 2000);
    if (i % 3 == 0)
      damaged.resize(at);
    else
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
    put(newest, damaged);
    fs::remove(older);
    const std::vector<std::string> alone = messages_of(scene, options(24));
    ASSERT_EQ(alone.size(), 1u) << "byte " << at;
    EXPECT_THAT(alone[0], testing::AllOf(testing::StartsWith("error: room.ckpt: the checkpoint "),
                                         HasSubstr(", and there is no older one")));
    EXPECT_EQ(contents(newest), damaged) << "it is left for whoever can repair it";
    put(older, older_bytes);
    EXPECT_THAT(messages_of(scene, options(24)),
                ElementsAre(testing::AllOf(testing::StartsWith("warning: room.ckpt: the checkpoint "),
                                           HasSubstr("; going on with the older"))));
    if (i % 30 != 0) continue;
    const Outcome run = run_for(scene, options(24), std::chrono::hours(1));
    EXPECT_TRUE(identical(run.image, whole));
    EXPECT_EQ(contents(older), older_bytes) << "what is damaged does not take the place of what is not";
    EXPECT_THAT(messages_of(scene, options(24)), IsEmpty());
  }
}

TEST_F(Refusals, BothDamaged) {
  put(options().checkpoint, "not a checkpoint");
  put(options().checkpoint + ".1", contents(options().checkpoint));
  const std::vector<std::string> complaints = messages_of(room(), options());
  ASSERT_EQ(complaints.size(), 1u);
  EXPECT_THAT(complaints[0], testing::AllOf(HasSubstr("does not begin as checkpoints do; the older"),
                                            HasSubstr("[an intact checkpoint, or none: remove both to begin anew]")));
}

class Merging : public Refusals {
 protected:
  std::string part(std::uint32_t first, std::uint32_t end, std::uint64_t seed = 0) const {
    RenderOptions part = options();
    part.seed = seed;
    part.samples = SampleRange{first, end};
    part.checkpoint = folder_.file(std::to_string(first) + "_" + std::to_string(end) + "_" + std::to_string(seed));
    render_image(room(), part);
    return part.checkpoint;
  }
  std::string complaint(const std::vector<std::string>& files) const {
    MergedRender merged;
    std::string error = merge_error(files, false, merged);
    // Without the folder.
    for (std::size_t at; (at = error.find(folder_.file(""))) != std::string::npos;) {
      error.erase(at, folder_.file("").size());
    }
    return error;
  }
};

TEST_F(Merging, TellsGaps) {
  MergedRender merged;
  ASSERT_EQ(merge_error({part(16, 20), part(4, 8), part(8, 10)}, true, merged), "");
  EXPECT_THAT(merged.gaps, ElementsAre(SampleRange{0, 4}, SampleRange{10, 16}));
  EXPECT_THAT(merged.samples, ElementsAre(SampleRange{4, 10}, SampleRange{16, 20}));
  EXPECT_EQ(merged.image.find("samples")->values[7], 10.0f);
  EXPECT_FALSE(std::isnan(merged.image.find("variance.R")->values[7]));
}

TEST_F(Merging, RefusesOverlapsAndStrangers) {
  const std::string a = part(0, 8), b = part(7, 12), c = part(8, 12, 3), d = part(4, 20);
  EXPECT_EQ(complaint({a, b}), "'0_8_0' and '7_12_0' both hold sample 7");
  EXPECT_EQ(complaint({d, a}), "'0_8_0' and '4_20_0' both hold samples 4 to 7");
  EXPECT_EQ(complaint({a, a}), "'0_8_0' and '0_8_0' both hold samples 0 to 7");
  EXPECT_EQ(complaint({c, a}), "'8_12_3' is not of the rendering of '0_8_0': seed is 3, not 0");
  EXPECT_EQ(complaint({a, folder_.file("none")}), "there is no file 'none'");
  folder_.write("text", "a text");
  EXPECT_EQ(complaint({folder_.file("text")}), "'text' does not begin as checkpoints do");
  EXPECT_EQ(complaint({}), "there is nothing to merge");
  std::string damaged = contents(a);
  damaged.back() = static_cast<char>(damaged.back() ^ 1);
  put(a, damaged);
  EXPECT_THAT(complaint({a}), testing::StartsWith("'0_8_0' is damaged in section 'sums'"));
}

/// Two parts, each stopped anywhere, and finished later: the same bits as what was rendered, and then as the whole.
TEST_F(Merging, TakesWhatIsNotFinished) {
  const Scene large = room({.parameters = {}, .width = 160, .height = 120});
  const auto kept = [&](const std::string& name, SampleRange samples) {
    RenderOptions part = options();
    part.samples = samples;
    part.checkpoint = folder_.file(name);
    return part;
  };
  const RenderOptions a = kept("a", {0, 120}), b = kept("b", {120, 160});
  Outcome stopped;
  {
    Diagnostics diagnostics;
    const auto render = told(Render::create(large, a), diagnostics);
    ASSERT_NE(render, nullptr);
    stopped.statistics = render->run([&](const RenderProgress& progress) {
      if (progress.samples_done > 0) render->cancel();
    });
    stopped.image = render->image(true);
  }
  ASSERT_TRUE(stopped.statistics.cancelled) << "it is over too soon";
  MergedRender merged;
  ASSERT_EQ(merge_error({a.checkpoint}, true, merged), "");
  EXPECT_TRUE(identical(merged.image, stopped.image));
  EXPECT_EQ(merged.error.value, stopped.statistics.error.value);
  ASSERT_EQ(merged.unfinished.size(), 1u);
  EXPECT_EQ(merged.unfinished[0].goal, 120u);
  EXPECT_EQ(merged.unfinished[0].samples_per_pixel, static_cast<double>(stopped.statistics.samples) / (160 * 120));
  std::uint64_t empty = 0;
  for (const float n : stopped.image.find("samples")->values) empty += n == 0;
  EXPECT_EQ(merged.pixels_without_samples, empty);

  // Behind a part that has gaps, too, it is known which samples the variance is of.
  run_for(large, b, std::chrono::hours(1));
  ASSERT_EQ(merge_error({b.checkpoint, a.checkpoint}, true, merged), "");
  EXPECT_EQ(merged.unfinished.size(), 1u);
  EXPECT_EQ(merged.pixels_without_samples, 0u);
  RenderOptions rest = options();
  rest.checkpoint.clear();
  rest.samples = SampleRange{120, 160};
  const Image later = render_image(large, rest, true);
  bool any_unsampled = false;
  for (std::size_t i = 0; i < later.find("samples")->values.size(); ++i) {
    if (stopped.image.find("samples")->values[i] > 0) continue;
    any_unsampled = true;
    ASSERT_EQ(merged.image.find("variance.G")->values[i], later.find("variance.G")->values[i]);
  }
  EXPECT_EQ(any_unsampled, empty > 0);
  run_for(large, a, std::chrono::hours(1));
  ASSERT_EQ(merge_error({b.checkpoint, a.checkpoint}, true, merged), "");
  EXPECT_TRUE(merged.unfinished.empty());
  RenderOptions all = options(160);
  all.checkpoint.clear();
  EXPECT_TRUE(identical(merged.image, render_image(large, all, true)));
}

TEST_F(Merging, TakesWhatIsUneven) {
  RenderOptions adaptive = options();
  adaptive.adaptive = true;
  adaptive.samples_per_pixel = 64;
  adaptive.checkpoint = folder_.file("adaptive");
  const Outcome run = run_for(room({.parameters = {}, .width = 160, .height = 120}), adaptive, std::chrono::hours(1));
  MergedRender merged;
  ASSERT_EQ(merge_error({adaptive.checkpoint}, true, merged), "");
  EXPECT_TRUE(identical(merged.image, run.image));
  EXPECT_TRUE(merged.unfinished.empty());
}

/// A checkpoint whose tiles have come nowhere, as the first one of a rendering that has just begun.
TEST_F(Merging, RefusesWhatHoldsNoImageYet) {
  fuzz::SectionFile file = fuzz::take_apart(contents(options().checkpoint));
  std::string& progress = file.sections.at(3).content;
  // Two ranges and a tile's size, a goal and a flag; then lists of goals, which have a length, and of progress.
  constexpr std::size_t kGoals = 29;
  std::uint32_t tiles = 0;
  std::memcpy(&tiles, progress.data() + kGoals, sizeof tiles);
  std::memset(progress.data() + kGoals + (1 + tiles + 1) * sizeof tiles, 0, tiles * sizeof tiles);
  put(folder_.file("early"), fuzz::put_together(file));
  EXPECT_EQ(complaint({folder_.file("early")}), "'early' holds no image yet; run its command again");
}

/// In one process as well.
TEST_F(Refusals, OneRenderingAtATimeHasACheckpoint) {
  Diagnostics diagnostics;
  const Scene scene = room();
  auto first = told(Render::create(scene, options(24)), diagnostics);
  ASSERT_NE(first, nullptr);
  EXPECT_THAT(
      messages_of(scene, options(24)),
      ElementsAre("error: room.ckpt: another process is writing the checkpoint [another file, or this one when it "
                  "has ended]"));
  first.reset();
  EXPECT_THAT(messages_of(scene, options(24)), IsEmpty());
  folder_.write("room.ckpt.lock", "not made by this program");
  EXPECT_THAT(
      messages_of(scene, options(24)),
      ElementsAre("warning: room.ckpt: the checkpoint cannot be locked: nothing keeps another process from writing "
                  "it"));
}

}  // namespace
}  // namespace norrsken::end_to_end
