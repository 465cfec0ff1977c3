#include "film/film.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "film/film_image.h"
#include "film/interval.h"
#include "tables/film_memory.h"
#include "tables/wave_types.h"

namespace norrsken {
namespace {

std::size_t pixel_count(const FilmSettings& settings) {
  return static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height);
}

}  // namespace

FilmRegion intersection(const FilmRegion& a, const FilmRegion& b) {
  const std::uint32_t x0 = std::max(a.x0, b.x0), y0 = std::max(a.y0, b.y0);
  const std::uint32_t x1 = std::min(a.x0 + a.width, b.x0 + b.width), y1 = std::min(a.y0 + a.height, b.y0 + b.height);
  return {x0, y0, x1 > x0 ? x1 - x0 : 0, y1 > y0 ? y1 - y0 : 0};
}

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
  of_two_replicates |= other.of_two_replicates;
}

RelativeError FilmError::relative() const {
  if (pending > 0 || channels == 0 || !(mean_sum > 0)) return {};
  const auto known = static_cast<double>(channels), all = static_cast<double>(channels + lost + empty);
  // What was lost is taken to be as noisy as the rest of the image, and what is black for want of samples as bright.
  const double squared_error = variance_sum + sample_variance_sum / known * lost_inverse_samples +
                               static_cast<double>(empty) * square_sum / static_cast<double>(channels + lost);
  const double value = std::sqrt(squared_error / all) / (mean_sum / all);
  if (!(variance_square_sum > 0)) return {value, value, value};
  const double pixels = variance_sum * variance_sum / variance_square_sum;
  const double factor = error_uncertainty(of_two_replicates ? pixels / 2 : pixels);
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

const Neighbors& Film::neighbors() const { return has_two_replicates() ? kNeighborsOfReplicates : kNeighborsOfSamples; }

FilmError Film::error(const FilmRegion& region) const {
  FilmError total;
  total.of_two_replicates = has_two_replicates();
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
  const FilmRegion all{0, 0, width_, height_};
  FilmImage image(*this, all, statistics, feature_samples);
  image.take(all);
  return std::move(image).finish();
}

double Film::feature(Feature feature, std::uint64_t pixel, std::uint32_t samples) const {
  const auto plane = static_cast<std::size_t>(std::popcount(feature_mask_ & ((1u << feature) - 1)));
  const double scale = (kDiscreteFeatures >> feature & 1u) != 0 ? 1.0 : 1.0 / samples;
  return features_[plane * counts_.size() + pixel] * scale;
}

double Film::moment(std::size_t axis, std::uint64_t pixel) const {
  const std::uint32_t n = samples(pixel);
  return n > 0 ? moments_[axis * counts_.size() + pixel] / n : 0;
}

std::uint32_t Film::samples(std::uint64_t pixel) const { return counts_[pixel] & ~kSomeDropped; }

}  // namespace norrsken
