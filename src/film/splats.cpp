#include "film/splats.h"

#include <algorithm>
#include <cmath>

namespace norrsken {

Splats::Splats(const FilmSettings& settings, std::span<const float> filter)
    : settings_(settings),
      filter_(filter.begin(), filter.end()),
      sums_(static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height) * kLightReplicates *
            3) {}

/// A pixel's value is the integral of the image times the filter around the pixel's centre, over the filter's integral:
/// over all of it, or over what of it is on the film.
void Splats::cover(double position, std::uint32_t size, Footprint& footprint) const {
  const FilterRecord& record = settings_.filter;
  footprint.weights.clear();
  if (record.kind == FilterKind::box) {
    footprint.first = std::min(static_cast<std::uint32_t>(position), size - 1);
    footprint.weights.push_back(1);
    return;
  }
  const float *nodes = filter_.data(), *values = nodes + record.nodes;
  const float* integrals =
      nodes + std::size_t{3} * record.nodes + (record.cells + 1) + (record.edges + 1);  // those with signs
  const auto integral_to_edge = [&](std::uint32_t pixels) {
    return static_cast<double>(integrals[settings_.sample_border ? record.edges : std::min(pixels, record.edges)]);
  };
  const std::uint32_t last = record.nodes - 1;
  const double radius = static_cast<double>(nodes[last]);
  const double low = std::ceil(position - radius - 0.5), high = std::floor(position + radius - 0.5);
  footprint.first = static_cast<std::uint32_t>(std::max(low, 0.0));
  for (std::uint32_t pixel = footprint.first; pixel < size && static_cast<double>(pixel) <= high; ++pixel) {
    const double distance = std::min(std::abs(position - (pixel + 0.5)), radius);
    // The nodes around it: they are spread evenly but for those where the filter changes its sign.
    auto next = static_cast<std::uint32_t>(std::clamp(distance / radius * (last - 1), 1.0, static_cast<double>(last)));
    while (next < last && static_cast<double>(nodes[next]) < distance) ++next;
    while (next > 1 && static_cast<double>(nodes[next - 1]) > distance) --next;
    const double x0 = static_cast<double>(nodes[next - 1]), x1 = static_cast<double>(nodes[next]);
    const double f0 = static_cast<double>(values[next - 1]), f1 = static_cast<double>(values[next]);
    const double value = f0 + (f1 - f0) * (distance - x0) / (x1 - x0);
    footprint.weights.push_back(value / (integral_to_edge(pixel) + integral_to_edge(size - 1 - pixel)));
  }
}

void Splats::add(const WaveJob& job, const Queue<stored::Splat>& splats, DroppedSamples& dropped) {
  const auto width = static_cast<std::uint32_t>(settings_.width), height = static_cast<std::uint32_t>(settings_.height);
  const std::uint32_t stride = job.pixel_stride();
  for (std::uint32_t i = 0; i < splats.count; ++i) {
    const auto [film, color, slot] = splats[i];
    const std::uint32_t sample = job.first_sample + slot / stride;
    if (!std::isfinite(color[0]) || !std::isfinite(color[1]) || !std::isfinite(color[2])) {
      if (dropped.count < DroppedSamples::kKept) {
        const std::uint32_t path = slot % stride;
        dropped.pixel[dropped.count] = (job.y0 + path / job.width) * width + job.x0 + path % job.width;
        dropped.sample[dropped.count] = sample;
      }
      ++dropped.count;
      continue;
    }
    cover(static_cast<double>(film[0]), width, columns_);
    cover(static_cast<double>(film[1]), height, rows_);
    for (std::size_t y = 0; y < rows_.weights.size(); ++y) {
      for (std::size_t x = 0; x < columns_.weights.size(); ++x) {
        const double weight = rows_.weights[y] * columns_.weights[x];
        const std::size_t pixel = (rows_.first + y) * width + columns_.first + x;
        const std::size_t first = (pixel * kLightReplicates + sample % kLightReplicates) * 3;
        for (std::size_t c = 0; c < 3; ++c) {
          sums_.add(first + c, rounded_to_24_bits(weight * static_cast<double>(color[c])));
        }
      }
    }
  }
}

void Splats::count_paths(const WaveJob& job) {
  for (std::uint32_t s = 0; s < job.sample_count; ++s) {
    paths_[(job.first_sample + s) % kLightReplicates] += job.pixel_count();
  }
}

void Splats::add(const Splats& other) {
  sums_.add(other.sums_);
  for (std::size_t r = 0; r < kLightReplicates; ++r) paths_[r] += other.paths_[r];
}

PixelEstimate Splats::estimate(std::uint64_t pixel, int channel) const {
  double sums[kLightReplicates], counts[kLightReplicates];
  for (std::size_t r = 0; r < kLightReplicates; ++r) {
    sums[r] = sums_[(pixel * kLightReplicates + r) * 3 + static_cast<std::size_t>(channel)];
    counts[r] = static_cast<double>(paths_[r]);
  }
  return estimate_from_replicates(sums, counts);
}

}  // namespace norrsken
