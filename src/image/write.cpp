#include <algorithm>
#include <filesystem>
#include <set>

#include "base/atomic_file.h"
#include "base/text.h"
#include "color/tone.h"
#include "image/encode.h"
#include "norrsken/image.h"

namespace norrsken {
namespace {

enum class Format { exr, png, jpeg };

constexpr struct {
  const char* extension;
  Format format;
} kFormats[] = {{".exr", Format::exr}, {".png", Format::png}, {".jpg", Format::jpeg}, {".jpeg", Format::jpeg}};

int largest_side(Format format) {
  switch (format) {
    case Format::png:
      return kLargestPngSide;
    case Format::jpeg:
      return kLargestJpegSide;
    case Format::exr:
      break;
  }
  return kLargestExrSide;
}

/// What is wrong with the size for the format, or nothing.
std::string complaint_about_size(int width, int height, Format format) {
  if (std::max(width, height) <= largest_side(format)) return {};
  return "the image has " + std::to_string(width) + "x" + std::to_string(height) + " pixels, the format takes " +
         std::to_string(largest_side(format)) + " along a side";
}

IoStatus find_format(const std::string& path, Format& format) {
  const std::string extension = std::filesystem::path(path).extension().string();
  std::string accepted;
  for (const auto& known : kFormats) {
    if (equal_ignoring_case(extension, known.extension)) {
      format = known.format;
      return {};
    }
    accepted += (accepted.empty() ? "" : ", ") + std::string(known.extension);
  }
  return write_failure(
      path, (extension.empty() ? "no file name extension" : "unknown file name extension '" + extension + "'") +
                ", accepted: " + accepted);
}

/// What is wrong with the image whatever its format, or nothing.
std::string complaint_about(const Image& image) {
  const std::string size = std::to_string(image.width) + "x" + std::to_string(image.height);
  if (image.width < 1 || image.height < 1) return "the image has " + size + " pixels";
  if (image.channels.empty()) return "the image has no channels";
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  std::set<std::string_view> names;
  for (const Channel& channel : image.channels) {
    if (channel.name.empty()) return "a channel has no name";
    if (!names.insert(channel.name).second) return "there are two channels '" + channel.name + "'";
    if (channel.values.size() != pixels) return "channel '" + channel.name + "' does not have " + size + " pixels";
  }
  return {};
}

/// The tone-mapped bytes of R, G and B, or what is missing.
std::string to_bytes(const Image& image, const ToneMapping& tone, ByteImage& bytes) {
  bytes.width = image.width;
  bytes.height = image.height;
  bytes.pixels.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const ToneMapper mapper(tone);
  std::size_t offset = 0;
  for (const char* name : {"R", "G", "B"}) {
    const Channel* channel = image.find(name);
    if (channel == nullptr) return std::string("the image has no channel ") + name + ", the format needs R, G and B";
    for (std::size_t i = 0; i < channel->values.size(); ++i) {
      bytes.pixels[3 * i + offset] = byte_from_unit(mapper(channel->values[i]));
    }
    ++offset;
  }
  return {};
}

}  // namespace

IoStatus write_image(const std::string& path, const Image& image, const ToneMapping& tone) {
  Format format{};
  if (IoStatus status = find_format(path, format); !status) return status;
  if (const std::string complaint = complaint_about(image); !complaint.empty()) return write_failure(path, complaint);
  const std::string too_large = complaint_about_size(image.width, image.height, format);
  if (!too_large.empty()) return write_failure(path, too_large);

  ByteImage bytes;
  if (format != Format::exr) {
    const std::string complaint = to_bytes(image, tone, bytes);
    if (!complaint.empty()) return write_failure(path, complaint);
  }

  AtomicFile file;
  if (IoStatus status = file.create(path); !status) return status;
  std::string complaint;
  switch (format) {
    case Format::exr:
      complaint = encode_exr(file, image);
      break;
    case Format::png:
      complaint = encode_png(file, bytes, image.metadata);
      break;
    case Format::jpeg:
      complaint = encode_jpeg(file, bytes);
      break;
  }
  // A disk that is full says more than a library that could not write.
  if (file.failed() || complaint.empty()) return file.commit();
  return write_failure(path, complaint);
}

IoStatus check_image_name(const std::string& path) {
  Format format{};
  return find_format(path, format);
}

IoStatus check_image_size(const std::string& path, int width, int height) {
  Format format{};
  if (IoStatus status = find_format(path, format); !status) return status;
  const std::string too_large = complaint_about_size(width, height, format);
  return too_large.empty() ? IoStatus{} : write_failure(path, too_large);
}

IoStatus check_writable(const std::string& path) {
  if (IoStatus status = check_image_name(path); !status) return status;
  AtomicFile file;  // removed again, as it is not committed
  return file.create(path);
}

}  // namespace norrsken
