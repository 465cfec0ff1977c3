// Complaints about one mesh file: the first twenty, then no more, because one wrong line is rarely alone.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "norrsken/diagnostics.h"
#include "scene/source_text.h"

namespace norrsken {

class MeshComplaints {
 public:
  MeshComplaints(const std::string& path, std::string_view bytes, Diagnostics& diagnostics)
      : source_(path, bytes), diagnostics_(diagnostics) {}

  /// About a stretch of the file's text.
  void at(std::string_view piece, std::string message, std::string accepted = {}) {
    const auto offset = static_cast<std::size_t>(piece.data() - source_.text().data());
    add(source_.location(offset, piece.size()), std::move(message), std::move(accepted));
  }
  /// About the file as a whole, or a part of it that has no lines.
  void about_file(std::string message, std::string accepted = {}) {
    add(source_.location(), std::move(message), std::move(accepted));
  }

  bool any() const { return count_ > 0; }
  bool gave_up() const { return count_ > kMaxComplaints; }

 private:
  static constexpr int kMaxComplaints = 20;

  void add(SourceLocation location, std::string message, std::string accepted) {
    if (++count_ <= kMaxComplaints) diagnostics_.error(std::move(location), std::move(message), std::move(accepted));
    if (count_ == kMaxComplaints + 1) diagnostics_.error(source_.location(), "and more errors in this file");
  }

  SourceText source_;
  Diagnostics& diagnostics_;
  int count_ = 0;
};

}  // namespace norrsken
