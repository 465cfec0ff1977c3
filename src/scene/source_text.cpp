#include "scene/source_text.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace norrsken {
namespace {

// Excerpts are kept with every property: bounded, but wide enough for a terminal.
constexpr std::size_t kExcerptBefore = 60, kExcerptBytes = 160;

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u; }

int to_int(std::size_t value) {
  return static_cast<int>(std::min<std::size_t>(value, std::numeric_limits<int>::max()));
}

}  // namespace

SourceLocation SourceText::location() const {
  SourceLocation result;
  result.file = path_;
  return result;
}

SourceLocation SourceText::location(std::size_t offset, std::size_t length) const {
  if (line_starts_.empty()) {
    line_starts_.push_back(0);
    // Line breaks are LF, CRLF, or CR alone.
    for (std::size_t at = 0; (at = text_.find_first_of("\r\n", at)) != std::string_view::npos;) {
      at += text_.substr(at).starts_with("\r\n") ? 2 : 1;
      line_starts_.push_back(at);
    }
  }
  offset = std::min(offset, text_.size());
  const auto next_line = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const std::size_t start = *(next_line - 1);
  // Not searched for: a file of one huge line is asked for many places.
  const std::size_t end = next_line != line_starts_.end() ? *next_line - 1 : text_.size();
  std::string_view line = text_.substr(start, end - start);
  if (line.ends_with('\r')) line.remove_suffix(1);

  SourceLocation result = location();
  result.line = to_int(static_cast<std::size_t>(next_line - line_starts_.begin()));
  const std::size_t before = offset - start;
  result.column = to_int(before + 1);
  result.length =
      to_int(std::clamp<std::size_t>(length, 1, std::max<std::size_t>(line.size() - std::min(before, line.size()), 1)));

  std::size_t first = 0;
  if (line.size() > kExcerptBytes) {
    first = before > kExcerptBefore ? before - kExcerptBefore : 0;
    first = std::min(first, line.size() - kExcerptBytes);
    while (first > 0 && is_continuation(line[first])) --first;
    std::size_t last = std::min(first + kExcerptBytes, line.size());
    while (last < line.size() && last > first && is_continuation(line[last])) --last;
    line = line.substr(first, last - first);
  }
  result.excerpt = std::string(line);
  result.excerpt_column = to_int(first + 1);
  return result;
}

}  // namespace norrsken
