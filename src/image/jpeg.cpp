// JPEG files, through libjpeg.
#include <csetjmp>
#include <cstdio>
#include <cstring>
// jpeglib.h wants <cstdio> before it, jerror.h what jpeglib.h defines.
#include <jpeglib.h>
//
#include <jerror.h>

#include <algorithm>
#include <iterator>

#include "image/raster_image.h"
#include "image/size.h"

namespace norrsken {
namespace {

/// Scans of a progressive file: each goes over the whole image, and may take but a few bytes of the file.
constexpr int kMostScans = 100;

/// The marker in which cameras say how they were held.
constexpr int kExifMarker = JPEG_APP0 + 1;

/// All that the decoder touches and that outlives an error lives outside of the functions that libjpeg jumps back to.
struct Job {
  jpeg_error_mgr errors{};  // first: libjpeg hands out a pointer to it
  std::jmp_buf escape{};
  char message[JMSG_LENGTH_MAX]{};
  bool has_scans = false;  ///< more than one
  jpeg_progress_mgr progress{};
  jpeg_decompress_struct decompress{};

  ~Job() { jpeg_destroy_decompress(&decompress); }
};

[[noreturn]] void on_error(j_common_ptr common) {
  Job* job = reinterpret_cast<Job*>(common->err);
  common->err->format_message(common, job->message);
  std::longjmp(job->escape, 1);
}

/// Warnings are what libjpeg goes on after, with made-up pixels: where it lost some, that is an error.
void on_message(j_common_ptr common, int level) {
  constexpr int kLost[] = {JWRN_HIT_MARKER, JWRN_HUFF_BAD_CODE, JWRN_MUST_RESYNC, JWRN_ARITH_BAD_CODE};
  if (level >= 0) return;
  const int code = common->err->msg_code;
  const bool is_lost = std::ranges::find(kLost, code) != std::end(kLost);
  // The mark of the end may be missing, but not whole scans.
  const bool lacks_scans = code == JWRN_JPEG_EOF && reinterpret_cast<Job*>(common->err)->has_scans;
  if (is_lost || lacks_scans) on_error(common);
}

void on_progress(j_common_ptr common) {
  if (reinterpret_cast<j_decompress_ptr>(common)->input_scan_number <= kMostScans) return;
  Job* job = reinterpret_cast<Job*>(common->err);
  std::snprintf(job->message, sizeof job->message, "it has more than %d scans", kMostScans);
  std::longjmp(job->escape, 1);
}

/// Reads what stands before the pixels. Nothing here may own anything: on an error libjpeg leaves it through longjmp.
bool read_header(Job& job, std::string_view contents) {
  if (setjmp(job.escape)) return false;
  jpeg_create_decompress(&job.decompress);
  job.progress.progress_monitor = on_progress;
  job.decompress.progress = &job.progress;
  jpeg_mem_src(&job.decompress, reinterpret_cast<const unsigned char*>(contents.data()), contents.size());
  jpeg_save_markers(&job.decompress, kExifMarker, 0xffff);
  jpeg_read_header(&job.decompress, TRUE);
  job.has_scans = jpeg_has_multiple_scans(&job.decompress) != 0;
  switch (job.decompress.jpeg_color_space) {
    case JCS_GRAYSCALE:
      job.decompress.out_color_space = JCS_GRAYSCALE;
      break;
    case JCS_CMYK:
    case JCS_YCCK:
      job.decompress.out_color_space = JCS_CMYK;
      break;
    default:
      job.decompress.out_color_space = JCS_RGB;
  }
  return true;
}

/// As above. Decodes the whole file if it has several scans.
bool start(Job& job) {
  if (setjmp(job.escape)) return false;
  jpeg_start_decompress(&job.decompress);
  return true;
}

/// As above.
bool read_row(Job& job, std::uint8_t* row) {
  if (setjmp(job.escape)) return false;
  jpeg_read_scanlines(&job.decompress, &row, 1);
  return true;
}

/// What libjpeg allocates: rows of blocks, and all coefficients if they come in several scans.
std::uint64_t decoding_bytes(const Job& job) {
  constexpr std::uint64_t kRows = 128;
  const jpeg_decompress_struct& decompress = job.decompress;
  std::uint64_t bytes = kRows * decompress.image_width * decompress.num_components;
  if (!job.has_scans) return bytes;
  for (int c = 0; c < decompress.num_components; ++c) {
    const jpeg_component_info& component = decompress.comp_info[c];
    bytes += std::uint64_t{component.width_in_blocks + static_cast<unsigned>(component.h_samp_factor)} *
             (component.height_in_blocks + static_cast<unsigned>(component.v_samp_factor)) * sizeof(JBLOCK);
  }
  return bytes;
}

/// What Exif says of the camera's orientation, or 1: a TIFF directory behind a few letters. (JEITA CP-3451, 4.5 and 4.6.)
int exif_orientation(std::string_view exif) {
  using namespace std::string_view_literals;
  constexpr std::string_view kBegin = "Exif\0\0"sv;
  constexpr std::size_t kEntryBytes = 12;
  constexpr std::uint32_t kOrientation = 0x112;
  if (!exif.starts_with(kBegin)) return 1;
  exif.remove_prefix(kBegin.size());
  const bool is_big_endian = exif.starts_with("MM");
  /// The number of two or four bytes there, or 0.
  const auto number = [&](std::size_t at, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes && at + bytes <= exif.size(); ++i) {
      value = value << 8 | static_cast<std::uint8_t>(exif[at + (is_big_endian ? i : bytes - 1 - i)]);
    }
    return value;
  };
  const std::size_t directory = number(4, 4), entries = number(directory, 2);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + i * kEntryBytes;
    if (number(entry, 2) == kOrientation) return static_cast<int>(number(entry + 8, 2));
  }
  return 1;
}

int orientation_of(const jpeg_decompress_struct& decompress) {
  for (const auto* marker = decompress.marker_list; marker != nullptr; marker = marker->next) {
    if (marker->marker != kExifMarker) continue;
    const int orientation = exif_orientation({reinterpret_cast<const char*>(marker->data), marker->data_length});
    if (orientation != 1) return orientation;
  }
  return 1;
}

}  // namespace

bool is_jpeg(std::string_view contents) { return contents.starts_with("\xff\xd8\xff"); }

std::string read_jpeg(std::string_view contents, RasterImage& image) {
  Job job;
  jpeg_decompress_struct& decompress = job.decompress;
  decompress.err = jpeg_std_error(&job.errors);
  job.errors.error_exit = on_error;
  job.errors.emit_message = on_message;
  if (!read_header(job, contents)) return job.message;
  const bool has_inks = decompress.out_color_space == JCS_CMYK;
  const std::uint64_t pixels = std::uint64_t{decompress.image_width} * decompress.image_height;
  image.width = static_cast<int>(decompress.image_width);
  image.height = static_cast<int>(decompress.image_height);
  image.channels = decompress.out_color_space == JCS_GRAYSCALE ? 1 : 3;
  image.remark = orientation_remark(orientation_of(decompress));
  if (pixels > kMostImageValues / image.channels) {
    return too_many_values(size_text(image.width, image.height) + " pixels", image.channels);
  }
  // Huffman codes take a bit or more for the 64 pixels of a block.
  if (decompress.arith_code == 0 && !may_hold(pixels, contents.size())) {
    return does_not_fit(image.width, image.height, contents.size());
  }
  const MemoryReservation decoder(decoding_bytes(job));
  if (!start(job)) return job.message;
  const auto row_values = static_cast<std::size_t>(image.width) * image.channels;
  Array<std::uint8_t> inks(has_inks ? std::size_t{4} * decompress.image_width : 0);
  image.bytes.reserve(row_values * image.height);
  for (int y = 0; y < image.height; ++y) {
    image.bytes.resize(row_values * (y + 1));
    std::uint8_t* const row = &image.bytes[row_values * y];
    if (!read_row(job, has_inks ? inks.data() : row)) return job.message;
    // Adobe's convention, the only one in use, stores what the inks leave of the light.
    for (std::size_t i = 0; i < inks.size() / 4; ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        row[3 * i + c] = scaled_integer<std::uint8_t>(inks[4 * i + c] * inks[4 * i + 3], 255 * 255);
    }
  }
  return {};
}

}  // namespace norrsken
