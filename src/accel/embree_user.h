// Geometry that Embree asks us about.
#pragma once

#include <embree3/rtcore.h>

#include <span>

#include "tables/accel_tables.h"
#include "tables/scene_tables.h"

namespace norrsken {

/// Geometries to commit and attach; both borrow the records.
RTCGeometry make_embree_spheres(RTCDevice device, std::span<const SphereRecord> spheres);
RTCGeometry make_embree_analytics(RTCDevice device, std::span<const AnalyticRecord> shapes);

}  // namespace norrsken
