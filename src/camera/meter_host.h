// What meters share on the host.
#pragma once

#include "compile/frame_tools.h"

namespace norrsken {

/// A record whose rays see however near and far, with no axis.
CameraRecord make_meter(CameraKind kind);

/// A unit vector; after a complaint anything.
glm::dvec3 read_direction(Parameters& p, const PointParameter& direction);
/// The way that `to_world` takes +z, which is what `direction` says otherwise.
glm::dvec3 direction_of(const glm::dmat4& to_world);

/// Lets the meter look at, or stand on, the surface of that shape; a complaint about `node` if it has none that is sampled.
void set_surface(CameraRecord& meter, const ShapeGeometry& surface, const Node& node, Parameters& p, Sensors& sensors);

}  // namespace norrsken
