#include "image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledInputPart.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <iterator>
#include <new>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "base/text.h"
#include "color/srgb.h"
#include "image/channels.h"
#include "image/exr_header.h"
#include "image/size.h"

namespace norrsken {
namespace {

/// The file as OpenEXR reads it.
class MemoryStream final : public Imf::IStream {
 public:
  explicit MemoryStream(std::string_view contents) : IStream("EXR"), contents_(contents) {}

  bool read(char bytes[], int count) override {
    const std::uint64_t left = contents_.size() - std::min<std::uint64_t>(position_, contents_.size());
    if (count < 0 || static_cast<std::uint64_t>(count) > left) throw std::runtime_error("the file ends too early");
    std::copy_n(contents_.data() + position_, count, bytes);
    position_ += static_cast<std::uint64_t>(count);
    return position_ < contents_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::string_view contents_;
  std::uint64_t position_ = 0;
};

/// Sorts the channels of a layer as one names them.
auto rank_of(std::string_view channel) {
  constexpr std::string_view kFirst[] = {"R", "G", "B", "A"};
  const auto* found =
      std::ranges::find_if(kFirst, [&](auto name) { return equal_ignoring_case(name, last_name(channel)); });
  return std::tuple(layer_of(channel), found - std::begin(kFirst), channel);
}

/// Where the values of a channel go: the first one's place, and how far it is to the next.
struct Plane {
  std::string name;
  float* values;
  std::size_t step = 1;
};

/// The first part of a file. Its functions throw what OpenEXR does.
class FirstPart {
 public:
  FirstPart(std::string_view contents, std::uint64_t block_bytes)
      // A block is held packed, unpacked, and once more while it is unpacked.
      : decoder_(3 * block_bytes), file_bytes_(contents.size()), stream_(contents), file_(stream_, 0) {
    for (auto channel = header().channels().begin(); channel != header().channels().end(); ++channel) {
      names_.emplace_back(channel.name());
    }
    std::ranges::sort(names_, {}, rank_of);
  }

  const Imf::Header& header() const { return file_.header(0); }
  const std::vector<std::string>& names() const { return names_; }
  std::int64_t width() const { return size(0); }
  std::int64_t height() const { return size(1); }
  std::size_t pixels() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }

  /// What stands in the way of reading it, or nothing.
  std::string objection() const {
    if (header().hasType() && Imf::isDeepData(header().type())) return "deep images are not read";
    if (names_.empty()) return "it has no channels";
    for (auto channel = header().channels().begin(); channel != header().channels().end(); ++channel) {
      if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
        return "its channel " + quoted(channel.name()) + " has fewer pixels than the image, which is not read";
      }
    }
    constexpr Imf::Compression kBounded[] = {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                             Imf::ZIP_COMPRESSION, Imf::PXR24_COMPRESSION};
    const bool is_bounded = std::ranges::find(kBounded, header().compression()) != std::end(kBounded);
    if (is_bounded && !may_hold(pixels(), file_bytes_)) return does_not_fit(width(), height(), file_bytes_);
    if (pixels() > kMostImageValues / names_.size()) {
      return too_many_values(size_text(width(), height()) + " pixels", static_cast<int>(names_.size()));
    }
    return {};
  }

  /// What a user should know where the picture is larger or smaller than the pixels that are there.
  std::string window_remark() const {
    const Imath::Box2i &data = header().dataWindow(), &display = header().displayWindow();
    if (data == display) return {};
    const auto text = [](const Imath::Box2i& window) {
      const std::string size =
          size_text(std::int64_t{window.max.x} - window.min.x + 1, std::int64_t{window.max.y} - window.min.y + 1);
      return size + " at " + std::to_string(window.min.x) + "," + std::to_string(window.min.y);
    };
    return "has a data window of " + text(data) + " in a display window of " + text(display) +
           ": the data window is taken for the whole image";
  }

  /// Reads these channels in blocks of rows; `grow(rows)` is asked for the room before, which must not move.
  template <class Grow>
  void read(const std::vector<Plane>& planes, const Grow& grow) {
    const Imath::Box2i& window = header().dataWindow();
    Imf::FrameBuffer buffer;
    for (const Plane& plane : planes) {
      const std::size_t step = plane.step * sizeof(float);
      buffer.insert(plane.name,
                    Imf::Slice::Make(Imf::FLOAT, plane.values, window, step, step * static_cast<std::size_t>(width())));
    }
    // Memory grows with the rows that are there, whatever the header promises.
    if (header().hasTileDescription()) {
      Imf::TiledInputPart part(file_, 0);
      part.setFrameBuffer(buffer);
      const std::int64_t tile_height = part.tileYSize();
      for (int tile = 0; tile < part.numYTiles(0); ++tile) {
        grow(std::min(height(), (tile + 1) * tile_height));
        part.readTiles(0, part.numXTiles(0) - 1, tile, tile, 0, 0);
      }
    } else {
      constexpr int kRows = 256;
      Imf::InputPart part(file_, 0);
      part.setFrameBuffer(buffer);
      for (std::int64_t row = 0; row < height(); row += kRows) {
        const std::int64_t end = std::min(row + kRows, height());
        grow(end);
        part.readPixels(static_cast<int>(window.min.y + row), static_cast<int>(window.min.y + end - 1));
      }
    }
  }

 private:
  std::int64_t size(int axis) const {
    const Imath::Box2i& window = header().dataWindow();
    return std::int64_t{window.max[axis]} - window.min[axis] + 1;
  }

  MemoryReservation decoder_;
  std::size_t file_bytes_;
  MemoryStream stream_;
  Imf::MultiPartInputFile file_;
  std::vector<std::string> names_;
};

/// Opens the file and hands it to `use`, which returns what is wrong.
template <class Use>
std::string with_first_part(std::string_view contents, const Use& use) {
  const auto block_bytes = exr_block_bytes(contents);
  if (!block_bytes) return "it is a damaged EXR file, or of a kind that is not read";
  try {
    FirstPart part(contents, *block_bytes);
    std::string objection = part.objection();
    return objection.empty() ? use(part) : objection;
  } catch (const MemoryExceeded&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& exception) {
    return std::string("it is damaged or cut off: ") + exception.what();
  }
}

}  // namespace

bool is_exr(std::string_view contents) { return contents.starts_with("\x76\x2f\x31\x01"); }

std::string read_exr(std::string_view contents, Image& image) {
  return with_first_part(contents, [&](FirstPart& part) -> std::string {
    const MemoryReservation floats(part.pixels() * part.names().size() * sizeof(float));
    image.width = static_cast<int>(part.width());
    image.height = static_cast<int>(part.height());
    for (auto attribute = part.header().begin(); attribute != part.header().end(); ++attribute) {
      const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
      if (text != nullptr) image.metadata[attribute.name()] = text->value();
    }
    std::vector<Plane> planes;
    for (const std::string& name : part.names()) image.channels.push_back({name, {}});
    for (Channel& channel : image.channels) {
      channel.values.reserve(part.pixels());
      planes.push_back({channel.name, channel.values.data()});
    }
    part.read(planes, [&](std::int64_t rows) {
      for (Channel& channel : image.channels) channel.values.resize(static_cast<std::size_t>(part.width() * rows));
    });
    return {};
  });
}

std::string read_exr_texels(std::string_view contents, TexelImage& image) {
  return with_first_part(contents, [&](FirstPart& part) -> std::string {
    const ColorChannels colors = color_channels(part.names());
    const std::size_t count = colors.numbers.size();
    image.width = static_cast<int>(part.width());
    image.height = static_cast<int>(part.height());
    image.channels = static_cast<int>(count);
    image.remark = colors.remark.empty() ? part.window_remark() : colors.remark;
    image.values.reserve(part.pixels() * count);
    std::vector<Plane> planes;
    for (std::size_t c = 0; c < count; ++c)
      planes.push_back({part.names()[colors.numbers[c]], image.values.data() + c, count});
    part.read(planes,
              [&](std::int64_t rows) { image.values.resize(static_cast<std::size_t>(part.width() * rows) * count); });
    for (std::size_t i = 0; colors.is_xyz && i + 2 < image.values.size(); i += 3) {
      float* v = &image.values[i];
      const ColorVector rgb = kSrgbFromXyz * ColorVector{v[0], v[1], v[2]};
      for (std::size_t c = 0; c < 3; ++c) v[c] = static_cast<float>(rgb[c]);
    }
    return {};
  });
}

}  // namespace norrsken
