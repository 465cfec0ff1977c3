// norrsken scenes: what is built in.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands.h"
#include "console.h"
#include "norrsken/scene.h"

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

Command scenes_command() {
  auto json = std::make_shared<bool>(false);
  return {.name = "scenes",
          .summary = "List the built-in scenes",
          .options = {{.names = "--json", .target = json.get(), .help = "One JSON object a line"}},
          .footer = "Example:\n  norrsken scenes",
          .run = [json] { return list_scenes(*json); }};
}

}  // namespace norrsken::cli
