#include "norrsken/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
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

/// Tiles along the sides of the image.
std::uint64_t columns_of(const StoredRender& stored) {
  return (static_cast<std::uint64_t>(stored.form.settings.width) + stored.tile_width - 1) / stored.tile_width;
}
std::uint64_t rows_of(const StoredRender& stored) {
  return (static_cast<std::uint64_t>(stored.form.settings.height) + stored.tile_height - 1) / stored.tile_height;
}

/// Whether every tile's progress is there and within what the file says that it holds.
bool is_possible(const StoredRender& stored) {
  if (stored.tile_width == 0 || stored.tile_height == 0) return false;
  const std::uint64_t tiles = columns_of(stored) * rows_of(stored);
  if (stored.progress.size() != tiles || stored.goal.of_tile.size() != tiles) return false;
  for (std::size_t i = 0; i < tiles; ++i) {
    if (stored.progress[i] > stored.samples.count() || stored.goal.of_tile[i] > stored.samples.count()) return false;
  }
  return true;
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
  if (!is_possible(stored)) return part.name() + " says that it has come to where it cannot be";
  const bool has_features = std::ranges::all_of(
      stored.feature_progress, [&](std::uint32_t done) { return done == stored.feature_samples.count(); });
  if (!has_features || std::ranges::all_of(stored.progress, [](std::uint32_t done) { return done == 0; })) {
    return part.name() + " holds no image yet; run its command again";
  }
  return {};
}

/// Pixels of one tile, which are fewer at the right and lower edges.
std::uint64_t pixels_of_tile(const StoredRender& stored, std::uint64_t tile) {
  const auto side = [](std::uint64_t index, std::uint64_t tile_side, int image_side) {
    return std::min(tile_side, static_cast<std::uint64_t>(image_side) - index * tile_side);
  };
  return side(tile % columns_of(stored), stored.tile_width, stored.form.settings.width) *
         side(tile / columns_of(stored), stored.tile_height, stored.form.settings.height);
}

/// The mean over the image.
double samples_per_pixel(const StoredRender& stored) {
  double sum = 0;
  for (std::size_t i = 0; i < stored.progress.size(); ++i)
    sum += static_cast<double>(stored.progress[i]) * static_cast<double>(pixels_of_tile(stored, i));
  return sum / static_cast<double>(pixels_of(stored.form));
}

std::uint64_t pixels_without_samples(const std::vector<Part>& parts) {
  const StoredRender& first = parts.front().stored();
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < first.progress.size(); ++i) {
    const bool none = std::ranges::all_of(parts, [&](const Part& part) { return part.stored().progress[i] == 0; });
    if (none) count += pixels_of_tile(first, i);
  }
  return count;
}

/// Which samples the film of all parts has, in every pixel.
SampleSet sample_set(const std::vector<Part>& parts) {
  const StoredRender& first = parts.front().stored();
  SampleSet::Tiles tiles{first.tile_width,
                         first.tile_height,
                         static_cast<std::uint32_t>(columns_of(first)),
                         static_cast<std::uint32_t>(first.form.settings.width),
                         {}};
  std::vector<SampleRange> ranges;
  for (const Part& part : parts) {
    ranges.push_back(part.stored().samples);
    tiles.done.push_back(part.stored().progress);
  }
  return {std::move(ranges), std::move(tiles)};
}

/// Why two files, the first of which begins before the other, cannot be added up, or nothing.
std::string complaint_about(const Part& first, const Part& second) {
  const std::string other = difference(second.stored().traits, first.stored().traits);
  if (!other.empty()) return fmt::format("{} is not of the rendering of {}: {}", second.name(), first.name(), other);
  const StoredRender &one = first.stored(), &two = second.stored();
  if (one.tile_width != two.tile_width || one.tile_height != two.tile_height ||
      one.progress.size() != two.progress.size()) {
    return first.name() + " and " + second.name() + " are of programs that cut images into different tiles";
  }
  const SampleRange &a = first.stored().samples, &b = second.stored().samples;
  if (b.first >= a.end) return {};
  const std::uint32_t last = std::min(a.end, b.end) - 1;
  return fmt::format("{} and {} both hold {}", first.name(), second.name(),
                     last == b.first ? fmt::format("sample {}", last) : fmt::format("samples {} to {}", b.first, last));
}

}  // namespace

Result<MergedRender> merge_renders(const std::vector<std::string>& files, bool layers,
                                   std::shared_ptr<MemoryBudget> memory) {
  using Failed = Result<MergedRender>;
  if (files.empty()) return Failed::failure("there is nothing to merge");
  std::vector<Part> parts;
  for (const std::string& file : files) {
    parts.push_back({file, std::make_unique<RenderReader>(file)});
    if (std::string complaint = complaint_about(parts.back()); !complaint.empty())
      return Failed::failure(std::move(complaint));
  }
  std::ranges::stable_sort(parts, {}, [](const Part& part) { return part.stored().samples.first; });

  MergedRender merged;
  Provenance made = parts.front().stored().made;
  made.seconds = 0;
  std::uint32_t end = 0, feature_samples = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) {
      if (std::string complaint = complaint_about(parts[i - 1], parts[i]); !complaint.empty()) {
        return Failed::failure(std::move(complaint));
      }
    }
    const StoredRender& stored = parts[i].stored();
    if (stored.samples.first > end) merged.gaps.push_back({end, stored.samples.first});
    if (stored.samples.first > end || merged.samples.empty()) merged.samples.push_back(stored.samples);
    end = merged.samples.back().end = stored.samples.end;
    made.seconds += stored.made.seconds;
    merged.dropped_samples += stored.dropped.count;
    feature_samples += stored.feature_samples.count();
    const double mean = samples_per_pixel(stored);
    merged.samples_per_pixel += mean;
    const bool is_finished = std::ranges::equal(stored.progress, stored.goal.of_tile, std::ranges::greater_equal());
    if (!is_finished) merged.unfinished.push_back({parts[i].path, mean, stored.goal.mean});
  }
  merged.pixels_without_samples = pixels_without_samples(parts);

  const FilmForm& form = parts.front().stored().form;
  MemoryReservation films;
  try {
    films = MemoryReservation(merging_bytes(form), memory ? std::move(memory) : MemoryBudget::of_machine());
  } catch (const MemoryExceeded& e) {
    return Failed::failure(fmt::format("films of {} x {} pixels do not fit into memory: {}", form.settings.width,
                                       form.settings.height, e.what()));
  }
  Film film = make_film(parts.front().stored().form), part_of_film = make_film(parts.front().stored().form);
  for (const Part& part : parts) {
    if (!part.reader->read_film(part_of_film)) return Failed::failure(part.name() + " " + part.reader->complaint());
    film.add(part_of_film);
  }
  film.set_samples(sample_set(parts));
  merged.image = film.image(layers, feature_samples);
  merged.error = film.error({0, 0, film.width(), film.height()}).relative();
  const bool is_whole = merged.unfinished.empty();
  merged.image.metadata =
      metadata_of(made, {merged.samples_per_pixel, is_whole ? merged.samples : std::vector<SampleRange>{}, merged.error,
                         merged.dropped_samples, !is_whole});
  return merged;
}

bool is_checkpoint(const std::string& path) {
  const SectionReader::State state = identity_of_render(path).state;
  return state == SectionReader::State::readable || state == SectionReader::State::other_version ||
         state == SectionReader::State::damaged;
}

}  // namespace norrsken
