#include <algorithm>
#include <iterator>
#include <memory>
#include <new>
#include <utility>

#include "base/regular_file.h"
#include "image/exr.h"
#include "image/raster_image.h"
#include "image/texel_image.h"
#include "norrsken/image.h"

namespace norrsken {
namespace {

IoStatus failure(const std::string& path, const std::string& reason) {
  return {"cannot read '" + path + "': " + reason};
}

constexpr const char* kAccepted = "; accepted are EXR, PNG, JPEG, HDR, PFM, PPM, PGM, PBM, BMP, TGA and TIFF";

/// What a file is that is none of the formats that are read, by its first bytes.
std::string unknown_format(std::string_view contents) {
  struct Magic {
    std::size_t offset;
    std::string_view bytes;
    const char* what;
  };
  using namespace std::string_view_literals;
  constexpr Magic kMagics[] = {{0, "GIF8", "a GIF file"},
                               {8, "WEBP", "a WebP file"},
                               {0, "8BPS", "a Photoshop file"},
                               {0, "DDS ", "a DDS file"},
                               {1, "KTX ", "a KTX file"},
                               {0, "\x13\xab\xa1\x5c", "an ASTC file"},
                               {4, "jP  ", "a JPEG 2000 file"},
                               {0, "\xff\x4f\xff\x51", "a JPEG 2000 file"},
                               {4, "JXL ", "a JPEG XL file"},
                               {0, "\xff\x0a", "a JPEG XL file"},
                               {4, "ftyp", "a HEIF or AVIF file"},
                               {0, "P7\n", "a PAM file"},
                               {0, "\0\0\1\0"sv, "an icon file (ICO)"},
                               {0, "SDPX", "a DPX file"},
                               {0, "XPDS", "a DPX file"},
                               {0, "\x80\x2a\x5f\xd7", "a Cineon file"},
                               {0, "\x01\xda", "an SGI file"},
                               {0, "SIMPLE  =", "a FITS file"},
                               {0, "%PDF", "a PDF file"},
                               {0, "gimp xcf", "a GIMP file"}};
  if (contents.empty()) return "it is empty";
  if (contents.starts_with("version https://git-lfs")) return "it is a pointer of Git LFS in place of the image";
  for (const Magic& magic : kMagics) {
    if (contents.size() > magic.offset && contents.substr(magic.offset).starts_with(magic.bytes)) {
      return std::string("it is ") + magic.what + ", which is not read";
    }
  }
  if (contents.starts_with('<')) return "it is a text of tags, such as SVG or HTML";
  return "unknown or damaged image file";
}

}  // namespace

std::string read_image_contents(std::string_view contents, std::uint64_t most_bytes, Image& image) try {
  const MemoryScope scope(std::make_shared<MemoryBudget>(most_bytes));
  Image read;
  std::string error = is_exr(contents)            ? read_exr(contents, read)
                      : is_raster_image(contents) ? read_raster_image(contents, read)
                                                  : unknown_format(contents) + kAccepted;
  if (error.empty()) image = std::move(read);
  return error;
} catch (const MemoryExceeded& exceeded) {
  return exceeded.what();
} catch (const std::bad_alloc&) {
  return "not enough memory";
}

IoStatus read_image(const std::string& path, Image& image, std::uint64_t most_bytes) {
  std::string error;
  const auto contents = read_regular_file(path, error, most_bytes);
  if (!contents) {
    const bool is_about_file = error.starts_with("is ") || error.starts_with("does ") || error.starts_with("claims ");
    return failure(path, (is_about_file ? "it " : "") + error);
  }
  const std::uint64_t left = most_bytes - std::min<std::uint64_t>(most_bytes, contents->size());
  error = read_image_contents(*contents, left, image);
  return error.empty() ? IoStatus{} : failure(path, error);
}

Result<Image> read_image(const std::string& path, const std::shared_ptr<MemoryBudget>& memory) {
  Image image;
  const IoStatus status = read_image(path, image, (memory ? memory : MemoryBudget::of_machine())->left());
  return status ? Result<Image>(std::move(image)) : Result<Image>::failure(status.error);
}

std::string read_texels(std::string_view contents, TexelImage& image) try {
  TexelImage read;
  std::string error = is_exr(contents)            ? read_exr_texels(contents, read)
                      : is_raster_image(contents) ? read_raster_texels(contents, read)
                                                  : unknown_format(contents);
  if (error.empty()) image = std::move(read);
  return error;
} catch (const std::bad_alloc&) {
  return "not enough memory";
}

}  // namespace norrsken
