// The one file that sees CLI11, whose headers take longer to compile than all commands together.
#include "command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>
#include <type_traits>
#include <utility>

#include "norrsken/diagnostics.h"

namespace norrsken::cli {
namespace {

/// Names of a command's options as they are typed: "--spp", "-o".
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// Of a mistyped or misplaced option the name as it is declared: "--spp" of "--spp=4", "-D" of "-Dlight=point".
std::string declared_name(const std::string& option) {
  return option.starts_with("--") ? option.substr(0, option.find('=')) : option.substr(0, 2);
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  return names;
}

/// An argument that stands before the command, or where there is no command.
std::string describe_stray_argument(const CLI::App& app, const std::string& argument) {
  if (!argument.starts_with('-')) return fmt::format("unexpected argument '{}'", argument);
  const auto chosen = app.get_subcommands();
  const std::string option = declared_name(argument);
  const auto has_option = [&](const CLI::App* command) {
    const auto names = option_names(*command);
    return std::find(names.begin(), names.end(), option) != names.end();
  };
  const auto candidates =
      chosen.empty() ? commands_of(app) : std::vector<const CLI::App*>(chosen.begin(), chosen.end());
  if (std::any_of(candidates.begin(), candidates.end(), has_option))
    return fmt::format("'{0}' belongs after the command: norrsken {1} {0}", option,
                       chosen.empty() ? "COMMAND" : chosen.front()->get_name());
  const std::string name = argument.substr(0, argument.find('='));
  return fmt::format("unknown option '{}'{}", name, did_you_mean(name, option_names(app)));
}

std::string describe_usage_error(const CLI::App& app, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    const std::string text = error.what();
    return fmt::format("option '{}' needs a value", text.substr(0, text.find(':')));
  }
  const bool is_required = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const bool is_extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const auto stray = app.remaining(false);
  if ((is_required || is_extra) && !stray.empty()) return describe_stray_argument(app, stray.front());
  const auto chosen = app.get_subcommands();
  if (is_required && chosen.empty())
    return fmt::format("a command is required; accepted: {}", fmt::join(command_names(app), ", "));
  if (!is_extra) return error.what();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const auto extras = app.remaining(true);
  if (extras.empty()) return error.what();
  const std::string& extra = extras.front();
  if (!extra.starts_with('-')) return fmt::format("unexpected argument '{}'", extra);
  const std::string name = extra.substr(0, extra.find('='));
  return fmt::format("unknown option '{}'{}", name, did_you_mean(name, option_names(command)));
}

/// Of an option the value's name is told; that it is required or may be repeated is said in words.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() {
    label("Positionals", "Arguments");
    label("SUBCOMMAND", "COMMAND");
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    return option->get_type_size() == 0 || option->get_type_name().empty() ? "" : " " + option->get_type_name();
  }
};

void add_option(const Option& option, CLI::App& command) {
  std::visit(
      [&](auto* target) {
        using Value = std::remove_pointer_t<decltype(target)>;
        CLI::Option* added = nullptr;
        if constexpr (std::is_same_v<Value, bool>) {
          added = command.add_flag(option.names, *target, option.help);
        } else {
          added = command.add_option(option.names, *target, option.help)->type_name(option.value);
          if (option.check) added->check(CLI::Validator(option.check, ""));
        }
        if (std::is_same_v<Value, std::vector<std::string>> && option.names.starts_with('-'))
          added->take_all()->allow_extra_args(false);
        if (option.is_required) added->required();
        if (!option.needs.empty()) added->needs(command.get_option(option.needs));
      },
      option.target);
}

void set_up(CLI::App& app, const Program& program) {
  app.description(program.summary);
  app.name(program.name);
  if (program.version)
    app.set_version_flag("--version", program.version,
                         "Print the version and the instruction sets this processor can run");
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.formatter(std::make_shared<HelpFormatter>());
  app.require_subcommand(1);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.footer(program.footer);
  for (const Command& description : program.commands) {
    CLI::App& command = *app.add_subcommand(description.name, description.summary);
    for (const Option& option : description.options) add_option(option, command);
    command.footer(description.footer);
    command.group("Commands");
  }
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

}  // namespace

Request parse_command_line(const Program& program, std::vector<std::string> words) {
  CLI::App app;
  set_up(app, program);
  Request request;
  words = with_known_words(std::move(words));
  const auto names = command_names(app);
  if (!words.empty() && !words.front().starts_with('-') &&
      std::find(names.begin(), names.end(), words.front()) == names.end()) {
    request.complaint = unknown_word("command", words.front(), names);
    return request;
  }
  try {
    std::ranges::reverse(words);  // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::Success& success) {  // --help and --version
    std::ostringstream answer;
    app.exit(success, answer, answer);
    request.answer = answer.str();
    if (request.answer.ends_with('\n')) request.answer.pop_back();  // the line's end is its printer's
  } catch (const CLI::ParseError& error) {
    request.complaint = describe_usage_error(app, error);
  }
  if (const auto chosen = app.get_subcommands(); !chosen.empty()) request.chosen = chosen.front()->get_name();
  if (!request.answer.empty() || !request.complaint.empty()) return request;
  request.command = &*std::ranges::find(program.commands, request.chosen, &Command::name);
  return request;
}

std::string help_text(const Program& program) {
  CLI::App app;
  set_up(app, program);
  return app.help();
}

std::string unknown_word(std::string_view what, std::string_view word, const std::vector<std::string>& accepted) {
  const std::string hint = did_you_mean(word, accepted);
  return fmt::format("unknown {} '{}'{} accepted: {}", what, word, hint.empty() ? ";" : hint,
                     fmt::join(accepted, ", "));
}

}  // namespace norrsken::cli
