// Reader of Mitsuba's volume files: values on a grid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/memory.h"
#include "norrsken/diagnostics.h"

namespace norrsken {

/// What a volume file holds; x varies fastest, then y, then z.
struct VolumeData {
  std::array<std::uint32_t, 3> size{};    ///< values along x, y and z, 1 or more
  std::uint32_t channels = 0;             ///< 1 or more
  Array<float> values;                    ///< `channels` for each place, all finite
  std::array<float, 3> lower{}, upper{};  ///< the bounding box that the file tells, whatever it is
};

/// Version 3 with 32-bit floats, all there is.
std::optional<VolumeData> read_vol(std::string_view bytes, const std::string& path, Diagnostics& diagnostics);

}  // namespace norrsken
