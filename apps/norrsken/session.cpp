#include "session.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "console.h"

namespace norrsken::cli {
namespace {

bool is_builtin(const std::string& name) {
  const auto scenes = builtin_scenes();
  return std::any_of(scenes.begin(), scenes.end(), [&](const BuiltinScene& scene) {
    return name == scene.name || name == "builtin:" + scene.name + ".xml";
  });
}

bool any_error_names_a_file(const Diagnostics& diagnostics) {
  const auto& all = diagnostics.all();
  return std::any_of(all.begin(), all.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Diagnostic::Severity::error && !diagnostic.location.file.empty();
  });
}

}  // namespace

ExitStatus failed_scene_status(const std::string& scene, const Diagnostics& diagnostics) {
  if (!is_builtin(scene) && unreadable_input_status(scene) == ExitStatus::no_input) return ExitStatus::no_input;
  return any_error_names_a_file(diagnostics) ? ExitStatus::data_error : ExitStatus::usage;
}

ExitStatus unreadable_input_status(const std::string& path) {
  struct stat status {};
  const bool readable = stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && access(path.c_str(), R_OK) == 0;
  return readable ? ExitStatus::data_error : ExitStatus::no_input;
}

Scene load_scene(const std::string& name, const LoadOptions& options, bool with_warnings, ExitStatus so_far) {
  Result<Scene> scene = Scene::load(name, options);
  print_diagnostics(scene.diagnostics(), with_warnings);
  if (so_far != ExitStatus::done) throw Failure(so_far, "");
  if (!scene) throw Failure(failed_scene_status(name, scene.diagnostics()), "");
  return *std::move(scene);
}

std::unique_ptr<Render> create_render(const Scene& scene, const RenderOptions& options, bool with_warnings) {
  Result<std::unique_ptr<Render>> render = Render::create(scene, options);
  print_diagnostics(render.diagnostics(), with_warnings);
  if (render) return *std::move(render);
  // Another process may have taken the checkpoint while the scene was loaded.
  if (!options.checkpoint.empty() && !check_checkpoint_writable(options.checkpoint))
    throw Failure(ExitStatus::cannot_create, "");
  throw Failure(any_error_names_a_file(render.diagnostics()) ? ExitStatus::data_error : ExitStatus::usage, "");
}

ExitStatus check_outputs(const std::vector<std::string>& images, const std::string& checkpoint) {
  ExitStatus result = ExitStatus::done;
  const auto complain = [&](const IoStatus& status, ExitStatus meaning) {
    if (status) return;
    print_error(status.error);
    if (result == ExitStatus::done || meaning == ExitStatus::usage) result = meaning;
  };
  for (const std::string& path : images) {
    complain(check_writable(path), check_image_name(path) ? ExitStatus::cannot_create : ExitStatus::usage);
  }
  if (!checkpoint.empty()) complain(check_checkpoint_writable(checkpoint), ExitStatus::cannot_create);
  return result;
}

ExitStatus check_image_sizes(const std::vector<std::string>& images, int width, int height) {
  ExitStatus result = ExitStatus::done;
  for (const std::string& path : images) {
    const IoStatus status = check_image_size(path, width, height);
    if (status) continue;
    print_error(status.error);
    result = ExitStatus::cannot_create;
  }
  return result;
}

void write_image_or_fail(const std::string& path, const Image& image, const ToneMapping& tone) {
  const IoStatus status = write_image(path, image, tone);
  if (!status) throw Failure(ExitStatus::io_error, status.error);
}

}  // namespace norrsken::cli
