// The faces of a PLY file: polygons whose corners may have texture coordinates of their own.
#pragma once

#include <array>
#include <cstdint>

#include "formats/mesh_data.h"
#include "formats/polygon.h"

namespace norrsken {

class PlyFaces {
 public:
  /// Faces become triangles of this mesh, whose vertices may come before or after them.
  explicit PlyFaces(MeshData& mesh) : mesh_(mesh) {}

  /// The face at hand: vertices, and u and v of each corner; or no texture coordinates, which are then 0. Where no face has
  /// any, it is as if there could be none.
  Array<std::uint32_t> corners;
  Array<float> texcoords;
  bool have_texcoords = false;                            ///< whether any face may
  std::size_t with_texcoords = 0, without_texcoords = 0;  ///< faces that do and do not, if any may

  /// Adds the face at hand, if it has three corners or more.
  void add();
  /// To be called last. Corners that share a vertex but not their texture coordinates get vertices of their own.
  const PolygonCutter& finish();

 private:
  /// The triangles of a face with more than three corners: the first one, and its corners.
  struct Fan {
    std::size_t first, corners;
  };
  using Texcoord = std::array<float, 2>;

  void cut(const Fan& fan);
  void split_vertices();

  MeshData& mesh_;
  Array<Texcoord> corner_texcoords_;  ///< three for each triangle, if faces have any
  Array<PolygonCutter::Point> points_;
  PolygonCutter cutter_;
  Array<Fan> fans_to_come_;  ///< of faces that came before their vertices
};

}  // namespace norrsken
