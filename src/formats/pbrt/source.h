// The files that a pbrt scene is made of: their texts, unpacked, and places in them.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/memory.h"
#include "scene/file_system.h"
#include "scene/source_text.h"

namespace norrsken::pbrt {

/// A text that stays where it is, so that places in it can be told as long as it lives.
class Source {
 public:
  Source(std::string path, FileContents contents)
      : contents_(std::move(contents)), text_(std::move(path), contents_.bytes) {}
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  const SourceText& text() const { return text_; }

 private:
  FileContents contents_;
  SourceText text_;
};

/// A stretch of a source: as small as there are many of them.
struct Place {
  const Source* source = nullptr;
  std::size_t offset = 0, length = 1;

  SourceLocation location() const { return source ? source->text().location(offset, length) : SourceLocation{}; }
};

/// Reads and, if it is packed by gzip, unpacks a file. Empty with `error` set otherwise. May throw MemoryExceeded: what is
/// unpacked is counted as it comes, so a small file that becomes a large one ends there.
std::optional<FileContents> read_unpacked(const FileSystem& files, const std::string& path, std::string& error);

}  // namespace norrsken::pbrt
