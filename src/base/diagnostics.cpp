#include "norrsken/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/text.h"

namespace norrsken {
namespace {

constexpr int kMaxKept = 100;  // of each severity
constexpr int kTabStop = 4;
constexpr int kMaxWidth = 100;  // columns of an excerpt
constexpr std::string_view kEllipsis = "...";

// One character of the excerpt as it is shown.
struct Cell {
  std::string text;
  int width;
  bool marked;
};

std::vector<Cell> cells_of(const SourceLocation& location) {
  const auto& line = location.excerpt;
  const auto mark = static_cast<std::ptrdiff_t>(location.column) - location.excerpt_column;
  const auto mark_end = mark + std::max(location.length, 1);
  std::vector<Cell> cells;
  int column = 0;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t length = std::max<std::size_t>(utf8_length(line, at), 1);
    Cell cell{printable(std::string_view(line).substr(at, length)), 1, false};
    if (line[at] == '\t') {
      cell.width = kTabStop - column % kTabStop;
      cell.text.assign(static_cast<std::size_t>(cell.width), ' ');
    } else if (length > 1) {
      cell.width = display_width(line, at, length);
    }
    // A mark that begins inside a character marks that character.
    const auto first = static_cast<std::ptrdiff_t>(at), end = static_cast<std::ptrdiff_t>(at + length);
    cell.marked = first < mark_end && end > mark;
    column += cell.width;
    cells.push_back(std::move(cell));
    at += length;
  }
  // A place behind the end of the line.
  if (mark >= static_cast<std::ptrdiff_t>(line.size())) cells.push_back({" ", 1, true});
  return cells;
}

// The excerpt and, below it, the mark.
std::pair<std::string, std::string> excerpt_and_mark(const SourceLocation& location) {
  const std::vector<Cell> cells = cells_of(location);
  const auto is_marked = [](const Cell& cell) { return cell.marked; };
  const auto mark = static_cast<std::size_t>(std::find_if(cells.begin(), cells.end(), is_marked) - cells.begin());

  int total = 0, before_mark = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i < mark) before_mark += cells[i].width;
    total += cells[i].width;
  }
  // The part shown begins so that the mark stands a third of the way in, unless the line's beginning can stay.
  std::size_t first = 0;
  if (total > kMaxWidth && before_mark > kMaxWidth * 2 / 3) {
    int room = kMaxWidth / 3;
    for (first = mark; first > 0 && room >= cells[first - 1].width; --first) room -= cells[first - 1].width;
  }

  std::string text, carets;
  if (first > 0 || location.excerpt_column > 1) {
    text = kEllipsis;
    carets.assign(kEllipsis.size(), ' ');
  }
  int width = 0;
  bool started = false;
  for (std::size_t i = first; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    if (width + cell.width > kMaxWidth) {
      text += kEllipsis;
      break;
    }
    text += cell.text;
    width += cell.width;
    if (!cell.marked) {
      carets.append(static_cast<std::size_t>(cell.width), ' ');
    } else {
      for (int column = 0; column < cell.width; ++column) {
        carets += started ? '~' : '^';
        started = true;
      }
    }
  }
  text.erase(text.find_last_not_of(' ') + 1);
  carets.erase(carets.find_last_not_of(' ') + 1);
  return {text, carets};
}

bool says_the_same(const Diagnostic& a, const Diagnostic& b) {
  const SourceLocation &x = a.location, &y = b.location;
  // A note is about the scene, not about one place of it.
  if (a.severity == Diagnostic::Severity::note && b.severity == a.severity) return a.message == b.message;
  return a.severity == b.severity && x.line == y.line && x.column == y.column && x.file == y.file &&
         a.message == b.message;
}

}  // namespace

void Diagnostics::error(SourceLocation location, std::string message, std::string accepted) {
  add({Diagnostic::Severity::error, std::move(message), std::move(accepted), std::move(location)}, error_count_);
}

void Diagnostics::warning(SourceLocation location, std::string message, std::string accepted) {
  add({Diagnostic::Severity::warning, std::move(message), std::move(accepted), std::move(location)}, warning_count_);
}

void Diagnostics::note(SourceLocation location, std::string message, std::string accepted) {
  add({Diagnostic::Severity::note, std::move(message), std::move(accepted), std::move(location)}, note_count_);
}

void Diagnostics::add(Diagnostic diagnostic, int& count) {
  if (count <= kMaxKept) {
    if (const auto place = named_at_.find(diagnostic.location.file); place != named_at_.end())
      diagnostic.message += fmt::format(" (named at {})", place->second);
    const auto is_same = [&diagnostic](const Diagnostic& known) { return says_the_same(known, diagnostic); };
    if (std::any_of(all_.begin(), all_.end(), is_same)) return;
  }
  if (count < kMaxKept) {
    all_.push_back(std::move(diagnostic));
    if (sink_) sink_(all_.back());
  } else if (count == kMaxKept) {
    all_.push_back({diagnostic.severity,
                    fmt::format("more than {} {}s, the rest are left out", kMaxKept, name_of(diagnostic.severity)),
                    {},
                    {}});
    if (sink_) sink_(all_.back());
  }
  if (count < std::numeric_limits<int>::max()) ++count;
}

std::string Diagnostics::first_error() const {
  const auto error = std::ranges::find(all_, Diagnostic::Severity::error, &Diagnostic::severity);
  return error == all_.end() ? std::string() : error->message;
}

void Diagnostics::named_at(const std::string& file, const SourceLocation& place) {
  if (!place.file.empty() && place.file != file) named_at_[file] = place_text(place);
}

void Diagnostics::sort() {
  std::unordered_map<std::string_view, std::size_t> order;  // of the files
  for (const Diagnostic& diagnostic : all_) {
    if (!diagnostic.location.file.empty()) order.try_emplace(diagnostic.location.file, order.size());
  }
  const auto key = [&order](const Diagnostic& diagnostic) {
    const SourceLocation& location = diagnostic.location;
    const std::size_t file = location.file.empty() ? order.size() : order.at(location.file);
    return std::tuple(file, location.line, location.column);
  };
  // Sorted as numbers: moving the diagnostics would pull the names from under the table.
  std::vector<std::size_t> places(all_.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t a, std::size_t b) { return key(all_[a]) < key(all_[b]); });
  std::vector<Diagnostic> sorted;
  sorted.reserve(all_.size());
  for (const std::size_t place : places) sorted.push_back(std::move(all_[place]));
  all_ = std::move(sorted);
}

std::string_view name_of(Diagnostic::Severity severity) {
  switch (severity) {
    case Diagnostic::Severity::error:
      return "error";
    case Diagnostic::Severity::warning:
      return "warning";
    default:
      return "note";
  }
}

std::string place_text(const SourceLocation& location) {
  std::string text = printable(location.file);
  if (location.line > 0) text += fmt::format(":{}", location.line);
  if (location.line > 0 && location.column > 0) text += fmt::format(":{}", location.column);
  return text;
}

std::string safe_to_print(std::string_view text) {
  std::string safe;
  for (std::size_t begin = 0;;) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    safe += printable(text.substr(begin, end - begin));
    if (end == text.size()) return safe;
    safe += '\n';
    begin = end + 1;
  }
}

std::string to_text(const Diagnostic& diagnostic) {
  const SourceLocation& location = diagnostic.location;
  std::string text;
  if (!location.file.empty()) text = place_text(location) + ": ";
  text += fmt::format("{}: ", name_of(diagnostic.severity));
  text += printable(diagnostic.message);
  if (location.line > 0 && !location.excerpt.empty()) {
    const auto [excerpt, mark] = excerpt_and_mark(location);
    text += fmt::format("\n{:5} | {}", location.line, excerpt);
    if (location.column > 0) text += fmt::format("\n      | {}", mark);
  }
  if (diagnostic.accepted.empty()) return text;
  text += "\naccepted:";
  // Lines that follow the first are indented: none of them can be taken for another diagnostic.
  std::string_view indent = " ";
  for (const TextPiece& line : split(diagnostic.accepted, "\n")) {
    text += fmt::format("{}{}", indent, printable(line.text));
    indent = "\n    ";
  }
  return text;
}

}  // namespace norrsken
