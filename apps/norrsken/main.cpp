// norrsken: the command line of the renderer.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "commands.h"
#include "console.h"
#include "norrsken/render.h"

namespace norrsken::cli {
namespace {

std::string version_text() { return fmt::format("norrsken {} ({})", NORRSKEN_VERSION, fmt::join(usable_isas(), ", ")); }

Program program() {
  return {.name = "norrsken",
          .summary = "Norrsken, a Monte Carlo ray tracer for the CPU",
          .footer =
              "Examples:\n"
              "  norrsken render hexagon_room -Dshadow_rays=1 --spp 64 --exposure 1.5 -o room.png\n"
              "  norrsken render hexagon_room -Dlight=point -Dshadow_rays=1 -o room.exr -o room.png\n"
              "  norrsken figures -o figures --quick\n\n"
              "'norrsken COMMAND --help' or 'norrsken help COMMAND' tells the options of a command.\n"
              "Exit status: 0 done, 64 wrong command line, 65 wrong scene, 66 missing input, 70 internal fault,\n"
              "73 cannot create output, 74 write error, 77 interrupted (render saves what there is).",
          .version = version_text,
          .commands = {render_command(), merge_command(), info_command(), scenes_command(), convert_command(),
                       compare_command(), bench_command(), figures_command()}};
}

ExitStatus run(const std::vector<std::string>& words) {
  const Program norrsken = program();
  if (words.empty()) {
    print_note(help_text(norrsken));
    return ExitStatus::usage;
  }
  const Request request = parse_command_line(norrsken, words);
  if (!request.complaint.empty()) {
    print_error(request.complaint);
    print_note(fmt::format("see 'norrsken{} --help'", request.chosen.empty() ? "" : " " + request.chosen));
    return ExitStatus::usage;
  }
  ExitStatus status = ExitStatus::done;
  if (request.command == nullptr)
    print_line(request.answer);
  else
    status = request.command->run();
  finish_stdout();
  return status;
}

}  // namespace
}  // namespace norrsken::cli

int main(int argc, char** argv) {
  using namespace norrsken::cli;
  prepare_standard_files();
  leave_time_to_save();
  ExitStatus status = ExitStatus::internal;
  try {
    status = run({argv + 1, argv + std::max(argc, 1)});
  } catch (const Failure& failure) {
    const bool is_error = failure.status() != ExitStatus::interrupted;
    if (*failure.what() != '\0') is_error ? print_error(failure.what()) : print_note(failure.what());
    status = failure.status();
  } catch (const std::bad_alloc&) {
    print_error("out of memory");
  } catch (const std::exception& error) {
    print_error(fmt::format("internal fault: {}", error.what()));
  }
  return static_cast<int>(status);
}
