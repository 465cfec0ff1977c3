// norrsken convert: a scene of any format as one of Mitsuba 3.
#include "norrsken/convert.h"

#include <fmt/format.h>

#include "arguments.h"
#include "commands.h"
#include "console.h"
#include "file_use.h"
#include "session.h"

namespace norrsken::cli {
namespace {

struct Arguments {
  std::string scene, output;
  std::vector<std::string> definitions;
  MemoryArguments memory;
};

ExitStatus convert(const Arguments& arguments) {
  const ExitStatus clash = check_written_files({arguments.output}, {{arguments.scene, "the scene that is read"}});
  if (clash != ExitStatus::done) return clash;
  LoadOptions options;
  for (const std::string& text : arguments.definitions) options.parameters.push_back(parse_definition(text));
  options.memory = arguments.memory.budget();
  const Result<std::vector<std::string>> written =
      convert_scene(SceneSource::file(arguments.scene), arguments.output, options);
  print_diagnostics(written.diagnostics(), true);
  if (!written) throw Failure(failed_scene_status(arguments.scene, written.diagnostics()), "");
  print_line(fmt::format("{}{}", arguments.output,
                         written->size() > 1 ? fmt::format(" and {} files beside it", written->size() - 1) : ""));
  return ExitStatus::done;
}

}  // namespace

Command convert_command() {
  auto arguments = std::make_shared<Arguments>();
  Command command = {.name = "convert", .summary = "Write a scene of any format as one of Mitsuba 3"};
  command.options = {
      {.names = "SCENE", .target = &arguments->scene, .help = "scene or mesh, as for render", .is_required = true},
      {.names = "-o,--output",
       .target = &arguments->output,
       .value = "FILE.xml",
       .help = "Where the scene is written; meshes and images go to FILE_files beside it",
       .is_required = true},
      {"-D", &arguments->definitions, "NAME=VALUE", "Set the scene's $NAME; may be repeated", definition()}};
  arguments->memory.add_to(command);
  command.footer = "Examples:\n  norrsken convert room.pbrt -o room.xml\n  norrsken convert truck.glb -o truck.xml";
  command.run = [arguments] { return convert(*arguments); };
  return command;
}

}  // namespace norrsken::cli
