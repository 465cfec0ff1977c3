// How an image was made, as its file says it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "norrsken/render.h"

namespace norrsken {

/// Texts by the names that they have in EXR and PNG files.
using Metadata = std::map<std::string, std::string>;

/// What a rendering knows before it begins, and for how long it has rendered.
struct Provenance {
  Metadata settings;
  double seconds = 0;
};

Metadata settings_of(const Scene& scene, const RenderOptions& options, const std::string& isa,
                     const std::string& accelerator);

/// What has come of it.
struct Outcome {
  double samples_per_pixel = 0;
  std::vector<SampleRange> ranges = {};  ///< if not all from 0 on
  RelativeError error = {};
  std::uint64_t dropped_samples = 0;
  bool interrupted = false;
};

/// Everything; the date is that of now. With SOURCE_DATE_EPOCH in the environment the date is that, and how long it took
/// is not said: the same samples then make the same file.
Metadata metadata_of(const Provenance& made, const Outcome& outcome);

}  // namespace norrsken
