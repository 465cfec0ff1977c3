// Mitsuba's volume files.
#include "formats/vol.h"

#include <algorithm>
#include <cmath>

#include "fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace norrsken;
  Diagnostics diagnostics;
  const auto volume = read_vol(fuzz::text_of(data, size), "input.vol", diagnostics);
  fuzz::check_complaints(volume.has_value(), diagnostics);
  if (!volume) return 0;
  const auto [x, y, z] = volume->size;
  fuzz::require(x >= 1 && y >= 1 && z >= 1 && volume->channels >= 1, "there are values");
  fuzz::require(volume->values.size() == std::uint64_t{x} * y * z * volume->channels, "as many as the size says");
  fuzz::require(std::ranges::all_of(volume->values, [](float v) { return std::isfinite(v); }), "values are finite");
  return 0;
}
