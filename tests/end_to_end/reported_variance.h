// Holds the variance that images tell of themselves against that of images of different seeds.
#pragma once

#include <stdexcept>
#include <vector>

#include "tests/end_to_end/rendering.h"

namespace norrsken::end_to_end {

/// Variance that `images` images report, green and summed over the pixels, over the variance that there is among them.
inline double reported_over_observed(const Scene& scene, RenderOptions options, int images) {
  options.threads = kThreads;
  std::vector<double> sum, squares;
  double reported = 0, observed = 0;
  for (int k = 0; k < images; ++k, ++options.seed) {
    const Image image = render_image(scene, options, true);
    const Channel *green = image.find("G"), *variance = image.find("variance.G");
    if (green == nullptr || variance == nullptr) throw std::runtime_error("the image tells no variance");
    sum.resize(green->values.size()), squares.resize(green->values.size());
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const double value = static_cast<double>(green->values[i]);
      sum[i] += value, squares[i] += value * value;
      reported += static_cast<double>(variance->values[i]) / images;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) observed += (squares[i] - sum[i] * sum[i] / images) / (images - 1);
  if (!(observed > 0)) throw std::runtime_error("there is no noise");
  return reported / observed;
}

}  // namespace norrsken::end_to_end
