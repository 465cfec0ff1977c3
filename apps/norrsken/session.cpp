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
  return std::any_of(scenes.begin(), scenes.end(), [&](const BuiltinScene& scene) { return scene.name == name; });
}

ExitStatus status_of(const std::string& scene, const Diagnostics& diagnostics) {
  if (!is_builtin(scene) && unreadable_input_status(scene) == ExitStatus::no_input) return ExitStatus::no_input;
  const auto& all = diagnostics.all();
  const bool names_a_file = std::any_of(all.begin(), all.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Diagnostic::Severity::error && !diagnostic.location.file.empty();
  });
  return names_a_file ? ExitStatus::data_error : ExitStatus::usage;
}

}  // namespace

ExitStatus unreadable_input_status(const std::string& path) {
  struct stat status {};
  const bool readable = stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && access(path.c_str(), R_OK) == 0;
  return readable ? ExitStatus::data_error : ExitStatus::no_input;
}

Scene load_scene(const std::string& name, const LoadOptions& options, bool with_warnings, ExitStatus so_far) {
  Diagnostics diagnostics;
  auto scene = Scene::load(name, options, diagnostics);
  print_diagnostics(diagnostics, with_warnings);
  if (so_far != ExitStatus::done) throw Failure(so_far, "");
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

ExitStatus check_outputs(const std::vector<std::string>& paths) {
  ExitStatus result = ExitStatus::done;
  for (const std::string& path : paths) {
    const IoStatus status = check_writable(path);
    if (status) continue;
    print_error(status.error);
    if (!check_image_name(path)) result = ExitStatus::usage;
    if (result == ExitStatus::done) result = ExitStatus::cannot_create;
  }
  return result;
}

void write_image_or_fail(const std::string& path, const Image& image, const ToneMapping& tone) {
  const IoStatus status = write_image(path, image, tone);
  if (!status) throw Failure(ExitStatus::io_error, status.error);
}

}  // namespace norrsken::cli
