// What the tests of mesh readers measure of a mesh.
#pragma once

#include <gtest/gtest.h>

#include "formats/mesh_data.h"

namespace norrsken {

/// Twice the area of a mesh in the plane z = 0; a triangle that is turned over fails the test.
inline double area2(const MeshData& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const double area = double{b[0] - a[0]} * double{c[1] - a[1]} - double{b[1] - a[1]} * double{c[0] - a[0]};
    EXPECT_GE(area, 0);
    sum += area;
  }
  return sum;
}

}  // namespace norrsken
