// norrsken scenes: what is built in.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "console.h"

namespace norrsken::cli {
namespace {

ExitStatus list_scenes(bool json) {
  const auto scenes = builtin_scenes();
  std::size_t width = 0;
  for (const BuiltinScene& scene : scenes) width = std::max(width, scene.name.size());
  for (const BuiltinScene& scene : scenes) {
    if (json)
      print_json({{"name", scene.name}, {"description", scene.description}});
    else
      print_line(fmt::format("{:<{}}  {}", scene.name, width, scene.description));
  }
  return ExitStatus::done;
}

}  // namespace

void add_scenes_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("scenes", "List the built-in scenes");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "One JSON object a line");
  command->footer("Example:\n  norrsken scenes");
  command->group("Commands");
  command->callback([&action, json] { action = [json] { return list_scenes(*json); }; });
}

}  // namespace norrsken::cli
