// norrsken: the command line of the renderer.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "console.h"

namespace norrsken::cli {
namespace {

std::string version_text() { return fmt::format("norrsken {} ({})", NORRSKEN_VERSION, fmt::join(usable_isas(), ", ")); }

ExitStatus usage_error(const CLI::App& app, const std::string& message) {
  print_error(message);
  const auto chosen = app.get_subcommands();
  print_note(fmt::format("see 'norrsken{} --help'", chosen.empty() ? "" : " " + chosen.front()->get_name()));
  return ExitStatus::usage;
}

/// Words that other programs have for what are options here.
std::vector<std::string> with_known_words(std::vector<std::string> words) {
  if (words.empty()) return words;
  if (words[0] == "version" || words[0] == "-V") words[0] = "--version";
  if (words[0] != "help") return words;
  words[0] = "--help";
  if (words.size() > 1) std::swap(words[0], words[1]);  // help render: render --help
  return words;
}

ExitStatus run(int argc, char** argv) {
  CLI::App app("Norrsken, a Monte Carlo ray tracer for the CPU", "norrsken");
  app.set_version_flag("--version", version_text, "Print the version and the instruction sets this processor can run");
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.formatter(help_formatter());
  app.require_subcommand(1);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.footer(
      "Examples:\n"
      "  norrsken render hexagon_room -Dshadow_rays=1 --spp 64 --exposure 1.5 -o room.png\n"
      "  norrsken render hexagon_room -Dlight=point -Dshadow_rays=1 -o room.exr -o room.png\n"
      "  norrsken figures -o figures --quick\n\n"
      "'norrsken COMMAND --help' or 'norrsken help COMMAND' tells the options of a command.\n"
      "Exit status: 0 done, 64 wrong command line, 65 wrong scene, 66 missing input, 70 internal fault,\n"
      "73 cannot create output, 74 write error, 77 interrupted (render saves what there is).");
  Action action;
  add_render_command(app, action);
  add_merge_command(app, action);
  add_info_command(app, action);
  add_scenes_command(app, action);
  add_compare_command(app, action);
  add_bench_command(app, action);
  add_figures_command(app, action);

  if (argc < 2) {
    print_note(app.help());
    return ExitStatus::usage;
  }
  std::vector<std::string> words = with_known_words({argv + 1, argv + argc});
  const std::string first = words.front();
  const auto names = command_names(app);
  if (!first.starts_with('-') && std::find(names.begin(), names.end(), first) == names.end())
    return usage_error(app, unknown_word("command", first, names));

  try {
    std::ranges::reverse(words);  // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::Success& success) {  // --help and --version
    app.exit(success);
    finish_stdout();
    return ExitStatus::done;
  } catch (const CLI::ParseError& error) {
    return usage_error(app, describe_usage_error(app, error));
  }
  const ExitStatus status = action();
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
    status = run(argc, argv);
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
