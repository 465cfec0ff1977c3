#include "norrsken/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/memory.h"
#include "base/text.h"
#include "render/checkpoint.h"
#include "tables/film_memory.h"

namespace norrsken {
namespace {

constexpr std::size_t kLongestPath = 4096;

struct Part {
  std::string path;
  std::unique_ptr<RenderReader> reader;

  const StoredRender& stored() const { return reader->stored(); }
  std::string name() const { return quoted(path, kLongestPath); }
};

Film make_film(const FilmForm& form) {
  Film film(form.settings, form.sampler, form.layers);
  if (form.from_lights) film.add_splats(Splats(form.settings, {}));
  return film;
}

std::uint64_t pixels_of(const FilmForm& form) {
  return static_cast<std::uint64_t>(std::int64_t{form.settings.width} * form.settings.height);
}

std::uint64_t film_bytes(const FilmForm& form) {
  return pixels_of(form) * film_bytes_per_pixel(form.settings, form.sampler, form.layers, form.from_lights);
}

/// The sum, what is added to it, and the image.
std::uint64_t merging_bytes(const FilmForm& form) {
  return 2 * film_bytes(form) + pixels_of(form) * image_bytes_per_pixel(form.settings, form.layers);
}

/// Why a file cannot be a part of anything, or nothing.
std::string complaint_about(const Part& part) {
  if (part.reader->state() == SectionReader::State::missing) return "there is no file " + part.name();
  if (part.reader->state() != SectionReader::State::readable) return part.name() + " " + part.reader->complaint();
  const StoredRender& stored = part.stored();
  // Not before the bytes are there: the sums of a film take what the film takes.
  if (film_bytes(stored.form) > part.reader->file_bytes()) {
    return part.name() + " says that its film is larger than the file";
  }
  if (std::ranges::any_of(stored.goal.of_tile, [&](std::uint32_t goal) { return goal != stored.samples.count(); })) {
    return part.name() +
           " is of an adaptive rendering, whose tiles have different numbers of samples: what is merged has "
           "the same number everywhere";
  }
  const auto all = [](const TileProgress& progress, SampleRange range) {
    return std::ranges::all_of(progress, [&](std::uint32_t done) { return done == range.count(); });
  };
  if (stored.progress.empty() || !all(stored.progress, stored.samples) ||
      !all(stored.feature_progress, stored.feature_samples)) {
    return fmt::format("{} is not finished: it lacks some of its samples {} to {}; run its command again", part.name(),
                       stored.samples.first, stored.samples.end - 1);
  }
  return {};
}

/// Why two files, the first of which begins before the other, cannot be added up, or nothing.
std::string complaint_about(const Part& first, const Part& second) {
  const std::string other = difference(second.stored().traits, first.stored().traits);
  if (!other.empty()) return fmt::format("{} is not of the rendering of {}: {}", second.name(), first.name(), other);
  const SampleRange &a = first.stored().samples, &b = second.stored().samples;
  if (b.first >= a.end) return {};
  const std::uint32_t last = std::min(a.end, b.end) - 1;
  return fmt::format("{} and {} both hold {}", first.name(), second.name(),
                     last == b.first ? fmt::format("sample {}", last) : fmt::format("samples {} to {}", b.first, last));
}

}  // namespace

IoStatus merge_renders(const std::vector<std::string>& files, bool layers, MergedRender& result,
                       std::shared_ptr<MemoryBudget> memory) {
  if (files.empty()) return {"there is nothing to merge"};
  std::vector<Part> parts;
  for (const std::string& file : files) {
    parts.push_back({file, std::make_unique<RenderReader>(file)});
    if (std::string complaint = complaint_about(parts.back()); !complaint.empty()) return {std::move(complaint)};
  }
  std::ranges::stable_sort(parts, {}, [](const Part& part) { return part.stored().samples.first; });

  MergedRender merged;
  std::uint32_t end = 0, feature_samples = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) {
      if (std::string complaint = complaint_about(parts[i - 1], parts[i]); !complaint.empty()) {
        return {std::move(complaint)};
      }
    }
    const StoredRender& stored = parts[i].stored();
    if (stored.samples.first > end) merged.gaps.push_back({end, stored.samples.first});
    if (stored.samples.first > end || merged.samples.empty()) merged.samples.push_back(stored.samples);
    end = merged.samples.back().end = stored.samples.end;
    merged.dropped_samples += stored.dropped.count;
    feature_samples += stored.feature_samples.count();
  }

  const FilmForm& form = parts.front().stored().form;
  MemoryReservation films;
  try {
    films = MemoryReservation(merging_bytes(form), memory ? std::move(memory) : MemoryBudget::of_machine());
  } catch (const MemoryExceeded& e) {
    return {fmt::format("films of {} x {} pixels do not fit into memory: {}", form.settings.width, form.settings.height,
                        e.what())};
  }
  Film film = make_film(parts.front().stored().form), part_of_film = make_film(parts.front().stored().form);
  for (const Part& part : parts) {
    if (!part.reader->read_film(part_of_film)) return {part.name() + " " + part.reader->complaint()};
    film.add(part_of_film);
  }
  film.set_samples(SampleSet(merged.samples));
  merged.image = film.image(layers, feature_samples);
  result = std::move(merged);
  return {};
}

}  // namespace norrsken
