#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <deque>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "color/srgb.h"
#include "image/encode.h"

namespace norrsken {
namespace {

class FileStream : public Imf::OStream {
 public:
  explicit FileStream(AtomicFile& file) : OStream("image"), file_(file) {}
  void write(const char bytes[], int count) override {
    if (!file_.write(bytes, static_cast<std::size_t>(count))) throw std::runtime_error("write failed");
  }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override {
    if (!file_.seek(position)) throw std::runtime_error("seek failed");
  }

 private:
  AtomicFile& file_;
};

Imath::V2f to_imath(Chromaticity c) { return {static_cast<float>(c.x), static_cast<float>(c.y)}; }

/// The channels as the file holds them: colour in its format, halves where it wants them.
class FileChannels {
 public:
  explicit FileChannels(const Image& image) : image_(image) {
    const Channel* const rgb[] = {image.find("R"), image.find("G"), image.find("B")};
    const bool has_color = std::ranges::none_of(rgb, [](const Channel* c) { return c == nullptr; });
    const bool converted = has_color && image.exr_color != Image::Color::rgb;
    for (const Channel& channel : image.channels) {
      const bool color = channel.name == "R" || channel.name == "G" || channel.name == "B";
      if (!(color && converted)) add(channel.name, channel.values, color || channel.name == "A");
    }
    if (!converted) return;
    if (image.exr_color == Image::Color::xyz) add_converted("X", kXyzFromSrgb[0], rgb);
    add_converted("Y", kXyzFromSrgb[1], rgb);
    if (image.exr_color == Image::Color::xyz) add_converted("Z", kXyzFromSrgb[2], rgb);
  }

  void describe(Imf::Header& header, Imf::FrameBuffer& planes) const {
    const auto width = static_cast<std::size_t>(image_.width);
    for (const Plane& plane : planes_) {
      const Imf::PixelType type = plane.halves.empty() ? Imf::FLOAT : Imf::HALF;
      const std::size_t bytes = plane.halves.empty() ? sizeof(float) : sizeof(Imath::half);
      header.channels().insert(plane.name, Imf::Channel(type));
      // OpenEXR only reads through this pointer.
      const void* values = plane.halves.empty() ? static_cast<const void*>(plane.floats) : plane.halves.data();
      planes.insert(plane.name, Imf::Slice(type, static_cast<char*>(const_cast<void*>(values)), bytes, bytes * width));
    }
  }

 private:
  struct Plane {
    std::string name;
    const float* floats;
    std::vector<Imath::half> halves;
  };

  void add(const std::string& name, const std::vector<float>& values, bool is_color) {
    planes_.push_back({name, values.data(), {}});
    if (is_color && image_.exr_half) planes_.back().halves.assign(values.begin(), values.end());
  }
  void add_converted(const char* name, const ColorVector& row, const Channel* const (&rgb)[3]) {
    std::vector<float>& values = converted_.emplace_back(rgb[0]->values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = static_cast<float>(row[0] * static_cast<double>(rgb[0]->values[i]) +
                                     row[1] * static_cast<double>(rgb[1]->values[i]) +
                                     row[2] * static_cast<double>(rgb[2]->values[i]));
    }
    add(name, values, true);
  }

  const Image& image_;
  std::deque<std::vector<float>> converted_;  // does not move what is in it
  std::vector<Plane> planes_;
};

}  // namespace

std::string encode_exr(AtomicFile& file, const Image& image) try {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  header.zipCompressionLevel() = 2;  // up to a third faster than the default of 4 for at most 5 % more bytes
  Imf::addChromaticities(header, {to_imath(kSrgbRed), to_imath(kSrgbGreen), to_imath(kSrgbBlue), to_imath(kSrgbWhite)});
  for (const auto& [name, text] : image.metadata) {
    if (header.find(name) != header.end()) return "metadata '" + name + "': EXR uses this name itself";
    header.insert(name, Imf::StringAttribute(text));
  }

  const FileChannels channels(image);
  Imf::FrameBuffer planes;
  channels.describe(header, planes);

  FileStream stream(file);
  Imf::OutputFile output(stream, header);
  output.setFrameBuffer(planes);
  output.writePixels(image.height);
  return {};
} catch (const std::exception& exception) {
  return exception.what();
}

}  // namespace norrsken
