// What all shapes made of triangles share: parameters of mesh files, placing, vertex normals.
//
// Polygons are cut into triangles as they look from the front of their best plane, concave ones too (Mitsuba draws fans).
// Left out, with a warning: triangles without an area, faces of fewer than three corners, vertices that are not finite.
//
// Normals, as Mitsuba documents them: the file's own; without any, the mean of the faces around each vertex weighed
// with the angle of their corner, so only vertices that faces do not share stay sharp. A mesh without normals of its
// own is turned inside out by a mirroring `to_world`, like in Mitsuba, because its winding is what says where its front
// is.
//
// Front and back: as in Mitsuba the side from which a BSDF is seen is told by the shading normal, so that a coarse mesh
// has no black rim where its interpolated normals turn away from the viewer before its triangles do.
//
// Departures: which side of a triangle emits is told by the geometric normal, in Mitsuba by the shading normal too. A
// triangle whose winding contradicts the file's vertex normals is wound the other way, so that the two agree; texture
// coordinates that the file does not give still go by the file's order of corners.
//
// Sources: Thuermer and Wuethrich 1998, Computing Vertex Normals from Polygonal Facets (the weights).
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "compile/shapes.h"

namespace norrsken {

using ReadMesh =
    std::function<std::optional<MeshData>(std::string_view bytes, const std::string& path, Diagnostics& diagnostics)>;

inline constexpr BooleanParameter kFlipTexCoords{.name = "flip_tex_coords", .text = "v becomes 1 - v"};

/// A shape that reads its mesh from the file that its parameters name. Formats without `flip_tex_coords` do not take it.
std::optional<ShapeGeometry> compile_mesh_file(Parameters& p, Shapes& shapes, const ReadMesh& read,
                                               std::optional<BooleanParameter> flip_tex_coords);

/// Reads to_world, face_normals and flip_normals, and the shape that `mesh` becomes by them. Empty after a complaint.
std::optional<ShapeGeometry> compile_mesh(Parameters& p, Shapes& shapes, MeshData mesh);

/// Takes positions and normals to the world, winds triangles as their normals say, and drops triangles without an area
/// (a warning with their number), possibly all. False after an error: a vertex too far away.
bool place_mesh(MeshData& mesh, const glm::dmat4& to_world, Parameters& p);

/// Turns the front of every triangle to the other side; normals are left alone.
void reverse_winding(MeshData& mesh);

/// Replaces the normals by angle-weighted means of the faces around each vertex.
void compute_normals(MeshData& mesh);

/// Whether every vertex normal is that of its face, so that the mesh may be shaded flat.
bool normals_are_flat(const MeshData& mesh);

}  // namespace norrsken
