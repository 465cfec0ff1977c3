// The largest extinction of a heterogeneous medium, cell by cell.
#pragma once

#include <glm/mat4x4.hpp>

#include "compile/media.h"

namespace norrsken {

struct MajorantSummary {
  std::uint32_t count = 0;
  double mean = 0;
};

/// Fills what a medium's record says of its cells, for the extinction `scale` times `volume`.
MajorantSummary add_majorants(SceneTables& tables, const Volume& volume, double scale, MediumRecord& record);

/// A volume of one value, and one of the values that stand among the texels from `record.first` on.
Volume add_constant(Media& media, const glm::dvec3& value, const glm::dmat4& world_from_local);
Volume add_volume(Media& media, VolumeRecord record, const glm::dmat4& world_from_local, double min, double max);

}  // namespace norrsken
