// Stage: finished SLOTS -> the film's sums. What is no finite sample is taken out of the slots on the way.
#pragma once

#include "base/exact_sum.h"
#include "color/srgb.h"
#include "tables/film_view.h"
#include "wave/records.h"

namespace norrsken::NORRSKEN_ISA {

/// Every value of the row finite. On the bits, since a loop over integers is vectorised by any compiler.
NORRSKEN_INLINE bool all_finite(const float* values, std::uint32_t n) {
  std::uint32_t largest = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    std::uint32_t word;
    __builtin_memcpy(&word, values + i, sizeof word);
    word &= 0x7fffffffu;
    largest = largest > word ? largest : word;
  }
  return largest < 0x7f800000u;
}

/// The planes' values from `at` on.
NORRSKEN_INLINE SumPlanes part_of(const SumPlanes& planes, std::size_t at) {
  return {planes.high + at, planes.low + at};
}

NORRSKEN_INLINE void add_row(const SumPlanes& sums, const float* __restrict values, std::uint32_t n) {
  double* __restrict high = sums.high;
  double* __restrict low = sums.low;
  for (std::uint32_t i = 0; i < n; ++i) add_exactly(high[i], low[i], static_cast<double>(values[i]));
}
NORRSKEN_INLINE void add_squares_of_row(const SumPlanes& sums, const float* __restrict values, std::uint32_t n) {
  double* __restrict high = sums.high;
  double* __restrict low = sums.low;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double v = static_cast<double>(values[i]);
    add_exactly(high[i], low[i], rounded_to_24_bits(v * v));
  }
}

/// Takes non-finite samples out of one row of pixels: their radiance becomes zero, their count is taken back.
inline void drop_non_finite(const WaveJob& job, const FilmView& film, Slots& slots, std::uint32_t sample,
                            std::uint32_t slot, std::uint32_t pixel, DroppedSamples& dropped) {
  for (std::uint32_t x = 0; x < job.width; ++x) {
    bool finite = true;
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
      finite = finite && slots.field(&stored::Slot::radiance, channel)[slot + x] * 0.0f == 0.0f;
    }
    if (finite) continue;
    for (std::uint32_t channel = 0; channel < 3; ++channel) {
      slots.field(&stored::Slot::radiance, channel)[slot + x] = 0.0f;
    }
    film.counts[pixel + x] = (film.counts[pixel + x] - 1) | kSomeDropped;
    if (dropped.count < DroppedSamples::kKept) {
      dropped.pixel[dropped.count] = pixel + x;
      dropped.sample[dropped.count] = sample;
    }
    ++dropped.count;
  }
}

/// Adds the second moments of a row's colours, XYZ, as weighted means have them.
inline void add_moments(const FilmView& film, const Slots& slots, std::uint32_t slot, std::uint32_t pixel,
                        std::uint32_t n) {
  const float* rgb[3];
  for (std::uint32_t k = 0; k < 3; ++k) rgb[k] = slots.field(&stored::Slot::radiance, k) + slot;
  // A copy: reading the constant itself by index would emit it in every instruction set's objects.
  constexpr auto kRows = kXyzFromSrgb;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const SumPlanes sums = part_of(film.moments, k * film.pixels() + pixel);
    const ColorVector row = kRows[k];
    for (std::uint32_t i = 0; i < n; ++i) {
      const double v = row[0] * static_cast<double>(rgb[0][i]) + row[1] * static_cast<double>(rgb[1][i]) +
                       row[2] * static_cast<double>(rgb[2][i]);
      const float weight = film.weighted ? slots.field(&stored::Slot::weight)[slot + i] : 1.0f;
      add_exactly(sums.high[i], sums.low[i], rounded_to_24_bits(static_cast<double>(weight) * v * v));
    }
  }
}

/// Applies the weights that the reconstruction filter gave the samples of a row.
NORRSKEN_INLINE void weigh_row(Slots& slots, std::uint32_t slot, std::uint32_t n) {
  const float* weights = slots.field(&stored::Slot::weight) + slot;
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    float* values = slots.field(&stored::Slot::radiance, channel) + slot;
    for (std::uint32_t i = 0; i < n; ++i) values[i] *= weights[i];
  }
}

inline void accumulate_film(const WaveJob& job, SamplerKind sampler, Slots& slots, const FilmView& film,
                            DroppedSamples& dropped) {
  for (std::uint32_t s = 0; s < job.sample_count; ++s) {
    const std::uint32_t sample = job.first_sample + s;
    const std::uint32_t first_plane = sampler == SamplerKind::sobol ? 3 * (sample % kReplicates) : 0;
    for (std::uint32_t y = 0; y < job.height; ++y) {
      const std::uint32_t slot = s * job.pixel_stride() + y * job.width;
      const std::uint32_t pixel = (job.y0 + y) * film.width + job.x0;
      for (std::uint32_t x = 0; x < job.width; ++x) ++film.counts[pixel + x];
      if (!all_finite(slots.field(&stored::Slot::radiance, 0) + slot, job.width) ||
          !all_finite(slots.field(&stored::Slot::radiance, 1) + slot, job.width) ||
          !all_finite(slots.field(&stored::Slot::radiance, 2) + slot, job.width)) {
        drop_non_finite(job, film, slots, sample, slot, pixel, dropped);
      }
      if (film.moments.high != nullptr) add_moments(film, slots, slot, pixel, job.width);
      if (film.weighted) weigh_row(slots, slot, job.width);
      for (std::uint32_t channel = 0; channel < 3; ++channel) {
        const float* values = slots.field(&stored::Slot::radiance, channel) + slot;
        add_row(part_of(film.sums, (first_plane + channel) * film.pixels() + pixel), values, job.width);
        if (sampler == SamplerKind::independent) {
          add_squares_of_row(part_of(film.sums, (3 + channel) * film.pixels() + pixel), values, job.width);
        }
      }
    }
  }
}

/// Adds the features that the film has planes for; of those that have no mean, the pixel's first sample.
inline void accumulate_features(const WaveJob& job, const Slots& slots, const FilmView& film) {
  for (std::uint32_t s = 0; s < job.sample_count; ++s) {
    for (std::uint32_t y = 0; y < job.height; ++y) {
      const std::uint32_t slot = s * job.pixel_stride() + y * job.width;
      const float* weights = slots.field(&stored::Slot::weight) + slot;
      std::size_t at = static_cast<std::size_t>(job.y0 + y) * film.width + job.x0;
      for (std::uint32_t rest = film.feature_mask; rest != 0; rest &= rest - 1, at += film.pixels()) {
        const SumPlanes sums = part_of(film.features, at);
        const auto feature = static_cast<std::uint32_t>(__builtin_ctz(rest));
        const float* values = slots.field(&stored::Slot::features, feature) + slot;
        const bool discrete = (kDiscreteFeatures >> feature & 1u) != 0;
        if (discrete && job.first_sample + s > 0) continue;
        if (film.weighted && !discrete) {
          for (std::uint32_t x = 0; x < job.width; ++x) {
            add_exactly(sums.high[x], sums.low[x], static_cast<double>(weights[x] * values[x]));
          }
        } else {
          add_row(sums, values, job.width);
        }
      }
    }
  }
}

}  // namespace norrsken::NORRSKEN_ISA
