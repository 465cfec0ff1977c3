// What the fuzz targets share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "norrsken/diagnostics.h"

/// libFuzzer's entry points: every target has the first, some have the second.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);

namespace norrsken::fuzz {

/// Ends the program, so that libFuzzer keeps the input, if what every input promises does not hold.
inline void require(bool holds, std::string_view what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A reader answers or complains, and every complaint can be told.
inline void check_complaints(bool has_answer, const Diagnostics& diagnostics) {
  require(has_answer != diagnostics.has_errors(), "an answer without errors, or errors without an answer");
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    require(!to_text(diagnostic).empty() && !diagnostic.message.empty(), "complaints say something");
  }
}

}  // namespace norrsken::fuzz
