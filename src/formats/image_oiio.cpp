#include "formats/image_oiio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/memory.h"
#include "color/srgb.h"
#include "formats/exr_header.h"
#include "formats/image_channels.h"
#include "formats/image_size.h"

namespace {

using namespace norrsken;

constexpr std::int64_t kRowsAtATime = 64;
/// A wider row is read alone: OpenImageIO sets memory for 256 rows aside for a block of any height.
constexpr std::int64_t kValuesAtATime = 1 << 18;

using Input = std::unique_ptr<OIIO::ImageInput>;

bool is_integer_of(const OIIO::TypeDesc& type, std::size_t bytes) {
  return !type.is_floating_point() && type.size() == bytes;
}

/// Whether the file's colours are stored with the sRGB transfer function.
bool is_srgb(const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  if (is_integer_of(spec.format, 1)) return !OIIO::Strutil::iequals(space, "linear");
  return is_integer_of(spec.format, 2) && OIIO::Strutil::iequals(space, "srgb");
}

/// What a stored value as OpenImageIO hands it out, with integers scaled to [0,1], stands for.
float decoded(float value, bool srgb, bool counted) {
  // 32-bit integers are identifiers or counts, not fractions.
  if (counted) return static_cast<float>(static_cast<double>(value) * 4294967295.0);
  return srgb ? linear_from_srgb(value) : value;
}

/// A complaint of OpenImageIO, which may also fail without a word.
std::string said(const std::string& error) { return error.empty() ? "unknown or damaged image file" : error; }

/// Pixels of the image with its tiles whole.
std::uint64_t stored_pixels(const OIIO::ImageSpec& spec) {
  const auto whole = [](int size, int tile) {
    const std::uint64_t step = std::max(tile, 1);
    return (static_cast<std::uint64_t>(size) + step - 1) / step * step;
  };
  return whole(spec.width, spec.tile_width) * whole(spec.height, spec.tile_height);
}

/// What decoders hold beside their output at most: many the whole image in the file's types.
std::uint64_t decoding_bytes(const OIIO::ImageSpec& spec) {
  return stored_pixels(spec) * spec.pixel_bytes(/*native=*/true);
}

/// Whether a file of so many bytes may hold the image. Formats that leave out what cannot be seen have no limit.
bool may_hold(const OIIO::ImageInput& input, std::size_t file_bytes) {
  constexpr std::string_view kBounded[] = {"pnm"};
  constexpr std::string_view kBoundedExr[] = {"none", "rle", "zip", "zips", "pxr24"};
  const OIIO::ImageSpec& spec = input.spec();
  const std::string format = input.format_name(), compression = spec.get_string_attribute("compression");
  const bool bounded = std::ranges::find(kBounded, format) != std::end(kBounded) ||
                       (format == "openexr" && std::ranges::find(kBoundedExr, compression) != std::end(kBoundedExr));
  return !bounded || norrsken::may_hold(spec.image_pixels(), file_bytes);
}

/// What stands in the way of reading an opened file of so many bytes, or nothing.
std::string objection_to(const OIIO::ImageInput& input, std::size_t file_bytes) {
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.deep || spec.depth > 1) return "deep and volume images are not read";
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) return "it has no pixels";
  // Their conversion writes past its buffer (OpenImageIO's issue 5315 and pull request 5475).
  constexpr int kSeparated = 5;
  if (spec.get_int_attribute("tiff:PhotometricInterpretation") == kSeparated &&
      (spec.tile_width > 0 || spec.get_int_attribute("oiio:BitsPerSample", 8) < 8)) {
    return "it holds inks (CMYK) in tiles or of fewer than 8 bits, accepted are strips of 8 bits and more";
  }
  if (!may_hold(input, file_bytes)) return does_not_fit(spec.width, spec.height, file_bytes);
  if (stored_pixels(spec) > kMostImageValues / static_cast<std::size_t>(spec.nchannels)) {
    const std::string tiles = " in tiles of " + size_text(spec.tile_width, spec.tile_height);
    return too_many_values(size_text(spec.width, spec.height) + " pixels" + (spec.tile_width > 0 ? tiles : ""),
                           spec.nchannels);
  }
  return {};
}

/// Whole tiles, and so many rows of a narrow image that calls are few: each may cost tens of megabytes.
int rows_at_a_time(const OIIO::ImageSpec& spec) {
  const std::int64_t row_values = std::int64_t{spec.nchannels} * spec.width;
  const std::int64_t tile = std::max(spec.tile_height, 1);
  const std::int64_t rows = row_values > kValuesAtATime ? 1 : std::max(kRowsAtATime, kValuesAtATime / row_values);
  return static_cast<int>(std::min<std::int64_t>((rows + tile - 1) / tile * tile, spec.height));
}

/// Reads the rows [begin, end), or whole tiles, all channels of a pixel together.
bool read_rows(OIIO::ImageInput& input, int begin, int end, const OIIO::TypeDesc& type, void* values) {
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.tile_height > 0) {
    return input.read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, 0, 1, 0, spec.nchannels, type, values);
  }
  if (end - begin == 1) return input.read_scanline(begin, 0, type, values);
  return input.read_scanlines(0, 0, begin, end, 0, 0, spec.nchannels, type, values);
}

/// Hands the image to `use(values)` in blocks of rows, all channels one behind the other. Empty, or what is
/// wrong with the file.
template <class T, class Use>
std::string for_each_block(OIIO::ImageInput& input, const OIIO::TypeDesc& type, const Use& use) {
  const OIIO::ImageSpec& spec = input.spec();
  const int step = rows_at_a_time(spec);
  const std::size_t row_values = static_cast<std::size_t>(spec.nchannels) * static_cast<std::size_t>(spec.width);
  std::vector<T> block(row_values * static_cast<std::size_t>(step));
  for (int row = 0; row < spec.height; row += step) {
    const int rows = std::min(step, spec.height - row), begin = spec.y + row;
    if (!read_rows(input, begin, begin + rows, type, block.data())) return said(input.geterror());
    use(std::span<const T>(block.data(), row_values * static_cast<std::size_t>(rows)));
  }
  return {};
}

/// Formats that are read, by OpenImageIO's names, and their extensions. It knows more, but each is one more parser for a
/// damaged file to break, and those that need a file of their own on disk could not be read from memory. BMP, PNG,
/// TGA and Radiance pictures are read without it (formats/raster_image.h says why).
struct Format {
  const char* name;
  std::initializer_list<const char*> extensions;
};
const Format kFormats[] = {{"openexr", {"exr"}},
                           {"jpeg", {"jpg", "jpeg"}},
                           {"tiff", {"tif", "tiff"}},
                           {"pnm", {"pfm", "ppm", "pgm", "pbm", "pnm"}}};

/// A file in memory. OpenImageIO 2.4's own reads far outside of it once a decoder has been sent there, as by the offsets in
/// an EXR.
class MemoryReader final : public OIIO::Filesystem::IOMemReader {
 public:
  explicit MemoryReader(const std::string& contents) : IOMemReader(contents.data(), contents.size()) {}

  std::size_t pread(void* buffer, std::size_t size, std::int64_t offset) override {
    const std::int64_t end = m_buf.size();
    if (offset < 0 || offset >= end) return 0;
    const std::size_t held = std::min(size, static_cast<std::size_t>(end - offset));
    std::memcpy(buffer, m_buf.data() + offset, held);
    return held;
  }
  std::size_t read(void* buffer, std::size_t size) override {
    const std::size_t held = pread(buffer, size, m_pos);
    m_pos += static_cast<std::int64_t>(held);
    return held;
  }
};

/// A file in memory, opened by OpenImageIO.
struct OpenImage {
  explicit OpenImage(const std::string& contents) : may_be_exr(exr_header_fits(contents)), bytes(contents) {}

  bool may_be_exr;
  MemoryReader bytes;
  Input input;  ///< empty if it could not be opened
};

/// Opens the contents as the format that the name's extension says, or else as whichever it is.
void open(const std::string& path, OpenImage& image) {
  OIIO::ImageSpec request;
  request["oiio:UnassociatedAlpha"] = 1;  // multiplying encoded colours by alpha is wrong
  const auto opened_as = [&](const Format& format) {
    if (std::string_view(format.name) == "openexr" && !image.may_be_exr) return false;
    Input input = OIIO::ImageInput::create(format.name);
    OIIO::ImageSpec spec;
    image.bytes.seek(0);
    if (!input || !input->set_ioproxy(&image.bytes) || !input->open(path, spec, request)) return false;
    image.input = std::move(input);
    return true;
  };
  const std::size_t dot = path.rfind('.');
  const std::string extension = dot == std::string::npos ? "" : OIIO::Strutil::lower(path.substr(dot + 1));
  const auto is_named = [&](const Format& format) {
    return std::ranges::any_of(format.extensions, [&](const char* name) { return extension == name; });
  };
  const auto* named = std::ranges::find_if(kFormats, is_named);
  if (named != std::end(kFormats) && opened_as(*named)) return;
  for (const Format& format : kFormats) {
    if (&format != named && opened_as(format)) break;
  }
  OIIO::geterror();  // which of them said what is of no use
}

/// Why a file could not be opened, by its first bytes.
std::string not_opened(std::string_view contents) {
  struct Magic {
    std::size_t offset;
    std::string_view bytes;
    const char* what;
  };
  using namespace std::string_view_literals;
  constexpr Magic kMagics[] = {{0, "\x76\x2f\x31\x01", "it is a damaged EXR file, or of a kind that is not read"},
                               {0, "\xff\xd8\xff", "it is a damaged JPEG file"},
                               {0, "II*\0"sv, "it is a damaged TIFF file"},
                               {0, "MM\0*"sv, "it is a damaged TIFF file"},
                               {0, "GIF8", "it is a GIF file, which is not read"},
                               {8, "WEBP", "it is a WebP file, which is not read"},
                               {0, "8BPS", "it is a Photoshop file, which is not read"},
                               {0, "DDS ", "it is a DDS file, which is not read"},
                               {1, "KTX ", "it is a KTX file, which is not read"},
                               {4, "jP  ", "it is a JPEG 2000 file, which is not read"},
                               {4, "ftyp", "it is a HEIF or AVIF file, which is not read"},
                               {0, "version https://git-lfs", "it is a pointer of Git LFS in place of the image"},
                               {0, "<", "it is a text of tags, such as SVG or HTML"}};
  for (const Magic& magic : kMagics) {
    if (contents.size() > magic.offset && contents.substr(magic.offset).starts_with(magic.bytes)) return magic.what;
  }
  return contents.empty() ? "it is empty" : "unknown or damaged image file";
}

std::string read(const std::string& path, const std::string& contents, std::uint64_t most_bytes, Image& image) {
  OpenImage file(contents);
  open(path, file);
  if (!file.input) return not_opened(contents);
  OIIO::ImageInput& input = *file.input;
  const OIIO::ImageSpec& spec = input.spec();
  if (std::string objection = objection_to(input, contents.size()); !objection.empty()) return objection;
  const std::uint64_t bytes = spec.image_pixels() * static_cast<std::uint64_t>(spec.nchannels) * sizeof(float);
  if (bytes + decoding_bytes(spec) > most_bytes) {
    return "it needs " + memory_text(bytes + decoding_bytes(spec)) + " of memory, and " + memory_text(most_bytes) +
           " are left";
  }

  image.width = spec.width;
  image.height = spec.height;
  const bool srgb_file = is_srgb(spec);
  std::vector<bool> srgb(spec.nchannels), counted(spec.nchannels);
  for (int c = 0; c < spec.nchannels; ++c) {
    srgb[c] = srgb_file && c != spec.alpha_channel && c != spec.z_channel;
    counted[c] = spec.channelformat(c) == OIIO::TypeDesc::UINT32;
    image.channels.push_back({spec.channel_name(c), {}});
  }
  for (const auto& attribute : spec.extra_attribs) {
    if (attribute.type() == OIIO::TypeString) image.metadata[attribute.name().string()] = attribute.get_string();
  }

  // Memory grows with the rows that are there, whatever the header promises.
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  return for_each_block<float>(input, OIIO::TypeFloat, [&](std::span<const float> block) {
    for (std::size_t c = 0; c < channels; ++c) {
      std::vector<float>& values = image.channels[c].values;
      for (std::size_t i = c; i < block.size(); i += channels) values.push_back(decoded(block[i], srgb[c], counted[c]));
    }
  });
}

template <class T>
std::string read_channels(OIIO::ImageInput& input, const std::vector<int>& wanted, Array<T>& values) {
  const OIIO::ImageSpec& spec = input.spec();
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  const bool counted = spec.format == OIIO::TypeDesc::UINT32;
  const MemoryReservation decoder(decoding_bytes(spec), values.get_allocator().budget());
  // Reserved memory costs nothing before it is written, so a header cannot ask for more than the file fills.
  values.reserve(spec.image_pixels() * wanted.size());
  return for_each_block<T>(input, std::is_same_v<T, float> ? OIIO::TypeFloat : OIIO::TypeUInt8,
                           [&](std::span<const T> block) {
                             for (std::size_t i = 0; i < block.size(); i += channels) {
                               for (const int c : wanted) {
                                 const T value = block[i + static_cast<std::size_t>(c)];
                                 if constexpr (std::is_same_v<T, float>) {
                                   values.push_back(decoded(value, false, counted));
                                 } else {
                                   values.push_back(value);
                                 }
                               }
                             }
                           });
}

std::string read_image_texels(const std::string& path, const std::string& contents, TexelImage& image) {
  OpenImage file(contents);
  open(path, file);
  if (!file.input) return not_opened(contents);
  OIIO::ImageInput& input = *file.input;
  const OIIO::ImageSpec& spec = input.spec();
  if (std::string objection = objection_to(input, contents.size()); !objection.empty()) return objection;
  const auto [wanted, is_xyz, remark] = color_channels(spec.channelnames);
  const bool small = is_integer_of(spec.format, 1);
  image.width = spec.width;
  image.height = spec.height;
  image.channels = static_cast<int>(wanted.size());
  image.is_encoded = !spec.format.is_floating_point() && spec.format.size() <= 2 &&
                     !OIIO::Strutil::iequals(spec.get_string_attribute("oiio:ColorSpace"), "linear");
  image.remark = remark;
  if (small) return read_channels(input, wanted, image.bytes);
  std::string error = read_channels(input, wanted, image.values);
  for (std::size_t i = 0; is_xyz && i + 2 < image.values.size(); i += 3) {
    float* v = &image.values[i];
    const ColorVector rgb = kSrgbFromXyz * ColorVector{v[0], v[1], v[2]};
    for (std::size_t c = 0; c < 3; ++c) v[c] = static_cast<float>(rgb[c]);
  }
  return error;
}

/// Runs `read`, which returns what is wrong, and lets no exception out.
template <class Read>
bool guarded(std::string& error, const Read& read) noexcept {
  try {
    error = read();
    return error.empty();
  } catch (const std::bad_alloc&) {
    error = "not enough memory";
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  return false;
}

}  // namespace

extern "C" bool norrsken_oiio_read(const std::string& path, const std::string& contents, std::uint64_t most_bytes,
                                   norrsken::Image& image, std::string& error) noexcept {
  return guarded(error, [&] { return read(path, contents, most_bytes, image); });
}

extern "C" bool norrsken_oiio_read_texels(const std::string& path, const std::string& contents,
                                          norrsken::TexelImage& image, std::string& error,
                                          std::exception_ptr& out_of_memory) noexcept {
  return guarded(error, [&] {
    try {
      return read_image_texels(path, contents, image);
    } catch (const norrsken::MemoryExceeded&) {
      out_of_memory = std::current_exception();
      throw;
    }
  });
}
