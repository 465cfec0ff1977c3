// Everything that include/norrsken offers, as somebody else's program uses it: through the headers and the library alone.
#include <norrsken/compare.h>
#include <norrsken/convert.h>
#include <norrsken/description.h>
#include <norrsken/image.h>
#include <norrsken/merge.h>
#include <norrsken/path_trace.h>
#include <norrsken/plugins.h>
#include <norrsken/render.h>
#include <norrsken/scene.h>
#include <norrsken/version.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <thread>

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
  if (holds) return;
  std::printf("not so: %s\n", what);
  ++failures;
}

/// The value, or an end with all that there is to say.
template <class T>
T value_of(norrsken::Result<T> result) {
  if (result) return *std::move(result);
  for (const auto& diagnostic : result.diagnostics().all()) std::puts(norrsken::to_text(diagnostic).c_str());
  std::exit(1);
}

double mean(const norrsken::Image& image) {
  double sum = 0;
  const norrsken::Channel* red = image.find("R");
  if (red == nullptr || red->values.empty()) return 0;
  for (const float v : red->values) sum += static_cast<double>(v);
  return sum / static_cast<double>(red->values.size());
}

norrsken::Scene room() {
  norrsken::LoadOptions options;
  options.width = options.height = 32;
  options.parameters = {{"spp", "4"}, {"shadow_rays", "1"}};
  options.memory = norrsken::MemoryBudget::of_machine();
  return value_of(norrsken::Scene::load("hexagon_room", options));
}

void loads_and_renders() {
  const auto missing = norrsken::Scene::load("no_such_scene.xml");
  expect(!missing && !missing.error().empty(), "a missing scene is complained about");

  const norrsken::Scene scene = room();
  norrsken::RenderOptions options;
  options.checkpoint = "consumer.part";
  options.samples = norrsken::SampleRange{0, 4};
  const auto render = value_of(norrsken::Render::create(scene, options));
  int passes = 0;
  norrsken::RenderCallbacks callbacks;
  callbacks.on_pass = [&](const norrsken::RenderPass&) { ++passes; };
  std::jthread viewer([&] { expect(render->image(true).width == 32, "an image at any time"); });
  const norrsken::RenderStatistics statistics = render->run(callbacks);
  viewer.join();
  const norrsken::Image image = render->image(true);
  expect(statistics.samples == 32 * 32 * 4, "all samples are taken");
  expect(passes >= 1, "passes are told");
  expect(std::isfinite(mean(image)) && mean(image) > 0, "the room is lit");
  expect(render->image(false, norrsken::ImageRegion{4, 4, 8, 8}).height == 8, "a part of the image");

  const norrsken::MergedRender merged = value_of(norrsken::merge_renders({"consumer.part"}));
  const auto converted = value_of(norrsken::convert_scene(norrsken::SceneSource::file("hexagon_room"), "consumer.xml"));
  expect(converted.back() == "consumer.xml", "a scene is converted");
  expect(norrsken::write_image("consumer.exr", merged.image).error.empty(), "an image is written");
  const norrsken::Image read = value_of(norrsken::read_image("consumer.exr"));
  const norrsken::Comparison comparison = value_of(norrsken::compare(read, merged.image));
  expect(comparison.mse == 0, "what is read is what was written");
  const norrsken::PathTrace path = value_of(norrsken::trace_path(scene, {}, 16, 16, 0));
  expect(!path.vertices.empty(), "a path has vertices");
  for (const std::string& file : norrsken::checkpoint_files("consumer.part")) std::remove(file.c_str());
  std::remove("consumer.exr");
}

void looks_from_elsewhere() {
  const norrsken::Scene scene = room();
  norrsken::ViewOptions view;
  view.camera = {{"fov", 30.0}};
  view.width = view.height = 16;
  view.integrator = "direct";
  const norrsken::Scene closer = value_of(scene.with(view));
  for (const norrsken::Scene& each : {scene, closer}) value_of(norrsken::Render::create(each))->run();
  expect(closer.structures_built() == 1, "one acceleration structure serves both");
  expect(closer.info().width == 16 && scene.info().width == 32, "a view is a scene of its own");
}

void reads_from_memory() {
  const std::string text = R"(<scene version="3.0.0"><sensor type="perspective"><film type="hdrfilm">
    <integer name="width" value="8"/><integer name="height" value="8"/></film></sensor>
    <include filename="sky.xml"/><shape type="sphere"/></scene>)";
  const auto source = norrsken::SceneSource::memory(
      "scene.xml", text, {{"sky.xml", R"(<scene version="3.0.0"><emitter type="constant"/></scene>)"}});
  expect(value_of(norrsken::Scene::load(source)).info().lights == 1, "the include is found in memory");
  expect(!norrsken::scene_formats().empty(), "formats are told");
  bool has_fov = false;
  for (const norrsken::PluginInfo& plugin : norrsken::plugins()) {
    for (const norrsken::PluginParameter& parameter : plugin.parameters)
      has_fov |= plugin.name == "perspective" && parameter.name == "fov" && parameter.unit == "degrees";
  }
  expect(has_fov, "plugins are told with their parameters");
}

void is_put_together() {
  using norrsken::Node;
  norrsken::Mesh triangle;
  triangle.positions = {-9, -9, 3, 9, -9, 3, 0, 9, 3};
  triangle.triangles = {0, 2, 1};
  norrsken::Image sky;
  sky.width = 4, sky.height = 3;
  for (const char* name : {"R", "G", "B"}) sky.channel(name).values.assign(12, 1.0f);
  Node film("film", "hdrfilm"), sensor("sensor", "perspective"), lamp("emitter", "envmap"), shape("shape", "mesh");
  film.set("width", 8).set("height", 8);
  sensor.set("fov", 40.0).add(film);
  lamp.set("image", sky);
  shape.set("mesh", triangle).add(Node("bsdf", "diffuse").set("reflectance", norrsken::Property::Rgb{{0.5, 0.5, 0.5}}));
  auto root = std::make_shared<Node>("scene");
  root->add(sensor).add(lamp).add(shape);
  norrsken::Description description;
  description.scene = root;
  norrsken::LoadOptions options;
  int heard = 0;
  options.log = [&](const norrsken::Diagnostic&) { ++heard; };
  const norrsken::Scene scene = value_of(norrsken::Scene::build(description, options));
  const auto render = value_of(norrsken::Render::create(scene));
  render->run();
  expect(std::abs(mean(render->image()) - 0.5) < 0.05, "half of an even sky is reflected");
  expect(heard == 0, "nothing is wrong with it");
  root->add(Node("shape", "spere"));
  const auto wrong = norrsken::Scene::build(description, options);
  expect(!wrong && heard == 1, "the log hears what is wrong");
}

}  // namespace

int main() {
  std::printf("norrsken %s\n", norrsken::version());
  loads_and_renders();
  looks_from_elsewhere();
  reads_from_memory();
  is_put_together();
  return failures == 0 ? 0 : 1;
}
