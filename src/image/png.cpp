#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>

#include "base/text.h"
#include "image/raster_image.h"
#include "image/size.h"

namespace norrsken {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

/// All that the decoder touches and that has a destructor lives outside of the functions that libpng jumps back to.
struct Job {
  std::string_view left;  ///< of the file
  std::string error;
  png_structp png = nullptr;
  png_infop info = nullptr;
  png_uint_32 width = 0, height = 0;
  int bits = 0, channels = 0, passes = 0;
  std::size_t row_bytes = 0;

  ~Job() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  static_cast<Job*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep bytes, std::size_t count) {
  std::string_view& left = static_cast<Job*>(png_get_io_ptr(png))->left;
  if (count > left.size()) png_error(png, "it is cut off");
  std::copy_n(left.data(), count, reinterpret_cast<char*>(bytes));
  left.remove_prefix(count);
}

/// Reads what stands before the pixels. Nothing here may own anything: on an error libpng leaves it through longjmp.
void read_header(Job& job) {
  if (setjmp(png_jmpbuf(job.png))) return;
  png_set_read_fn(job.png, &job, on_read);
  png_set_user_limits(job.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  // Chunks may be compressed, and libpng keeps them all: 32 of a MiB are enough. Colour profiles are not looked at.
  png_set_chunk_cache_max(job.png, 32);
  png_set_chunk_malloc_max(job.png, png_alloc_size_t{1} << 20);
  png_set_keep_unknown_chunks(job.png, PNG_HANDLE_CHUNK_NEVER, reinterpret_cast<png_const_bytep>("iCCP"), 1);
  png_read_info(job.png, job.info);
  job.width = png_get_image_width(job.png, job.info);
  job.height = png_get_image_height(job.png, job.info);
  const bool is_palette = png_get_color_type(job.png, job.info) == PNG_COLOR_TYPE_PALETTE;
  const bool has_alpha_key = png_get_valid(job.png, job.info, PNG_INFO_tRNS) != 0;
  job.channels = (is_palette ? 3 : png_get_channels(job.png, job.info)) + (has_alpha_key ? 1 : 0);
}

/// Reads what stands before the pixels of these contents. Empty, or what is wrong.
std::string open(Job& job, std::string_view contents) {
  job.left = contents;
  job.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning);
  if (job.png != nullptr) job.info = png_create_info_struct(job.png);
  if (job.info == nullptr) return "not enough memory";
  read_header(job);
  return job.error;
}

/// The chunks that say what an image is and what is written on it, from anywhere in the file, as a PNG of no pixels.
std::string leave_pixels_out(const ReadAt& read_at, std::string& kept) {
  constexpr std::string_view kWanted[] = {"IHDR", "PLTE", "tRNS", "tEXt", "zTXt", "iTXt"};
  constexpr std::string_view kNoPixels("\0\0\0\0IDAT\x35\xaf\x06\x1e", 12);
  constexpr std::size_t kFrame = 12, kMostKept = std::size_t{4} << 20;
  constexpr int kMostChunks = 1 << 20;
  kept = read_at(0, kSignature.size());
  std::uint64_t at = kSignature.size();
  bool has_pixels = false;
  for (int chunk = 0; chunk < kMostChunks; ++chunk) {
    const std::string begin = read_at(at, 8);
    const std::string_view type = std::string_view(begin).substr(std::min<std::size_t>(begin.size(), 4));
    has_pixels = has_pixels || type == "IDAT";
    if (begin.size() < 8 || type == "IEND") break;
    std::uint64_t size = kFrame;
    for (int i = 0; i < 4; ++i) size += std::uint64_t{static_cast<unsigned char>(begin[i])} << (24 - 8 * i);
    if (std::ranges::find(kWanted, type) != std::end(kWanted) && size <= kMostKept - kept.size()) {
      const std::string whole = read_at(at, size);
      if (whole.size() == size) kept += whole;
    }
    at += size;
  }
  if (!has_pixels) return "it is cut off before its pixels";
  kept += kNoPixels;
  return {};
}

std::map<std::string, std::string> texts_of(const Job& job) {
  std::map<std::string, std::string> result;
  png_textp texts = nullptr;
  const int count = png_get_text(job.png, job.info, &texts, nullptr);
  for (int i = 0; i < count; ++i) result[texts[i].key] = texts[i].text;
  return result;
}

/// Asks for the pixels as 8 or 16 bits without palettes, for which libpng allocates rows. As above.
void begin_pixels(Job& job) {
  if (setjmp(png_jmpbuf(job.png))) return;
  png_set_expand(job.png);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(job.png);
  job.passes = png_set_interlace_handling(job.png);
  png_read_update_info(job.png, job.info);
  job.bits = png_get_bit_depth(job.png, job.info);
  job.row_bytes = png_get_rowbytes(job.png, job.info);
}

/// The next row of the pass; to be called as often as the image has rows.
bool read_row(Job& job, png_bytep row) {
  if (setjmp(png_jmpbuf(job.png))) return false;
  png_read_row(job.png, row, nullptr);
  return true;
}

/// Reads the pixels. Memory grows with the rows that are there, unless a pass has pixels of all of them.
template <class T>
void read_rows(Job& job, Array<T>& values) {
  const std::size_t row_values = job.row_bytes / sizeof(T);
  values.reserve(row_values * job.height);
  if (job.passes > 1) values.resize(row_values * job.height);
  for (int pass = 0; pass < job.passes; ++pass) {
    for (std::size_t y = 0; y < job.height; ++y) {
      values.resize(std::max(values.size(), row_values * (y + 1)));
      if (!read_row(job, reinterpret_cast<png_bytep>(values.data() + row_values * y))) return;
    }
  }
}

/// Whether the file says that its colours are stored as they are.
bool is_linear(const Job& job) {
  double gamma = 0;
  return png_get_valid(job.png, job.info, PNG_INFO_sRGB) == 0 && png_get_gAMA(job.png, job.info, &gamma) != 0 &&
         std::abs(gamma - 1) < 0.01;
}

}  // namespace

bool is_png(std::string_view contents) { return contents.starts_with(kSignature); }

std::string read_png_header(const ReadAt& read_at, ImageHeader& header) {
  std::string without_pixels;
  if (std::string error = leave_pixels_out(read_at, without_pixels); !error.empty()) return error;
  Job job;
  if (std::string error = open(job, without_pixels); !error.empty()) return error;
  constexpr std::uint32_t kMost = std::numeric_limits<int>::max();
  if (job.width < 1 || job.height < 1 || job.width > kMost || job.height > kMost) return "its size is wrong";
  header.format = "PNG";
  header.width = static_cast<int>(job.width);
  header.height = static_cast<int>(job.height);
  constexpr const char* kChannels[4][4] = {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}};
  const auto channels = static_cast<std::size_t>(std::clamp(job.channels, 1, 4));
  header.channels.assign(kChannels[channels - 1], kChannels[channels - 1] + channels);
  for (const auto& [name, text] : texts_of(job)) header.metadata[printable(name)] = printable(text);
  return {};
}

std::string read_png(std::string_view contents, RasterImage& image) {
  Job job;
  if (std::string error = open(job, contents); !error.empty()) return error;
  const std::uint64_t pixels = std::uint64_t{job.width} * job.height;
  if (!may_hold(pixels, contents.size())) return does_not_fit(job.width, job.height, contents.size());
  if (pixels > kMostImageValues / job.channels) {
    return too_many_values(size_text(job.width, job.height) + " pixels", job.channels);
  }
  // libpng holds two rows, and two more to undo the interlacing, each of up to 8 bytes a pixel.
  const MemoryReservation decoder(std::uint64_t{4} * 8 * job.width);
  begin_pixels(job);
  if (!job.error.empty()) return job.error;
  image.width = static_cast<int>(job.width);
  image.height = static_cast<int>(job.height);
  image.channels = job.channels;
  image.is_linear = is_linear(job);
  image.metadata = texts_of(job);
  if (job.bits == 16) {
    read_rows(job, image.words);
  } else {
    read_rows(job, image.bytes);
  }
  return job.error;
}

}  // namespace norrsken
