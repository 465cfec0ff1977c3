#include "film/film.h"

#include <array>
#include <cmath>
#include <limits>

#include "tables/wave_types.h"

namespace norrsken {
namespace {

constexpr std::uint32_t kFeaturePlanes = 8;
constexpr const char* kFeatureNames[kFeaturePlanes] = {"depth.Z",  "normal.X", "normal.Y", "normal.Z",
                                                       "albedo.R", "albedo.G", "albedo.B", "id"};
constexpr const char* kColors[3] = {"R", "G", "B"};

std::uint32_t plane_count(SamplerKind sampler) { return sampler == SamplerKind::independent ? 6 : 3 * kReplicates; }

/// How many of the first n samples belong to replicate r.
std::uint32_t replicate_count(std::uint32_t n, std::uint32_t r) { return (n + kReplicates - 1 - r) / kReplicates; }

}  // namespace

void FilmError::operator+=(const FilmError& other) {
  mean_sum += other.mean_sum;
  variance_sum += other.variance_sum;
  channels += other.channels;
}

double FilmError::relative() const {
  if (channels == 0 || !(mean_sum > 0)) return -1;
  const double n = static_cast<double>(channels);
  return std::sqrt(variance_sum / n) / (mean_sum / n);
}

Film::Film(const FilmSettings& settings, SamplerKind sampler, bool features)
    : width_(static_cast<std::uint32_t>(settings.width)),
      height_(static_cast<std::uint32_t>(settings.height)),
      weighted_(settings.filter.kind != FilterKind::box),
      sampler_(sampler) {
  const std::size_t pixels = static_cast<std::size_t>(width_) * height_;
  sums_.resize(pixels * plane_count(sampler));
  counts_.resize(pixels);
  if (features) features_.resize(pixels * kFeaturePlanes);
}

FilmView Film::view() {
  return {sums_.data(), counts_.data(), features_.empty() ? nullptr : features_.data(), width_, height_, weighted_};
}

PixelEstimate Film::estimate(std::uint64_t pixel, int channel) const {
  const PixelEstimate samples = estimate_samples(pixel, channel);
  if (!splats_.exist()) return samples;
  // Two independent estimates of two parts of the light.
  const PixelEstimate splats = splats_.estimate(pixel, channel);
  return {samples.mean + splats.mean, samples.variance + splats.variance, samples.known && splats.known};
}

PixelEstimate Film::estimate_samples(std::uint64_t pixel, int channel) const {
  const std::size_t pixels = counts_.size();
  const std::uint32_t n = counts_[pixel] & ~kSomeDropped;
  if (n == 0) return {};
  const auto sum = [&](std::uint32_t plane) { return sums_[plane * pixels + pixel]; };
  const double count = n;
  const auto c = static_cast<std::uint32_t>(channel);

  if (sampler_ == SamplerKind::independent) {
    const double mean = sum(c) / count;
    if (n < 2) return {mean, 0, false};
    const double variance = (sum(3 + c) - count * mean * mean) / (count * (count - 1));
    return {mean, std::max(variance, 0.0), true};
  }

  double sums[kReplicates], counts[kReplicates];
  for (std::uint32_t r = 0; r < kReplicates; ++r) sums[r] = sum(3 * r + c), counts[r] = replicate_count(n, r);
  PixelEstimate estimate = estimate_from_replicates(sums, counts);
  // Which replicate lost how many is not known any more.
  if ((counts_[pixel] & kSomeDropped) != 0) estimate.known = false;
  return estimate;
}

FilmError Film::error(const FilmRegion& region) const {
  FilmError total;
  for (std::uint32_t y = region.y0; y < region.y0 + region.height; ++y) {
    for (std::uint32_t x = region.x0; x < region.x0 + region.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const PixelEstimate e = estimate(static_cast<std::uint64_t>(y) * width_ + x, c);
        if (!e.known) continue;
        total.mean_sum += e.mean;
        total.variance_sum += e.variance;
        ++total.channels;
      }
    }
  }
  return total;
}

Image Film::image(bool layers, std::uint32_t feature_samples) const {
  Image image;
  image.width = static_cast<int>(width_);
  image.height = static_cast<int>(height_);
  const std::size_t pixels = counts_.size();
  const auto add = [&](const std::string& name) {
    image.channels.push_back({name, std::vector<float>(pixels)});
    return image.channels.size() - 1;
  };
  std::array<std::size_t, 3> color{}, variance{}, error{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = add(kColors[c]);
  std::size_t samples = 0;
  if (layers) {
    samples = add("samples");
    for (std::size_t c = 0; c < 3; ++c) variance[c] = add(std::string("variance.") + kColors[c]);
    for (std::size_t c = 0; c < 3; ++c) error[c] = add(std::string("error.") + kColors[c]);
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const PixelEstimate e = estimate(i, static_cast<int>(c));
      image.channels[color[c]].values[i] = static_cast<float>(e.mean);
      if (!layers) continue;
      const double known = e.known ? e.variance : std::numeric_limits<double>::quiet_NaN();
      image.channels[variance[c]].values[i] = static_cast<float>(known);
      image.channels[error[c]].values[i] = static_cast<float>(std::sqrt(known));
    }
    if (layers) image.channels[samples].values[i] = static_cast<float>(counts_[i] & ~kSomeDropped);
  }
  if (!features_.empty() && feature_samples > 0) {
    for (std::uint32_t k = 0; k < kFeaturePlanes; ++k) {
      std::vector<float>& values = image.channel(kFeatureNames[k]).values;
      const float scale = k == 7 ? 1.0f : 1.0f / static_cast<float>(feature_samples);
      for (std::size_t i = 0; i < pixels; ++i) values[i] = features_[k * pixels + i] * scale;
    }
  }
  return image;
}

}  // namespace norrsken
