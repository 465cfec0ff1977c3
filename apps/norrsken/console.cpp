#include "console.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace norrsken::cli {
namespace {

constexpr std::string_view kRed = "\x1b[1;31m", kYellow = "\x1b[1;33m", kPlain = "\x1b[0m";

void write_stderr(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void write_line(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fputc('\n', stdout);
}

/// JSON escapes the control characters of ASCII; DEL and U+0080 to U+009F are ones, too, and may as well be escaped.
std::string with_escaped_controls(const std::string& json) {
  std::string escaped;
  escaped.reserve(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto byte = static_cast<unsigned char>(json[i]);
    const auto next = i + 1 < json.size() ? static_cast<unsigned char>(json[i + 1]) : 0u;
    const bool is_c1 = byte == 0xc2 && next >= 0x80 && next < 0xa0;
    if (byte == 0x7f || is_c1) {
      escaped += fmt::format("\\u{:04x}", is_c1 ? next : byte);
      i += is_c1 ? 1 : 0;
    } else {
      escaped += json[i];
    }
  }
  return escaped;
}

/// `text` with the first `word` coloured, if stderr shows colour.
std::string emphasize(std::string text, std::string_view word, std::string_view color) {
  const auto at = text.find(word);
  if (at == std::string::npos || !stderr_has_color()) return text;
  text.insert(at + word.size(), kPlain);
  return text.insert(at, color);
}

}  // namespace

void leave_time_to_save() {
  rlimit limit{};
  if (getrlimit(RLIMIT_CPU, &limit) != 0 || limit.rlim_max == RLIM_INFINITY || limit.rlim_cur < limit.rlim_max) return;
  const rlim_t margin = std::clamp<rlim_t>(limit.rlim_max / 20, 2, 30);
  if (limit.rlim_max <= margin) return;
  limit.rlim_cur = limit.rlim_max - margin;
  setrlimit(RLIMIT_CPU, &limit);
}

void prepare_standard_files() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // The lowest free number is taken, hence the order.
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(file, F_GETFD) == -1) static_cast<void>(open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY));
}

bool stderr_is_terminal() {
  static const bool is_terminal = [] {
    const char* term = std::getenv("TERM");
    return isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
  }();
  return is_terminal;
}

int stderr_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

bool stderr_has_color() {
  const char* no_color = std::getenv("NO_COLOR");
  return stderr_is_terminal() && (no_color == nullptr || *no_color == '\0');
}

void print_error(std::string_view message) {
  write_stderr(emphasize(fmt::format("norrsken: error: {}\n", safe_to_print(message)), "error:", kRed));
}

void print_warning(std::string_view message) {
  write_stderr(emphasize(fmt::format("norrsken: warning: {}\n", safe_to_print(message)), "warning:", kYellow));
}

void print_note(std::string_view message) { write_stderr(safe_to_print(message) + '\n'); }

void print_diagnostics(const Diagnostics& diagnostics, bool with_warnings) {
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    const bool is_error = diagnostic.severity == Diagnostic::Severity::error;
    if (!is_error && !with_warnings) continue;
    std::string text = to_text(diagnostic);
    // A complaint about the command line or a default stands in no file: say who speaks.
    if (diagnostic.location.file.empty()) text.insert(0, "norrsken: ");
    const std::string word = std::string(name_of(diagnostic.severity)) + ':';
    write_stderr(emphasize(text + '\n', word, is_error ? kRed : kYellow));
  }
}

void print_line(std::string_view text) { write_line(safe_to_print(text)); }

void print_json(const Json& object) {
  write_line(with_escaped_controls(object.text()));
  std::fflush(stdout);
}

void finish_stdout() {
  const bool flushed = std::fflush(stdout) == 0;
  if (!flushed || std::ferror(stdout) != 0) throw Failure(ExitStatus::io_error, "cannot write to the standard output");
}

}  // namespace norrsken::cli
