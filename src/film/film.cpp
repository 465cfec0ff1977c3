#include "film/film.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "color/srgb.h"
#include "film/interval.h"
#include "tables/film_memory.h"
#include "tables/wave_types.h"

namespace norrsken {
namespace {

constexpr const char* kColors[3] = {"R", "G", "B"};

std::size_t pixel_count(const FilmSettings& settings) {
  return static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
}

}  // namespace

std::vector<FeatureLayer> standard_features() {
  constexpr const char* kNames[] = {"depth.Z",  "normal.X", "normal.Y", "normal.Z",
                                    "albedo.R", "albedo.G", "albedo.B", "id"};
  std::vector<FeatureLayer> layers;
  for (const char* name : kNames) layers.push_back({name, static_cast<Feature>(layers.size())});
  return layers;
}

void FilmError::add(const PixelEstimate (&channels_of_pixel)[3], std::uint32_t samples, bool some_dropped) {
  double variance = 0;
  for (const PixelEstimate& e : channels_of_pixel) {
    mean_sum += e.mean;
    square_sum += e.mean * e.mean;
    if (e.known) {
      ++channels;
      variance += e.variance;
      sample_variance_sum += e.variance * samples;
    } else if (!some_dropped) {
      ++pending;
    } else if (samples > 0) {
      ++lost;
      lost_inverse_samples += 1.0 / samples;
    } else {
      ++empty;
    }
  }
  variance_sum += variance;
  variance_square_sum += variance * variance;
}

void FilmError::operator+=(const FilmError& other) {
  mean_sum += other.mean_sum;
  square_sum += other.square_sum;
  channels += other.channels;
  variance_sum += other.variance_sum;
  sample_variance_sum += other.sample_variance_sum;
  variance_square_sum += other.variance_square_sum;
  pending += other.pending;
  lost += other.lost;
  empty += other.empty;
  lost_inverse_samples += other.lost_inverse_samples;
}

RelativeError FilmError::relative() const {
  if (pending > 0 || channels == 0 || !(mean_sum > 0)) return {};
  const auto known = static_cast<double>(channels), all = static_cast<double>(channels + lost + empty);
  // What was lost is taken to be as noisy as the rest of the image, and what is black for want of samples as bright.
  const double squared_error = variance_sum + sample_variance_sum / known * lost_inverse_samples +
                               static_cast<double>(empty) * square_sum / static_cast<double>(channels + lost);
  const double value = std::sqrt(squared_error / all) / (mean_sum / all);
  if (!(variance_square_sum > 0)) return {value, value, value};
  const double factor = error_uncertainty(variance_sum * variance_sum / variance_square_sum);
  return {value, value / factor, value * factor};
}

Film::Film(const FilmSettings& settings, SamplerKind sampler, SceneLayers layers)
    : settings_(settings),
      width_(static_cast<std::uint32_t>(settings.width)),
      height_(static_cast<std::uint32_t>(settings.height)),
      sampler_(sampler),
      layers_(std::move(layers)),
      feature_mask_(feature_mask(settings, layers_)),
      sums_(pixel_count(settings) * radiance_planes(sampler)),
      moments_(layers_.moments.empty() ? 0 : 3 * pixel_count(settings)),
      features_(pixel_count(settings) * static_cast<std::size_t>(std::popcount(feature_mask_))),
      counts_(pixel_count(settings)) {}

FilmView Film::view() {
  FilmView view;
  view.sums = sums_.view();
  view.counts = counts_.data();
  view.moments = moments_.view();
  view.features = features_.view();
  view.feature_mask = feature_mask_;
  view.width = width_;
  view.height = height_;
  view.weighted = settings_.filter.kind != FilterKind::box;
  return view;
}

std::vector<Film::State> Film::state() {
  std::vector<State> state;
  const auto add = [&](const char* name) {
    return [&state, name](auto& array) { state.push_back({name, std::as_writable_bytes(std::span(array))}); };
  };
  add("counts")(counts_);
  sums_.visit(add("sums"));
  moments_.visit(add("moments"));
  features_.visit(add("features"));
  splats_.visit_state(add("splats"));
  std::erase_if(state, [](const State& part) { return part.bytes.empty(); });
  return state;
}

void Film::clear() {
  for (const State& part : state()) std::ranges::fill(part.bytes, std::byte{0});
}

void Film::add(const Film& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    counts_[i] = ((counts_[i] & ~kSomeDropped) + (other.counts_[i] & ~kSomeDropped)) |
                 ((counts_[i] | other.counts_[i]) & kSomeDropped);
  }
  sums_.add(other.sums_);
  moments_.add(other.moments_);
  features_.add(other.features_);
  splats_.add(other.splats_);
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
  for (std::uint32_t r = 0; r < kReplicates; ++r)
    sums[r] = sum(3 * r + c), counts[r] = samples_.count_of_replicate(pixel, n, r);
  PixelEstimate estimate = estimate_from_replicates(sums, counts);
  // Which replicate lost how many is not known any more.
  if ((counts_[pixel] & kSomeDropped) != 0) estimate.known = false;
  return estimate;
}

FilmError Film::error(const FilmRegion& region) const {
  FilmError total;
  for (std::uint32_t y = region.y0; y < region.y0 + region.height; ++y) {
    for (std::uint32_t x = region.x0; x < region.x0 + region.width; ++x) {
      const std::uint64_t pixel = std::uint64_t{y} * width_ + x;
      total.add({estimate(pixel, 0), estimate(pixel, 1), estimate(pixel, 2)}, counts_[pixel] & ~kSomeDropped,
                (counts_[pixel] & kSomeDropped) != 0);
    }
  }
  return total;
}

Image Film::image(bool statistics, std::uint32_t feature_samples) const {
  Image image;
  image.width = static_cast<int>(width_);
  image.height = static_cast<int>(height_);
  image.exr_color = settings_.is_xyz()         ? Image::Color::xyz
                    : settings_.is_luminance() ? Image::Color::luminance
                                               : Image::Color::rgb;
  image.exr_half = settings_.half_precision;
  const std::size_t pixels = counts_.size();
  const auto add = [&](const std::string& name) {
    image.channels.push_back({name, std::vector<float>(pixels)});
    return image.channels.size() - 1;
  };
  std::array<std::size_t, 3> color{}, variance{}, error{}, interval{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = add(kColors[c]);
  std::size_t samples = 0;
  if (statistics) {
    samples = add("samples");
    for (std::size_t c = 0; c < 3; ++c) variance[c] = add(std::string("variance.") + kColors[c]);
    for (std::size_t c = 0; c < 3; ++c) error[c] = add(std::string("error.") + kColors[c]);
    for (std::size_t c = 0; c < 3; ++c) interval[c] = add(std::string("interval.") + kColors[c]);
  }
  if (statistics) {
    for (std::size_t i = 0; i < pixels; ++i) {
      image.channels[samples].values[i] = static_cast<float>(counts_[i] & ~kSomeDropped);
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < pixels; ++i) {
      const PixelEstimate e = estimate(i, static_cast<int>(c));
      image.channels[color[c]].values[i] = static_cast<float>(e.mean);
      if (!statistics) continue;
      const double known = e.known ? e.variance : std::numeric_limits<double>::quiet_NaN();
      image.channels[variance[c]].values[i] = static_cast<float>(known);
      image.channels[error[c]].values[i] = static_cast<float>(std::sqrt(known));
    }
    if (!statistics) continue;
    image.channels[interval[c]].values =
        confidence_intervals(width_, height_, image.channels[variance[c]].values, image.channels[samples].values);
  }
  if (settings_.has_alpha()) add_alpha(image, feature_samples);
  for (const std::string& name : layers_.image_copies) {
    for (const char* channel : {"R", "G", "B", "A"}) {
      if (const Channel* source = image.find(channel)) {
        std::vector<float> values = source->values;
        image.channel(name + "." + channel).values = std::move(values);
      }
    }
  }
  add_moments(image);
  if (feature_samples > 0) add_features(image, feature_samples);
  return image;
}

std::vector<float> Film::feature(Feature feature, std::uint32_t samples) const {
  const std::size_t pixels = counts_.size();
  const auto plane = static_cast<std::size_t>(std::popcount(feature_mask_ & ((1u << feature) - 1)));
  const double scale = (kDiscreteFeatures >> feature & 1u) != 0 ? 1.0 : 1.0 / samples;
  std::vector<float> values(pixels);
  for (std::size_t i = 0; i < pixels; ++i) values[i] = static_cast<float>(features_[plane * pixels + i] * scale);
  return values;
}

void Film::add_features(Image& image, std::uint32_t feature_samples) const {
  for (const FeatureLayer& layer : layers_.features) {
    image.channel(layer.name).values = feature(layer.feature, feature_samples);
  }
}

void Film::add_alpha(Image& image, std::uint32_t feature_samples) const {
  std::vector<float>& alpha = image.channel("A").values;
  if (settings_.opaque) {
    std::ranges::fill(alpha, 1.0f);
  } else if (feature_samples > 0) {
    alpha = feature(kFeatureCoverage, feature_samples);
  }
}

void Film::add_moments(Image& image) const {
  const std::size_t pixels = counts_.size();
  for (const std::string& name : layers_.moments) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::string channel = name + "." + "XYZ"[k];
      std::vector<float> first(pixels), second(pixels);
      for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint32_t n = counts_[i] & ~kSomeDropped;
        for (int c = 0; c < 3; ++c) {
          first[i] += static_cast<float>(kXyzFromSrgb[k][static_cast<std::size_t>(c)] * estimate(i, c).mean);
        }
        if (n > 0) second[i] = static_cast<float>(moments_[k * pixels + i] / n);
      }
      image.channel(channel).values = std::move(first);
      image.channel("m2_" + channel).values = std::move(second);
    }
  }
}

}  // namespace norrsken
