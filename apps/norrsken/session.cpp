#include "session.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "console.h"

namespace norrsken::cli {
namespace {

bool is_builtin(const std::string& name) {
  const auto scenes = builtin_scenes();
  return std::any_of(scenes.begin(), scenes.end(), [&](const BuiltinScene& scene) { return scene.name == name; });
}

ExitStatus status_of(const std::string& scene, const Diagnostics& diagnostics) {
  // A folder opens, but cannot be read from.
  std::ifstream file(scene);
  if (!is_builtin(scene) && (!file || file.peek(), file.bad() || !file.is_open())) return ExitStatus::no_input;
  const auto& all = diagnostics.all();
  const bool names_a_file = std::any_of(all.begin(), all.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Diagnostic::Severity::error && !diagnostic.location.file.empty();
  });
  return names_a_file ? ExitStatus::data_error : ExitStatus::usage;
}

}  // namespace

Scene load_scene(const std::string& name, const LoadOptions& options, bool with_warnings) {
  Diagnostics diagnostics;
  auto scene = Scene::load(name, options, diagnostics);
  print_diagnostics(diagnostics, with_warnings);
  if (!scene) throw Failure(status_of(name, diagnostics), "");
  return *scene;
}

std::unique_ptr<Render> create_render(const Scene& scene, const RenderOptions& options) {
  Diagnostics diagnostics;
  auto render = Render::create(scene, options, diagnostics);
  print_diagnostics(diagnostics);
  if (!render) throw Failure(ExitStatus::usage, "");
  return render;
}

void require_writable(const std::string& path) {
  const IoStatus status = check_writable(path);
  if (!status) throw Failure(ExitStatus::cannot_create, status.error);
}

void write_image_or_fail(const std::string& path, const Image& image, const ToneMapping& tone) {
  const IoStatus status = write_image(path, image, tone);
  if (!status) throw Failure(ExitStatus::io_error, status.error);
}

}  // namespace norrsken::cli
