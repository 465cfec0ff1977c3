// Holds the variance that images tell of themselves against that of images of different seeds.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "tests/end_to_end/rendering.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::end_to_end {

/// Whether the variance that images of `2 * pairs` seeds report, green and summed over the pixels, is the one that there is
/// among them: of two, half the squared difference. One comparison.
inline ::testing::AssertionResult reports_its_variance(statistics::StatisticalTest& test, const Scene& scene,
                                                       RenderOptions options, int pairs, const std::string& what) {
  options.threads = kThreads;
  statistics::Mean reported, observed;
  for (int pair = 0; pair < pairs; ++pair) {
    double said = 0, seen = 0;
    std::vector<float> first;
    for (int i = 0; i < 2; ++i, ++options.seed) {
      const Image image = render_image(scene, options, true);
      const Channel *green = image.find("G"), *variance = image.find("variance.G");
      if (green == nullptr || variance == nullptr) throw std::runtime_error("the image tells no variance");
      if (i == 0) first = green->values;
      for (std::size_t pixel = 0; pixel < first.size(); ++pixel) {
        const double difference = static_cast<double>(green->values[pixel]) - static_cast<double>(first[pixel]);
        said += static_cast<double>(variance->values[pixel]) / 2;
        seen += difference * difference / 2;
      }
    }
    reported.add(said), observed.add(seen);
  }
  if (!(observed.estimate().mean > 0)) throw std::runtime_error("there is no noise");
  return test.agree(reported.estimate(), observed.estimate(), what);
}

}  // namespace norrsken::end_to_end
