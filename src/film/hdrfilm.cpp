// hdrfilm: the image's size and what becomes of its values.
//
// Parameters
//   width, height     integers, pixels, 1 to 65536 (default 768 x 576), 2^28 pixels in all, and no more
//                     than this machine has memory for, 100 bytes each
//   file_format       openexr (default)
//   pixel_format      rgb (default)
//   component_format  float32 (default)
// Children: rfilter.
// Departures: Mitsuba's default component_format is float16; we always write float32. Its other formats are refused,
// except that float16 and rgba are taken with a warning, because so many scenes ask for them.
#include <fmt/format.h>

#include "base/text.h"
#include "compile/plugins.h"

namespace norrsken {
namespace {

/// Reads a format of which only `written` is written; `tolerated` gets a warning, the rest an error.
void read_format(Parameters& p, const char* name, std::string_view written, std::string_view tolerated) {
  const std::string value = p.text(name, written);
  if (value == written) return;
  std::string message = fmt::format("{} {} is not supported yet", name, quoted(value));
  if (value == tolerated) {
    p.diagnostics().warning(p.where(name), fmt::format("{}: {} is written", message, written), std::string(written));
  } else {
    p.error(name, std::move(message), std::string(written));
  }
}

}  // namespace

FilmSettings compile_film_hdrfilm(Parameters& p, Builder& builder) {
  FilmSettings film;
  film.width = static_cast<int>(p.integer("width", 768, 1, kMaxFilmSide));
  film.height = static_cast<int>(p.integer("height", 576, 1, kMaxFilmSide));
  read_format(p, "file_format", "openexr", "");
  read_format(p, "pixel_format", "rgb", "rgba");
  read_format(p, "component_format", "float32", "float16");
  film.filter = builder.rfilter(p);
  return film;
}

}  // namespace norrsken
