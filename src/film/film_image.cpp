#include "film/film_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "color/srgb.h"
#include "film/interval.h"

namespace norrsken {
namespace {

constexpr const char* kColors[3] = {"R", "G", "B"};

FilmRegion grown(const FilmRegion& region, std::uint32_t margin, std::uint32_t width, std::uint32_t height) {
  const std::uint32_t x0 = region.x0 - std::min(margin, region.x0), y0 = region.y0 - std::min(margin, region.y0);
  const std::uint32_t x1 = std::min(region.x0 + region.width + margin, width),
                      y1 = std::min(region.y0 + region.height + margin, height);
  return {x0, y0, x1 - x0, y1 - y0};
}

}  // namespace

FilmImage::FilmImage(const Film& film, const FilmRegion& region, bool statistics, std::uint32_t feature_samples)
    : film_(film),
      region_(region),
      needed_(statistics ? grown(region, film.neighbors().reach, film.width(), film.height()) : region),
      statistics_(statistics),
      feature_samples_(feature_samples) {
  const FilmSettings& settings = film.settings();
  image_.width = static_cast<int>(needed_.width);
  image_.height = static_cast<int>(needed_.height);
  image_.exr_color = settings.is_xyz()         ? Image::Color::xyz
                     : settings.is_luminance() ? Image::Color::luminance
                                               : Image::Color::rgb;
  image_.exr_half = settings.half_precision;
  for (std::size_t c = 0; c < 3; ++c) color_[c] = add(kColors[c]);
  if (statistics) {
    samples_ = add("samples");
    for (std::size_t c = 0; c < 3; ++c) variance_[c] = add(std::string("variance.") + kColors[c]);
    for (std::size_t c = 0; c < 3; ++c) error_[c] = add(std::string("error.") + kColors[c]);
    for (std::size_t c = 0; c < 3; ++c) interval_[c] = add(std::string("interval.") + kColors[c]);
  }
  if (settings.has_alpha()) {
    alpha_ = add("A");
    if (settings.opaque) std::ranges::fill(image_.channels[alpha_].values, 1.0f);
  }
  for (const std::string& name : film.layers().image_copies) {
    for (const char* channel : {"R", "G", "B", "A"}) {
      const Channel* source = image_.find(channel);
      if (source == nullptr) continue;
      const auto from = static_cast<std::size_t>(source - image_.channels.data());
      copies_.emplace_back(from, add(name + "." + channel));
    }
  }
  for (const std::string& name : film.layers().moments) {
    for (const char axis : {'X', 'Y', 'Z'}) {
      moments_.push_back(add(name + "." + axis));
      moments_.push_back(add("m2_" + name + "." + axis));
    }
  }
  if (feature_samples == 0) return;
  for (const FeatureLayer& layer : film.layers().features) features_.push_back(add(layer.name));
}

/// A channel of that name may be there.
std::size_t FilmImage::add(const std::string& name) {
  return static_cast<std::size_t>(&image_.channel(name) - image_.channels.data());
}

void FilmImage::take(const FilmRegion& part) {
  const FilmRegion wanted = intersection(part, needed_);
  for (std::uint32_t y = wanted.y0; y < wanted.y0 + wanted.height; ++y) {
    for (std::uint32_t x = wanted.x0; x < wanted.x0 + wanted.width; ++x) {
      take_pixel(std::uint64_t{y} * film_.width() + x, std::size_t{y - needed_.y0} * needed_.width + (x - needed_.x0));
    }
  }
}

void FilmImage::take_pixel(std::uint64_t pixel, std::size_t to) {
  const auto put = [&](std::size_t channel, double value) {
    image_.channels[channel].values[to] = static_cast<float>(value);
  };
  if (statistics_) put(samples_, film_.samples(pixel));
  double means[3];
  for (std::size_t c = 0; c < 3; ++c) {
    const PixelEstimate e = film_.estimate(pixel, static_cast<int>(c));
    means[c] = e.mean;
    put(color_[c], e.mean);
    if (!statistics_) continue;
    const double known = e.known ? e.variance : std::numeric_limits<double>::quiet_NaN();
    put(variance_[c], known);
    put(error_[c], std::sqrt(known));
  }
  const FilmSettings& settings = film_.settings();
  if (settings.has_alpha() && !settings.opaque && feature_samples_ > 0)
    put(alpha_, film_.feature(kFeatureCoverage, pixel, feature_samples_));
  for (std::size_t i = 0; i < moments_.size(); i += 2) {
    const std::size_t k = i / 2 % 3;
    float first = 0;
    for (std::size_t c = 0; c < 3; ++c) first += static_cast<float>(kXyzFromSrgb[k][c] * means[c]);
    image_.channels[moments_[i]].values[to] = first;
    put(moments_[i + 1], film_.moment(k, pixel));
  }
  for (std::size_t i = 0; i < features_.size(); ++i)
    put(features_[i], film_.feature(film_.layers().features[i].feature, pixel, feature_samples_));
}

void FilmImage::crop() {
  const std::size_t dx = region_.x0 - needed_.x0, dy = region_.y0 - needed_.y0;
  for (Channel& channel : image_.channels) {
    std::vector<float> values(std::size_t{region_.width} * region_.height);
    for (std::size_t y = 0; y < region_.height; ++y) {
      std::copy_n(channel.values.begin() + static_cast<std::ptrdiff_t>((y + dy) * needed_.width + dx), region_.width,
                  values.begin() + static_cast<std::ptrdiff_t>(y * region_.width));
    }
    channel.values = std::move(values);
  }
  image_.width = static_cast<int>(region_.width);
  image_.height = static_cast<int>(region_.height);
}

Image FilmImage::finish() && {
  for (std::size_t c = 0; statistics_ && c < 3; ++c) {
    image_.channels[interval_[c]].values =
        confidence_intervals(needed_.width, needed_.height, image_.channels[variance_[c]].values,
                             image_.channels[samples_].values, film_.neighbors());
  }
  for (const auto& [from, to] : copies_) image_.channels[to].values = image_.channels[from].values;
  if (needed_.width != region_.width || needed_.height != region_.height) crop();
  return std::move(image_);
}

}  // namespace norrsken
