#include "norrsken/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.h"

namespace norrsken {
namespace {

constexpr std::size_t kMaxKept = 100;
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

}  // namespace

void Diagnostics::error(SourceLocation location, std::string message, std::string accepted) {
  ++error_count_;
  if (all_.size() < kMaxKept) {
    all_.push_back({Diagnostic::Severity::error, std::move(message), std::move(accepted), std::move(location)});
  } else if (all_.size() == kMaxKept) {
    all_.push_back(
        {Diagnostic::Severity::error, fmt::format("more than {} complaints, the rest are left out", kMaxKept), {}, {}});
  }
}

void Diagnostics::warning(SourceLocation location, std::string message, std::string accepted) {
  if (all_.size() >= kMaxKept) return;
  all_.push_back({Diagnostic::Severity::warning, std::move(message), std::move(accepted), std::move(location)});
}

std::string to_text(const Diagnostic& diagnostic) {
  const SourceLocation& location = diagnostic.location;
  std::string text;
  if (!location.file.empty()) {
    text = printable(location.file) + ":";
    if (location.line > 0) text += fmt::format("{}:", location.line);
    if (location.line > 0 && location.column > 0) text += fmt::format("{}:", location.column);
    text += ' ';
  }
  text += diagnostic.severity == Diagnostic::Severity::error ? "error: " : "warning: ";
  text += printable(diagnostic.message);
  if (location.line > 0 && !location.excerpt.empty()) {
    const auto [excerpt, mark] = excerpt_and_mark(location);
    text += fmt::format("\n{:5} | {}", location.line, excerpt);
    if (location.column > 0) text += fmt::format("\n      | {}", mark);
  }
  if (!diagnostic.accepted.empty()) text += "\naccepted: " + printable(diagnostic.accepted);
  return text;
}

}  // namespace norrsken
