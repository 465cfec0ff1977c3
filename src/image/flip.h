// LDR-FLIP: the difference that a person sees when two images are shown one after the other in the same place.
#pragma once

#include <array>
#include <vector>

namespace norrsken {

/// Red, green and blue of an image as sRGB-encoded display values in [0,1], rows from the top.
struct DisplayImage {
  int width = 0, height = 0;
  std::array<std::vector<float>, 3> planes;
};

/// The FLIP error of every pixel, from 0 (no visible difference) to 1 (the greatest that there is). Both images have
/// the same size, at least one pixel; the two may be swapped without changing the result.
///
/// `pixels_per_degree` is the number of pixels that a degree of the viewer's field takes, 1 to 1000.
///
/// Source: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for
/// Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020; section 4 for low dynamic range.
/// Departures: none; the filters, which are products of one-dimensional ones, are applied one axis at a time.
std::vector<float> flip_map(const DisplayImage& reference, const DisplayImage& test, double pixels_per_degree);

}  // namespace norrsken
