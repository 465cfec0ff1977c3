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
    for (std::size_t at = 0; (at = text_.find('\n', at)) != std::string_view::npos;) line_starts_.push_back(++at);
  }
  offset = std::min(offset, text_.size());
  const auto next_line = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const std::size_t start = *(next_line - 1);
  std::string_view line = text_.substr(start);
  line = line.substr(0, line.find('\n'));
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
    std::size_t end = std::min(first + kExcerptBytes, line.size());
    while (end < line.size() && end > first && is_continuation(line[end])) --end;
    line = line.substr(first, end - first);
  }
  result.excerpt = std::string(line);
  result.excerpt_column = to_int(first + 1);
  return result;
}

}  // namespace norrsken
