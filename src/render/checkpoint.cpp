#include "render/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <type_traits>

#include "base/text.h"

namespace norrsken {
namespace {

/// Of the sections' contents; another one says that the file is of another program.
constexpr std::uint32_t kFormatVersion = 4;

constexpr std::uint64_t kLongestTraits = 1 << 20, kLongestForm = 1 << 20, kLongestProvenance = 1 << 24;
constexpr double kTicksPerSecond = 1e6;
constexpr std::uint32_t kLargestSide = 65536;

class Writer {
 public:
  template <class T>
  void number(T value) {
    static_assert(std::is_integral_v<T>);
    append(&value, sizeof value);
  }
  void text(const std::string& value) {
    number(static_cast<std::uint32_t>(value.size()));
    append(value.data(), value.size());
  }
  template <class List, class WriteItem>
  void list(const List& items, const WriteItem& write_item) {
    number(static_cast<std::uint32_t>(items.size()));
    for (const auto& item : items) write_item(item);
  }
  std::span<const std::byte> bytes() const { return std::as_bytes(std::span(bytes_)); }

 private:
  void append(const void* source, std::size_t count) { bytes_.append(static_cast<const char*>(source), count); }

  std::string bytes_;
};

/// Reads what a Writer wrote. Behind the end there are zeros, and `good` is false.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  void number(T& value) {
    value = {};
    if (!has(sizeof value)) return;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
  }
  template <class Enum>
  void one_of(Enum& value, Enum last) {
    std::underlying_type_t<Enum> number_of{};
    number(number_of);
    good_ = good_ && number_of <= static_cast<std::underlying_type_t<Enum>>(last);
    value = good_ ? static_cast<Enum>(number_of) : Enum{};
  }
  void flag(bool& value) {
    std::uint8_t byte = 0;
    number(byte);
    value = byte != 0;
  }
  void text(std::string& value) {
    std::uint32_t size = 0;
    number(size);
    if (!has(size)) return;
    value.assign(reinterpret_cast<const char*>(bytes_.data()), size);
    bytes_ = bytes_.subspan(size);
  }
  /// As many items as are really there.
  template <class ReadItem>
  void list(const ReadItem& read_item) {
    std::uint32_t count = 0;
    number(count);
    for (std::uint32_t i = 0; i < count && good_; ++i) read_item();
  }
  bool good() const { return good_; }
  bool at_end() const { return good_ && bytes_.empty(); }

 private:
  bool has(std::size_t count) { return good_ = good_ && count <= bytes_.size(); }

  std::span<const std::byte> bytes_;
  bool good_ = true;
};

Writer pack(const Traits& traits) {
  Writer w;
  w.list(traits, [&](const Trait& trait) {
    w.text(trait.name);
    w.text(trait.value);
    w.number(static_cast<std::uint8_t>(trait.is_fingerprint));
  });
  return w;
}

bool unpack(std::span<const std::byte> bytes, Traits& traits) {
  Reader r(bytes);
  r.list([&] {
    Trait& trait = traits.emplace_back();
    r.text(trait.name);
    r.text(trait.value);
    r.flag(trait.is_fingerprint);
  });
  return r.at_end();
}

Writer pack(const FilmForm& form) {
  Writer w;
  w.number(form.settings.width);
  w.number(form.settings.height);
  w.number(static_cast<std::uint32_t>(form.settings.pixel_format));
  w.number(static_cast<std::uint8_t>(form.settings.half_precision));
  w.number(static_cast<std::uint8_t>(form.settings.opaque));
  w.number(static_cast<std::uint32_t>(form.sampler));
  w.number(static_cast<std::uint8_t>(form.from_lights));
  w.list(form.layers.features, [&](const FeatureLayer& layer) {
    w.text(layer.name);
    w.number(static_cast<std::uint32_t>(layer.feature));
  });
  w.list(form.layers.image_copies, [&](const std::string& name) { w.text(name); });
  w.list(form.layers.moments, [&](const std::string& name) { w.text(name); });
  return w;
}

bool unpack(std::span<const std::byte> bytes, FilmForm& form) {
  Reader r(bytes);
  r.number(form.settings.width);
  r.number(form.settings.height);
  r.one_of(form.settings.pixel_format, PixelFormat::luminance_alpha);
  r.flag(form.settings.half_precision);
  r.flag(form.settings.opaque);
  r.one_of(form.sampler, SamplerKind::sobol);
  r.flag(form.from_lights);
  r.list([&] {
    FeatureLayer& layer = form.layers.features.emplace_back();
    r.text(layer.name);
    r.one_of(layer.feature, static_cast<Feature>(kFeatureCount - 1));
  });
  r.list([&] { r.text(form.layers.image_copies.emplace_back()); });
  r.list([&] { r.text(form.layers.moments.emplace_back()); });
  const auto is_side = [](int side) { return side >= 1 && side <= static_cast<int>(kLargestSide); };
  return r.at_end() && is_side(form.settings.width) && is_side(form.settings.height);
}

Writer pack(const Provenance& made) {
  Writer w;
  w.list(made.settings, [&](const auto& setting) {
    w.text(setting.first);
    w.text(setting.second);
  });
  w.number(static_cast<std::uint64_t>(std::max(made.seconds, 0.0) * kTicksPerSecond));
  return w;
}

bool unpack(std::span<const std::byte> bytes, Provenance& made) {
  Reader r(bytes);
  r.list([&] {
    std::string name, text;
    r.text(name);
    r.text(text);
    made.settings[printable(name)] = printable(text);
  });
  std::uint64_t ticks = 0;
  r.number(ticks);
  made.seconds = static_cast<double>(ticks) / kTicksPerSecond;
  return r.at_end();
}

Writer pack(const Work& work) {
  Writer w;
  for (const SampleRange& range : {work.samples, work.feature_samples}) {
    w.number(range.first);
    w.number(range.end);
  }
  w.number(work.grid.tile_width);
  w.number(work.grid.tile_height);
  w.number(work.goal.mean);
  w.number(static_cast<std::uint8_t>(work.goal.is_step));
  for (const TileProgress* progress : {&work.goal.of_tile, &work.progress, &work.feature_progress}) {
    w.list(*progress, [&](std::uint32_t done) { w.number(done); });
  }
  w.number(work.dropped.count);
  for (std::uint32_t i = 0; i < DroppedSamples::kKept; ++i) {
    w.number(work.dropped.pixel[i]);
    w.number(work.dropped.sample[i]);
  }
  return w;
}

bool unpack(std::span<const std::byte> bytes, StoredRender& stored) {
  Reader r(bytes);
  const auto range = [&r] {
    std::uint32_t first = 0, end = 0;
    r.number(first);
    r.number(end);
    return SampleRange{first, end};
  };
  stored.samples = range();
  stored.feature_samples = range();
  if (stored.samples.end < stored.samples.first || stored.feature_samples.end < stored.feature_samples.first) {
    return false;
  }
  r.number(stored.tile_width);
  r.number(stored.tile_height);
  r.number(stored.goal.mean);
  r.flag(stored.goal.is_step);
  for (TileProgress* progress : {&stored.goal.of_tile, &stored.progress, &stored.feature_progress}) {
    r.list([&] { r.number(progress->emplace_back()); });
  }
  r.number(stored.dropped.count);
  const auto pixels =
      static_cast<std::uint64_t>(std::int64_t{stored.form.settings.width} * stored.form.settings.height);
  for (std::uint32_t i = 0; i < DroppedSamples::kKept; ++i) {
    r.number(stored.dropped.pixel[i]);
    r.number(stored.dropped.sample[i]);
    if (stored.dropped.pixel[i] >= pixels) return false;
  }
  return r.at_end();
}

/// A tile's progress has four bytes.
std::uint64_t longest_progress(const FilmSettings& film) {
  return 3 * sizeof(std::uint32_t) * static_cast<std::uint64_t>(std::int64_t{film.width} * film.height) + 4096;
}

SourceLocation place(const std::string& path) {
  SourceLocation location;
  location.file = path;
  return location;
}

}  // namespace

IoStatus save_render(const std::string& path, const Traits& traits, const FilmForm& form, const Provenance& made,
                     const Work& work, Film& film, OlderGeneration older) {
  const Writer packed_traits = pack(traits), packed_form = pack(form), packed_made = pack(made),
               packed_work = pack(work);
  std::vector<Section> sections = {{"traits", packed_traits.bytes()},
                                   {"form", packed_form.bytes()},
                                   {"made", packed_made.bytes()},
                                   {"progress", packed_work.bytes()}};
  for (const Film::State& state : film.state()) sections.push_back({state.name, state.bytes});
  return write_sections(path, kFormatVersion, sections, older);
}

SectionFileIdentity identity_of_render(const std::string& path) { return identity_of(path, kFormatVersion); }

RenderReader::RenderReader(const std::string& path) : reader_(path, kFormatVersion) {
  std::vector<std::byte> bytes;
  const auto section = [&](const char* name, std::uint64_t most_bytes, auto& value) {
    if (!reader_.read(name, bytes, most_bytes)) return false;
    return unpack(bytes, value) || reader_.distrust(fmt::format("says what cannot be in section '{}'", name));
  };
  if (section("traits", kLongestTraits, stored_.traits) && section("form", kLongestForm, stored_.form) &&
      section("made", kLongestProvenance, stored_.made)) {
    section("progress", longest_progress(stored_.form.settings), stored_);
  }
}

bool RenderReader::read_film(Film& film) {
  bool good = reader_.state() == SectionReader::State::readable;
  for (const Film::State& state : film.state()) good = good && reader_.read(state.name, state.bytes);
  if (good && !reader_.at_end()) good = reader_.distrust("has a section that is not expected");
  if (!good) film.clear();
  return good;
}

namespace {

enum class Attempt { resumed, missing, damaged, refused };

/// Why what is stored cannot become what is asked for, and what could, or nothing.
std::pair<std::string, std::string> objection(const StoredRender& stored, const Traits& traits,
                                              const SampleSchedule& schedule, const Work& work) {
  constexpr const char* kRemedy = "the settings and files that it was made with, or another checkpoint";
  if (const std::string other = difference(stored.traits, traits); !other.empty()) {
    return {"is of another rendering: " + other, kRemedy};
  }
  if (stored.samples.first != work.samples.first) {
    return {fmt::format("begins with sample {}, not {}", stored.samples.first, work.samples.first), kRemedy};
  }
  if (stored.tile_width != work.grid.tile_width || stored.tile_height != work.grid.tile_height) {
    return {"is of a program that cuts images into other tiles", "another checkpoint"};
  }
  std::uint32_t most = 0;
  for (const std::uint32_t done : stored.progress) most = std::max(most, done);
  if (!schedule.resume(work.grid, stored.goal, stored.progress)) {
    return {fmt::format("holds {} samples per pixel, more than the {} asked for", most, schedule.most()),
            fmt::format("{} or more", most)};
  }
  return {};
}

Attempt attempt(const std::string& path, const Traits& traits, const SampleSchedule& schedule, Work& work, Film& film,
                double& seconds, std::string& damage, Diagnostics& diagnostics) {
  RenderReader reader(path);
  using State = SectionReader::State;
  damage = reader.complaint();
  switch (reader.state()) {
    case State::readable:
      break;
    case State::missing:
      return Attempt::missing;
    case State::damaged:
    case State::foreign:
      return Attempt::damaged;
    case State::unreadable:
    case State::other_version:
      diagnostics.error(place(path), "the checkpoint " + damage);
      return Attempt::refused;
  }
  const StoredRender& stored = reader.stored();
  if (const auto [message, accepted] = objection(stored, traits, schedule, work); !message.empty()) {
    diagnostics.error(place(path), "the checkpoint " + message, accepted);
    return Attempt::refused;
  }
  // Features of more samples than asked for are as good.
  if (!work.feature_progress.empty() && stored.feature_samples.count() > work.feature_samples.count()) {
    work.feature_samples = stored.feature_samples;
  }
  const SampleGoal goal = schedule.resume(work.grid, stored.goal, stored.progress).value();
  const SampleRange samples{work.samples.first, work.samples.first + goal.most()};
  const TileProgress features = SampleGoal::uniform(work.grid, work.feature_samples.count(), false).of_tile;
  const bool fits =
      is_possible(work.grid, samples, goal.of_tile, stored.progress) &&
      (work.feature_progress.empty() ? stored.feature_progress.empty()
                                     : is_possible(work.grid, work.feature_samples, features, stored.feature_progress));
  if (!fits || !reader.read_film(film)) {
    damage = fits ? reader.complaint() : "says that it has come to where it cannot be";
    return Attempt::damaged;
  }
  work.set_goal(goal);
  work.progress = stored.progress;
  work.feature_progress = stored.feature_progress;
  work.dropped = stored.dropped;
  seconds = stored.made.seconds;
  return Attempt::resumed;
}

}  // namespace

Resumption resume_render(const std::string& path, const Traits& traits, const SampleSchedule& schedule, Work& work,
                         Film& film, double& seconds, Diagnostics& diagnostics) {
  const std::string older = older_generation_of(path);
  std::string damage, older_damage;
  const Attempt newest = attempt(path, traits, schedule, work, film, seconds, damage, diagnostics);
  switch (newest) {
    case Attempt::resumed:
      return Resumption::newest;
    case Attempt::refused:
      return Resumption::refused;
    case Attempt::missing:
      damage = "is missing";
      break;
    case Attempt::damaged:
      break;
  }
  switch (attempt(older, traits, schedule, work, film, seconds, older_damage, diagnostics)) {
    case Attempt::resumed:
      diagnostics.warning(place(path), "the checkpoint " + damage + "; going on with the older " + quoted(older));
      return Resumption::older;
    case Attempt::refused:
      return Resumption::refused;
    case Attempt::missing:
      if (newest == Attempt::missing) return Resumption::none;
      diagnostics.error(place(path), "the checkpoint " + damage + ", and there is no older one",
                        "an intact checkpoint, or none: remove the file to begin anew");
      return Resumption::refused;
    case Attempt::damaged:
      diagnostics.error(place(path), "the checkpoint " + damage + "; the older " + quoted(older) + " " + older_damage,
                        "an intact checkpoint, or none: remove both to begin anew");
      return Resumption::refused;
  }
  return Resumption::refused;
}

}  // namespace norrsken
