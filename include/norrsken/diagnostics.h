// What is wrong with a scene, a command line or a file, told to the person who made it.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace norrsken {

/// A stretch of text in a file. Lines and columns count from 1, columns in bytes; line 0 means "the file as a
/// whole" and an empty file name means "no file" (the command line, a built-in default).
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
  int length = 1;          ///< bytes to underline, at least 1
  std::string excerpt;     ///< the offending line without its line break, or the part of a long one around the place
  int excerpt_column = 1;  ///< column of the excerpt's first byte
};

struct Diagnostic {
  /// A note is nothing to mend: what was understood otherwise than it is written, or has no effect.
  enum class Severity { error, warning, note };
  Severity severity = Severity::error;
  /// What was found, without a full stop: "unknown bsdf 'difuse'". It quotes the file as it is, control characters
  /// too; `to_text` makes of it what may go to a terminal.
  std::string message;
  std::string
      accepted;  ///< what would have been accepted: "conductor, diffuse, twosided"; may be empty, or have several lines
  SourceLocation location;
};

/// Receives diagnostics one by one as they come: a log.
using DiagnosticSink = std::function<void(const Diagnostic&)>;

/// Collects complaints, so that one run tells as many of them as it can. Never prints. Keeps the first hundred errors
/// and as many warnings and notes and counts the rest: a broken file must not fill the memory with its complaints. What
/// is said again of the same place, and a note that is said again anywhere, is kept and counted once.
class Diagnostics {
 public:
  /// `sink`, if there is one, is called with each diagnostic that is kept, when it is.
  Diagnostics() = default;
  explicit Diagnostics(DiagnosticSink sink) : sink_(std::move(sink)) {}

  void error(SourceLocation location, std::string message, std::string accepted = {});
  void warning(SourceLocation location, std::string message, std::string accepted = {});
  void note(SourceLocation location, std::string message, std::string accepted = {});

  /// From now on, complaints about `file` end with "(named at room.xml:6:36)".
  void named_at(const std::string& file, const SourceLocation& place);
  /// Brings the complaints into the order of lines, file by file as they were first mentioned; those without a file
  /// come last.
  void sort();

  bool has_errors() const { return error_count_ > 0; }
  int error_count() const { return error_count_; }
  /// Its message; empty if there is none.
  std::string first_error() const;
  const std::vector<Diagnostic>& all() const { return all_; }

 private:
  void add(Diagnostic diagnostic, int& count);

  DiagnosticSink sink_;
  std::vector<Diagnostic> all_;
  std::map<std::string, std::string> named_at_;  ///< "room.xml:6:36" by file
  int error_count_ = 0, warning_count_ = 0, note_count_ = 0;
};

/// "error", "warning" or "note".
std::string_view name_of(Diagnostic::Severity severity);

/// "room.xml:6:36", as far as it is known.
std::string place_text(const SourceLocation& location);

/// The form in which a person reads a diagnostic, without a trailing line break:
///
///     room.xml:12:15: error: unknown bsdf 'difuse', did you mean 'diffuse'?
///        12 |   <bsdf type="difuse"/>
///           |               ^~~~~~
///     accepted: conductor, diffuse, twosided
///
/// Tabs become spaces, control characters are made harmless, and of a long line only the part around the place is
/// shown, with "..." for the rest.
std::string to_text(const Diagnostic& diagnostic);

/// `text` with control characters but line breaks, and what is no UTF-8, replaced by U+FFFD: a terminal shows it and does
/// not obey it.
std::string safe_to_print(std::string_view text);

/// The end of a complaint about an unknown word: ", did you mean 'WORD'?" with the nearest of `words`, or nothing if
/// none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& words);

}  // namespace norrsken
