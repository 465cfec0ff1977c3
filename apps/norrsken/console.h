// What the program says and where: failures, warnings and notes on stderr, results on stdout.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "exit_status.h"
#include "json.h"
#include "norrsken/diagnostics.h"

namespace norrsken::cli {

/// Ends a command: `main` prints the text, unless it is empty, and exits with the status.
class Failure : public std::runtime_error {
 public:
  Failure(ExitStatus status, const std::string& message) : std::runtime_error(message), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// Before anything is opened or printed: a reader that has left and a file that may not grow become errors of writing
/// in place of signals, and what was closed by the caller is opened as something that refuses, so that no image takes
/// the place of the standard output.
void prepare_standard_files();

/// A limit on processor time that kills at once, as shells set it, is preceded by SIGXCPU: by a twentieth of the limit, 2 s
/// at least and 30 s at most.
void leave_time_to_save();

/// Whether stderr is a terminal on which a line can be rewritten (not `TERM=dumb`).
bool stderr_is_terminal();
/// Columns of the terminal behind stderr; 80 if it does not say.
int stderr_columns();
/// Colour on stderr: on a terminal, unless NO_COLOR is set (https://no-color.org).
bool stderr_has_color();

/// "norrsken: error: MESSAGE" on stderr.
void print_error(std::string_view message);
void print_warning(std::string_view message);
/// A plain line on stderr.
void print_note(std::string_view message);
/// Every diagnostic in its readable form on stderr; `with_warnings` false leaves the warnings out.
void print_diagnostics(const Diagnostics& diagnostics, bool with_warnings = true);

/// A line of text on stdout.
void print_line(std::string_view text);
/// One JSON object on one line of stdout, at once.
void print_json(const Json& object);
/// Flushes stdout; a Failure if anything printed there was lost (full disk, closed pipe).
void finish_stdout();

}  // namespace norrsken::cli
