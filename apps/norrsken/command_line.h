// The command line as data: options, commands, and what a line of words asks for.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "exit_status.h"

namespace norrsken::cli {

/// A complaint about the text of a value, which tells what was found and what is accepted; empty: none.
using Check = std::function<std::string(const std::string&)>;

struct Option {
  /// Where its value goes. A bool is set by the option alone; a vector has one value for each time the option is given.
  using Target = std::variant<bool*, int*, float*, std::uint64_t*, std::string*, std::optional<std::string>*,
                              std::vector<std::string>*>;

  std::string names;  ///< "-o,--output"; without a dash it is an argument that is known by its place
  Target target;
  std::string value = {};  ///< what its value is called in the help: "FILE"
  std::string help = {};
  Check check = {};
  bool is_required = false;
  std::string needs = {};  ///< an option without which it means nothing
};

struct Command {
  std::string name, summary = {};
  std::vector<Option> options = {};
  std::string footer = {};               ///< of its help
  std::function<ExitStatus()> run = {};  ///< when the options' targets have their values
};

struct Program {
  std::string name, summary = {}, footer = {};
  std::function<std::string()> version = {};
  std::vector<Command> commands = {};
};

/// What a line of words asks for: one of the three.
struct Request {
  const Command* command = nullptr;
  std::string answer;     ///< the text that --help and --version ask for
  std::string complaint;  ///< what is wrong, as one sentence with a suggestion where there is one

  std::string chosen;  ///< the command that was named, also beside a complaint; empty: none
};

/// Takes the words behind the program's name; sets the targets of the command's options.
Request parse_command_line(const Program& program, std::vector<std::string> words);

/// The whole program's help.
std::string help_text(const Program& program);

/// "unknown WHAT 'WORD', did you mean 'X'? accepted: X, Y".
std::string unknown_word(std::string_view what, std::string_view word, const std::vector<std::string>& accepted);

}  // namespace norrsken::cli
