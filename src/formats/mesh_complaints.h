// Complaints about one mesh file: the first twenty errors, then no more, because one wrong line is rarely alone, and each kind
// of warning once.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "norrsken/diagnostics.h"
#include "scene/source_text.h"

namespace norrsken {

/// What some programs put before UTF-8 text.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// What is left out of a mesh, or missing from it.
enum class MeshFlaw { not_finite, small_face, no_faces, intricate_face, no_texcoords, count };

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

  /// A flaw at a stretch of the text, or in a file without lines. `tell_flaws` warns of the first of its kind and says how
  /// many there are.
  void flaw_at(std::string_view piece, MeshFlaw kind, std::string message) {
    Flaw& flaw = flaws_[static_cast<std::size_t>(kind)];
    if (++flaw.count > 1) return;
    flaw.message = std::move(message);
    flaw.place = piece.empty()
                     ? source_.location()
                     : source_.location(static_cast<std::size_t>(piece.data() - source_.text().data()), piece.size());
  }
  void tell_flaws() {
    for (Flaw& flaw : flaws_) {
      if (flaw.count > 1) flaw.message += fmt::format("; the first of {} such places", flaw.count);
      if (flaw.count > 0) diagnostics_.warning(std::move(flaw.place), std::move(flaw.message));
      flaw = {};
    }
  }

  bool any() const { return count_ > 0; }
  bool gave_up() const { return count_ > kMaxComplaints; }

 private:
  static constexpr int kMaxComplaints = 20;

  void add(SourceLocation location, std::string message, std::string accepted) {
    if (++count_ <= kMaxComplaints) diagnostics_.error(std::move(location), std::move(message), std::move(accepted));
    if (count_ == kMaxComplaints + 1) diagnostics_.error(source_.location(), "and more errors in this file");
  }

  struct Flaw {
    std::size_t count = 0;
    SourceLocation place;
    std::string message;
  };

  SourceText source_;
  Diagnostics& diagnostics_;
  int count_ = 0;
  Flaw flaws_[static_cast<std::size_t>(MeshFlaw::count)];
};

}  // namespace norrsken
