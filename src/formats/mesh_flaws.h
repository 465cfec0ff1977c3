// What mesh files may have wrong without being refused: it is left out, with a warning.
#pragma once

#include <cstddef>
#include <string>

#include "formats/mesh_complaints.h"
#include "formats/mesh_data.h"
#include "formats/polygon.h"

namespace norrsken {

/// Places that are not finite become the origin, and triangles there lose their area, as which they are left out when the
/// mesh is placed. Other values become 0: normals are then those of a face, as where there are none.
void leave_out_not_finite(MeshData& mesh);

/// `what` is told of a number in the file: "'nan' is not finite".
std::string not_finite_text(const std::string& what);
std::string small_face_text(std::size_t corners);
void warn_of_intricate(const PolygonCutter& cutter, MeshComplaints& complaints);

}  // namespace norrsken
