#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <exception>
#include <stdexcept>

#include "color/srgb.h"
#include "film/image_encode.h"

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

  Imf::FrameBuffer planes;
  const std::size_t row_bytes = sizeof(float) * static_cast<std::size_t>(image.width);
  for (const Channel& channel : image.channels) {
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    // OpenEXR only reads through this pointer.
    char* base = const_cast<char*>(reinterpret_cast<const char*>(channel.values.data()));
    planes.insert(channel.name, Imf::Slice(Imf::FLOAT, base, sizeof(float), row_bytes));
  }

  FileStream stream(file);
  Imf::OutputFile output(stream, header);
  output.setFrameBuffer(planes);
  output.writePixels(image.height);
  return {};
} catch (const std::exception& exception) {
  return exception.what();
}

}  // namespace norrsken
