// hdrfilm: the image's size, what of it is rendered, and what becomes of its values.
//
// Children: rfilter.
// Departures: Mitsuba's default component_format is float16, ours loses nothing.
#include <string_view>
#include <tuple>
#include <utility>

#include "compile/frame_tools.h"

namespace norrsken {
namespace {

constexpr IntegerParameter kWidth{.name = "width", .fallback = 768, .min = 1, .max = kMaxFilmSide, .unit = "pixels"};
constexpr IntegerParameter kHeight{.name = "height", .fallback = 576, .min = 1, .max = kMaxFilmSide, .unit = "pixels"};
/// Of either side. What is rendered is all of the film if nothing is said.
struct Crop {
  IntegerParameter offset, size;
};
constexpr Crop kCropX{
    {.name = "crop_offset_x",
     .fallback = 0,
     .min = 0,
     .max = 767,
     .text = "the left edge of the rectangle of the film that is rendered, all of it if nothing is said. The rectangle "
             "has at "
             "most 2^28 pixels and no more than there is memory for: 263 bytes each, its image included, 167 with "
             "independent points; 192 more with paths from the lights",
     .unit = "pixels"},
    {.name = "crop_width",
     .fallback = 768,
     .min = 1,
     .max = 768,
     .text = "the rectangle's, up to the film's right edge",
     .unit = "pixels"}};
constexpr Crop kCropY{{.name = "crop_offset_y",
                       .fallback = 0,
                       .min = 0,
                       .max = 575,
                       .text = "the rectangle's upper edge",
                       .unit = "pixels"},
                      {.name = "crop_height",
                       .fallback = 576,
                       .min = 1,
                       .max = 576,
                       .text = "the rectangle's, down to the film's lower edge",
                       .unit = "pixels"}};
constexpr BooleanParameter kSampleBorder{.name = "sample_border",
                                         .text =
                                             "filters of pixels at the border of that rectangle reach beyond it, as "
                                             "those within do; otherwise they are cut off there"};
constexpr BooleanParameter kHighQualityEdges{.name = "high_quality_edges", .text = "an older name of sample_border"};

/// Whether files of this format have no place for what -o writes.
constexpr ChoiceParameter<bool> kFileFormat{
    .name = "file_format",
    .words = {{{"openexr", false}, {"exr", false}, {"rgbe", true}, {"pfm", true}}},
    .text = "without effect, for the name of the output file decides how it is written"};
constexpr ChoiceParameter<PixelFormat> kPixelFormat{
    .name = "pixel_format",
    .words = {{{"rgb", PixelFormat::rgb},
               {"rgba", PixelFormat::rgba},
               {"xyz", PixelFormat::xyz},
               {"xyza", PixelFormat::xyza},
               {"luminance", PixelFormat::luminance},
               {"luminance_alpha", PixelFormat::luminance_alpha}}},
    .text = "the channels of EXR files. Alpha is the share of a pixel in which something is seen"};
enum class Component { float32, float16, uint32 };
constexpr ChoiceParameter<Component> kComponentFormat{
    .name = "component_format",
    .words = {{{"float32", Component::float32}, {"float16", Component::float16}, {"uint32", Component::uint32}}},
    .text =
        "how EXR files hold those channels; uint32 is float32 here, for it holds no radiance; other layers are "
        "float32"};
constexpr BooleanParameter kBanner{.name = "banner", .text = "nothing is drawn over images, so it changes nothing"};

/// The rendered part of one side of the film: its offset and its length.
std::pair<int, int> read_crop(Parameters& p, const Crop& crop, int full) {
  const auto offset = static_cast<int>(p.read(crop.offset.at_most(full - 1)));
  return {offset, static_cast<int>(p.read(crop.size.or_else(full - offset).at_most(full - offset)))};
}

bool read_sample_border(Parameters& p) {
  const bool sample_border = p.read(kSampleBorder);
  const bool high_quality_edges = p.read(kHighQualityEdges.or_else(sample_border));
  if (p.has(kSampleBorder.name) && high_quality_edges != sample_border) {
    p.error(kHighQualityEdges.name, "'high_quality_edges' says the contrary of 'sample_border'", "one of them");
  }
  return high_quality_edges;
}

}  // namespace

FilmSettings compile_film_hdrfilm(Parameters& p, Films& films) {
  FilmSettings film;
  film.full_width = static_cast<int>(p.read(kWidth));
  film.full_height = static_cast<int>(p.read(kHeight));
  std::tie(film.crop_x, film.width) = read_crop(p, kCropX, film.full_width);
  std::tie(film.crop_y, film.height) = read_crop(p, kCropY, film.full_height);
  film.sample_border = read_sample_border(p);
  if (p.read(kFileFormat)) {
    p.diagnostics().note(p.where(kFileFormat.name),
                         "'file_format' has no effect here (instead: -o FILE.exr, FILE.png or FILE.jpg)");
  }
  film.pixel_format = p.read(kPixelFormat);
  const Component component = p.read(kComponentFormat);
  film.half_precision = component == Component::float16;
  if (component == Component::uint32) {
    p.diagnostics().note(p.where(kComponentFormat.name),
                         "'component_format' is float32 here, for uint32 holds no radiance");
  }
  p.read(kBanner);
  film.filter = films.rfilter(p);
  return film;
}

}  // namespace norrsken
