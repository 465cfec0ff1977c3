// hdrfilm: the image's size, what of it is rendered, and what becomes of its values.
//
// Parameters
//   width, height     integers, pixels, 1 to 65536 (default 768 x 576)
//   crop_offset_x, crop_offset_y, crop_width, crop_height
//                     integers, pixels (default: all of the film): the rectangle of the film that is rendered; it has at
//                     most 2^28 pixels and no more than there is memory for: 263 bytes each, its image included, 167 with
//                     independent points; 192 more with paths from the lights
//   sample_border     boolean (default false): filters of pixels at the border of that rectangle reach beyond it, as
//                     those within do; otherwise they are cut off there
//   high_quality_edges  an older name of sample_border
//   file_format       openexr (default), exr, rgbe or pfm: without effect, for the name of the output file decides how it
//                     is written
//   pixel_format      luminance, luminance_alpha, rgb (default), rgba, xyz or xyza: the channels of EXR files. Alpha is
//                     the share of a pixel in which something is seen.
//   component_format  float32 (default), float16 or uint32, which is float32 here, for it holds no radiance: how EXR files
//                     hold those channels; other layers are float32
//   banner            boolean: nothing is drawn over images, so it changes nothing
// Children: rfilter.
// Departures: Mitsuba's default component_format is float16, ours loses nothing.
#include <fmt/format.h>

#include <span>
#include <tuple>
#include <utility>

#include "base/text.h"
#include "compile/plugins.h"

namespace norrsken {
namespace {

/// One of a list that begins with the default.
template <class Format>
Format read_format(Parameters& p, const char* name, std::span<const std::pair<const char*, Format>> known) {
  const std::string value = p.text(name, known.front().first);
  std::string accepted;
  for (const auto& [word, format] : known) {
    if (equal_ignoring_case(value, word)) return format;
    accepted += (accepted.empty() ? "" : ", ") + std::string(word);
  }
  p.error(name, fmt::format("{} {} is not supported", name, quoted(value)), accepted);
  return known.front().second;
}

constexpr std::pair<const char*, PixelFormat> kPixelFormats[] = {{"rgb", PixelFormat::rgb},
                                                                 {"rgba", PixelFormat::rgba},
                                                                 {"xyz", PixelFormat::xyz},
                                                                 {"xyza", PixelFormat::xyza},
                                                                 {"luminance", PixelFormat::luminance},
                                                                 {"luminance_alpha", PixelFormat::luminance_alpha}};
enum class Component { float32, float16, uint32 };
constexpr std::pair<const char*, Component> kComponentFormats[] = {
    {"float32", Component::float32}, {"float16", Component::float16}, {"uint32", Component::uint32}};
/// Whether files of this format have no place for what -o writes.
constexpr std::pair<const char*, bool> kFileFormats[] = {
    {"openexr", false}, {"exr", false}, {"rgbe", true}, {"pfm", true}};

/// The rendered part of one side of the film: its offset and its length.
std::pair<int, int> read_crop(Parameters& p, const char* offset_name, const char* size_name, int full) {
  const auto offset = static_cast<int>(p.integer(offset_name, 0, 0, full - 1));
  return {offset, static_cast<int>(p.integer(size_name, full - offset, 1, full - offset))};
}

bool read_sample_border(Parameters& p) {
  const bool sample_border = p.boolean("sample_border", false);
  const bool high_quality_edges = p.boolean("high_quality_edges", sample_border);
  if (p.has("sample_border") && high_quality_edges != sample_border) {
    p.error("high_quality_edges", "'high_quality_edges' says the contrary of 'sample_border'", "one of them");
  }
  return high_quality_edges;
}

}  // namespace

FilmSettings compile_film_hdrfilm(Parameters& p, Builder& builder) {
  FilmSettings film;
  film.full_width = static_cast<int>(p.integer("width", 768, 1, kMaxFilmSide));
  film.full_height = static_cast<int>(p.integer("height", 576, 1, kMaxFilmSide));
  std::tie(film.crop_x, film.width) = read_crop(p, "crop_offset_x", "crop_width", film.full_width);
  std::tie(film.crop_y, film.height) = read_crop(p, "crop_offset_y", "crop_height", film.full_height);
  film.sample_border = read_sample_border(p);
  if (read_format<bool>(p, "file_format", kFileFormats)) {
    p.diagnostics().note(p.where("file_format"),
                         "'file_format' has no effect here (instead: -o FILE.exr, FILE.png or FILE.jpg)");
  }
  film.pixel_format = read_format<PixelFormat>(p, "pixel_format", kPixelFormats);
  const Component component = read_format<Component>(p, "component_format", kComponentFormats);
  film.half_precision = component == Component::float16;
  if (component == Component::uint32) {
    p.diagnostics().note(p.where("component_format"),
                         "'component_format' is float32 here, for uint32 holds no radiance");
  }
  p.boolean("banner", false);
  film.filter = builder.rfilter(p);
  return film;
}

}  // namespace norrsken
