// A text file's contents that can say which line and column a byte stands in.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "norrsken/diagnostics.h"

namespace norrsken {

/// Refers to text that must outlive it. Lines are indexed on first use; not for several threads at once.
class SourceText {
 public:
  SourceText(std::string path, std::string_view text) : path_(std::move(path)), text_(text) {}

  const std::string& path() const { return path_; }
  std::string_view text() const { return text_; }

  /// The stretch of `length` bytes at `offset`, cut at the end of its line.
  SourceLocation location(std::size_t offset, std::size_t length = 1) const;
  /// The file as a whole.
  SourceLocation location() const;

 private:
  std::string path_;
  std::string_view text_;
  mutable std::vector<std::size_t> line_starts_;
};

}  // namespace norrsken
