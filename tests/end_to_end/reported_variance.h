// Holds the variance that images tell of themselves against that of images of different seeds.
#pragma once

#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/end_to_end/rendering.h"
#include "tests/statistics/statistical_test.h"

namespace norrsken::end_to_end {

/// Whether the variance that images of `2 * pairs` seeds report, green and summed over the pixels, is the one that there is
/// among them: of two, half the squared difference. A bias of `resolution` is to be seen. One comparison.
inline ::testing::AssertionResult reports_its_variance(statistics::StatisticalTest& test, double resolution,
                                                       const Scene& scene, RenderOptions options, int pairs,
                                                       const std::string& what) {
  options.threads = kThreads;
  struct Green {
    std::vector<float> value, variance;
  };
  const auto next = [&] {
    const Image image = render_image(scene, options, true);
    ++options.seed;
    const Channel *green = image.find("G"), *variance = image.find("variance.G");
    if (green == nullptr || variance == nullptr) throw std::runtime_error("the image tells no variance");
    return Green{green->values, variance->values};
  };

  // Each pixel counts about as much as another, or a few would decide: weights from images of other seeds.
  constexpr int kPilots = 8;
  std::vector<double> weights;
  for (int i = 0; i < kPilots; ++i) {
    const Green pilot = next();
    weights.resize(pilot.variance.size());
    for (std::size_t pixel = 0; pixel < weights.size(); ++pixel)
      weights[pixel] += static_cast<double>(pilot.variance[pixel]) / kPilots;
  }
  const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(weights.size());
  const double least = mean > 0 ? 0.1 * mean : 1;  // images that report none at all are still to be compared
  for (double& weight : weights) weight = 1 / (weight + least);

  statistics::PairedMeans means;
  for (int pair = 0; pair < pairs; ++pair) {
    const Green a = next(), b = next();
    double reported = 0, observed = 0;
    for (std::size_t pixel = 0; pixel < weights.size(); ++pixel) {
      const double difference = static_cast<double>(a.value[pixel]) - static_cast<double>(b.value[pixel]);
      const double sum = static_cast<double>(a.variance[pixel]) + static_cast<double>(b.variance[pixel]);
      reported += weights[pixel] * sum / 2;
      observed += weights[pixel] * difference * difference / 2;
    }
    means.add(reported, observed);
  }
  if (!(means.reference().mean > 0)) throw std::runtime_error("there is no noise");
  return test.agree_to(resolution, means, what);
}

}  // namespace norrsken::end_to_end
