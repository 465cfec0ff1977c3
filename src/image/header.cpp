// has_image_header and read_image_header of include/norrsken/image.h.
#include <unistd.h>

#include <algorithm>
#include <cerrno>

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

std::string read_at(const RegularFile& file, std::uint64_t at, std::size_t most) {
  if (at >= file.bytes) return {};
  std::string bytes(std::min<std::uint64_t>(most, file.bytes - at), '\0');
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t count =
        ::pread(file.descriptor.get(), bytes.data() + size, bytes.size() - size, static_cast<off_t>(at + size));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    size += static_cast<std::size_t>(count);
  }
  bytes.resize(size);
  return bytes;
}

constexpr std::size_t kLongestMagic = 8;

}  // namespace

bool has_image_header(const std::string& path) {
  const RegularFile file = open_regular_file(path);
  if (!file.descriptor) return false;
  const std::string begin = read_at(file, 0, kLongestMagic);
  return is_exr(begin) || is_png(begin);
}

IoStatus read_image_header(const std::string& path, ImageHeader& header) {
  const auto fail = [&](const std::string& reason) {
    return IoStatus{"cannot read " + quoted(path, kLongestPath) + ": " + reason};
  };
  const RegularFile file = open_regular_file(path);
  if (!file.descriptor) return fail((file.error.starts_with("is ") ? "it " : "") + file.error);
  const std::string magic = read_at(file, 0, kLongestMagic);
  ImageHeader read;
  if (is_exr(magic)) {
    auto exr = read_exr_header(read_at(file, 0, kLongestHeader));
    if (!exr) return fail("its header is damaged, or longer than 4 MiB");
    read = std::move(*exr);
  } else if (is_png(magic)) {
    const std::string error =
        read_png_header([&](std::uint64_t at, std::size_t most) { return read_at(file, at, most); }, read);
    if (!error.empty()) return fail(error);
  } else {
    return fail("it is neither EXR nor PNG");
  }
  header = std::move(read);
  return {};
}

}  // namespace norrsken
