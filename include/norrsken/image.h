// Images as the library hands them out and takes them in: named float channels, and files of them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "norrsken/memory.h"
#include "norrsken/result.h"

namespace norrsken {

/// One plane of an image: `values[y * width + x]`, row 0 at the top.
struct Channel {
  std::string name;  ///< as in the EXR: "R", "G", "B", "variance.R", "depth.Z", "normal.X", "albedo.R", "id", ...
  std::vector<float> values;
};

/// A stack of channels of one size. Radiance is linear sRGB.
struct Image {
  enum class Color { rgb, xyz, luminance };
  int width = 0;
  int height = 0;
  std::vector<Channel> channels;
  Color exr_color = Color::rgb;  ///< what an EXR holds in place of R, G, B: X, Y, Z or Y
  bool exr_half = false;         ///< an EXR holds colour and A as 16-bit floats, other channels as 32-bit ones
  /// Free text that EXR and PNG headers carry. Of images that were rendered: "Software" and "norrsken.*", see docs/cli.md.
  std::map<std::string, std::string> metadata;

  const Channel* find(std::string_view name) const;
  /// Adds a channel of zeros (or returns the one of that name). The reference holds until the next one is added.
  Channel& channel(std::string_view name);
};

/// How linear radiance becomes the bytes of a PNG or JPEG.
struct ToneMapping {
  enum class Curve { srgb, filmic };
  Curve curve = Curve::srgb;
  float exposure = 0;  ///< in stops: radiance is multiplied by 2^exposure first
};

/// Thrown by nothing: errors come back as text. Empty means success.
struct [[nodiscard]] IoStatus {
  std::string error;
  explicit operator bool() const { return error.empty(); }
};

/// Writes by file extension: .exr (every channel; float32, unless the image says otherwise), .png (8 bit) and .jpg (tone-mapped R, G, B).
/// The file is written under a temporary name in the same folder and renamed, so a reader never sees half of it; on
/// an error a file that was there before stays. In PNG and JPEG NaN and what is below 0 are black, infinity is white.
/// Errors: unknown extension, unwritable folder, full disk, size beyond the format, no R, G, B for PNG or JPEG.
IoStatus write_image(const std::string& path, const Image& image, const ToneMapping& tone = {});

/// Reads EXR, PNG, JPEG, HDR, PFM, PPM, PGM, PBM, BMP, TGA and TIFF, told by their contents, as linear float channels: integers of
/// up to 16 bits are decoded from sRGB, those of 32 are their values, alpha is left as it is (not multiplied). Of several images
/// the first counts, of an EXR its data window; orientation tags are not heeded. Errors: not a regular file, above 4 GiB, unknown,
/// damaged or cut off, more than 2^30 values, or than is left of `memory`, the file and its decoding included; empty:
/// MemoryBudget::of_machine(). The image itself is its owner's to count.
Result<Image> read_image(const std::string& path, const std::shared_ptr<MemoryBudget>& memory = {});

/// What an EXR or PNG file says about itself before its pixels.
struct ImageHeader {
  std::string format;  ///< "EXR" or "PNG"
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< by their names in the file, or as in "R", "G", "B", "A"; grey is "Y"
  std::map<std::string, std::string> metadata;  ///< its texts; control characters and malformed UTF-8 are replaced
};

/// Whether a file begins as EXR and PNG files do.
bool has_image_header(const std::string& path);

/// Reads the header alone. Errors: not a regular file, not EXR or PNG, damaged. `header` changes on success only.
IoStatus read_image_header(const std::string& path, ImageHeader& header);

/// Whether `write_image` knows the extension: empty, or what is wrong and accepted.
IoStatus check_image_name(const std::string& path);

/// Whether the format of that extension takes images of this size: empty, or what is wrong and accepted.
IoStatus check_image_size(const std::string& path, int width, int height);

/// Whether `write_image` could write there, asked before a long render: `check_image_name`, and that the folder exists
/// and can be written to.
IoStatus check_writable(const std::string& path);

}  // namespace norrsken
