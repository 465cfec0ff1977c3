#include <memory>
#include <new>
#include <utility>

#include "base/file_signature.h"
#include "base/regular_file.h"
#include "image/exr.h"
#include "image/raster_image.h"
#include "image/texel_image.h"
#include "norrsken/image.h"

namespace norrsken {
namespace {

constexpr const char* kAccepted = "; accepted are EXR, PNG, JPEG, HDR, PFM, PPM, PGM, PBM, BMP, TGA and TIFF";

/// What a file is that is none of the formats that are read.
std::string unknown_format(std::string_view contents) {
  if (contents.empty()) return "it is empty";
  if (contents.starts_with("version https://git-lfs")) return "it is a pointer of Git LFS in place of the image";
  const FileSignature* signature = file_signature(contents);
  if (signature != nullptr && signature->kind != FileKind::read_image)
    return "it is " + std::string(signature->what) + ", which is not read";
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

Result<Image> read_image(const std::string& path, const std::shared_ptr<MemoryBudget>& memory) {
  const auto failure = [&](const std::string& reason) {
    return Result<Image>::failure("cannot read '" + path + "': " + reason);
  };
  const std::uint64_t left = (memory ? memory : MemoryBudget::of_machine())->left();
  std::string error;
  const auto contents = read_regular_file(path, error, left);
  if (!contents) {
    const bool is_about_file = error.starts_with("is ") || error.starts_with("does ") || error.starts_with("claims ");
    return failure((is_about_file ? "it " : "") + error);
  }
  Image image;
  error = read_image_contents(*contents, left - contents->size(), image);
  return error.empty() ? Result<Image>(std::move(image)) : failure(error);
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
