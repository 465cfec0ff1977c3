// has_image_header and read_image_header of include/norrsken/image.h.
#include <unistd.h>

#include <cerrno>
#include <optional>

#include "base/regular_file.h"
#include "base/text.h"
#include "image/exr.h"
#include "image/exr_header.h"
#include "image/raster_image.h"
#include "norrsken/image.h"

namespace norrsken {
namespace {

constexpr std::size_t kLongestHeader = std::size_t{4} << 20;
constexpr std::size_t kLongestPath = 4096;

/// The first bytes of a regular file, or nothing with `error` set.
std::optional<std::string> read_begin(const std::string& path, std::size_t most, std::string& error) {
  const RegularFile file = open_regular_file(path);
  error = file.error;
  if (!file.descriptor) return std::nullopt;
  std::string begin(most, '\0');
  std::size_t size = 0;
  while (size < most) {
    const ssize_t count = ::read(file.descriptor.get(), begin.data() + size, most - size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    size += static_cast<std::size_t>(count);
  }
  begin.resize(size);
  return begin;
}

}  // namespace

bool has_image_header(const std::string& path) {
  constexpr std::size_t kLongestMagic = 8;
  std::string error;
  const auto begin = read_begin(path, kLongestMagic, error);
  return begin && (is_exr(*begin) || is_png(*begin));
}

IoStatus read_image_header(const std::string& path, ImageHeader& header) {
  const auto fail = [&](const std::string& reason) {
    return IoStatus{"cannot read " + quoted(path, kLongestPath) + ": " + reason};
  };
  std::string error;
  const auto begin = read_begin(path, kLongestHeader, error);
  if (!begin) return fail((error.starts_with("is ") ? "it " : "") + error);
  ImageHeader read;
  if (is_exr(*begin)) {
    auto exr = read_exr_header(*begin);
    if (!exr) return fail("its header is damaged, or longer than 4 MiB");
    read = std::move(*exr);
  } else if (is_png(*begin)) {
    error = read_png_header(*begin, read);
    if (!error.empty()) return fail(error);
  } else {
    return fail("it is neither EXR nor PNG");
  }
  header = std::move(read);
  return {};
}

}  // namespace norrsken
