#include "image/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace norrsken {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A file that is written into memory.
class MemoryFile final : public Imf::OStream {
 public:
  MemoryFile() : OStream("memory") {}
  void write(const char bytes[], int count) override {
    text_.resize(std::max(text_.size(), position_ + static_cast<std::size_t>(count)));
    std::copy_n(bytes, count, &text_[position_]);
    position_ += static_cast<std::size_t>(count);
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t position_ = 0;
};

constexpr int kWidth = 45, kHeight = 39;

/// A smooth picture, exact in halves.
float value_at(int x, int y, int channel) {
  return static_cast<float>(channel + 1) * (static_cast<float>(x) / 64 + static_cast<float>(y) / 8);
}

struct ExrFile {
  std::vector<std::string> channels = {"R", "G", "B"};
  Imf::PixelType type = Imf::FLOAT;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  Imf::LineOrder order = Imf::INCREASING_Y;
  int left = 0, top = 0;  ///< of the data window
  int tile = 0;           ///< if not 0
  Imf::LevelMode levels = Imf::ONE_LEVEL;

  std::string text() const {
    const Imath::Box2i window({left, top}, {left + kWidth - 1, top + kHeight - 1});
    Imf::Header header({{0, 0}, {199, 99}}, window, 1, {0, 0}, 1, order, compression);
    Imf::FrameBuffer buffer;
    std::vector<std::vector<float>> floats(channels.size());
    std::vector<std::vector<Imath::half>> halves(channels.size());
    std::vector<std::vector<unsigned>> numbers(channels.size());
    for (std::size_t c = 0; c < channels.size(); ++c) {
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          const float value = value_at(x, y, static_cast<int>(c));
          floats[c].push_back(value);
          halves[c].emplace_back(value);
          numbers[c].push_back(static_cast<unsigned>(value * 1000000));
        }
      }
      void* values = type == Imf::FLOAT  ? static_cast<void*>(floats[c].data())
                     : type == Imf::HALF ? static_cast<void*>(halves[c].data())
                                         : static_cast<void*>(numbers[c].data());
      header.channels().insert(channels[c], Imf::Channel(type));
      buffer.insert(channels[c], Imf::Slice::Make(type, values, window));
    }
    MemoryFile file;
    if (tile > 0) {
      header.setTileDescription({static_cast<unsigned>(tile), static_cast<unsigned>(tile), levels});
      Imf::TiledOutputFile output(file, header);
      output.setFrameBuffer(buffer);
      for (int level = 0; level < output.numLevels(); ++level) {
        output.writeTiles(0, output.numXTiles(level) - 1, 0, output.numYTiles(level) - 1, level);
        for (auto& values : floats) std::fill(values.begin(), values.end(), -1.0f);
      }
    } else {
      Imf::OutputFile output(file, header);
      output.setFrameBuffer(buffer);
      output.writePixels(kHeight);
    }
    return file.text();
  }
};

Image exr(const std::string& contents) {
  Image image;
  EXPECT_TRUE(is_exr(contents));
  EXPECT_EQ(read_exr(contents, image), "");
  return image;
}

void expect_values(const Image& image, const char* name, int channel, float error = 0) {
  ASSERT_EQ(image.width, kWidth);
  ASSERT_EQ(image.height, kHeight);
  const Channel* found = image.find(name);
  ASSERT_NE(found, nullptr) << name;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_NEAR(found->values[static_cast<std::size_t>(y * kWidth + x)], value_at(x, y, channel), error)
          << name << " at " << x << "," << y;
    }
  }
}

TEST(Exr, EveryCompressionInLinesAndTiles) {
  for (int kind = 0; kind < Imf::NUM_COMPRESSION_METHODS; ++kind) {
    for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
      for (const int tile : {0, 16}) {
        SCOPED_TRACE(testing::Message() << "compression " << kind << ", type " << type << ", tile " << tile);
        const auto compression = static_cast<Imf::Compression>(kind);
        const bool is_lossy = compression >= Imf::PXR24_COMPRESSION;
        const Image image = exr(ExrFile{.type = type, .compression = compression, .tile = tile}.text());
        for (int c = 0; c < 3; ++c) expect_values(image, c == 0 ? "R" : c == 1 ? "G" : "B", c, is_lossy ? 0.3f : 0);
      }
    }
  }
}

TEST(Exr, TheDataWindowIsTheImageWhereverItLies) {
  for (const int tile : {0, 16}) {
    for (const int left : {-30, 0, 70}) {
      for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
        const Image image = exr(ExrFile{.order = order, .left = left, .top = 90 - left, .tile = tile}.text());
        expect_values(image, "G", 1);
      }
    }
  }
}

TEST(Exr, OfSeveralLevelsTheLargestIsRead) {
  expect_values(exr(ExrFile{.tile = 16, .levels = Imf::MIPMAP_LEVELS}.text()), "B", 2);
}

TEST(Exr, LayersComeTogetherAndColoursInTheirOrder) {
  const Image image = exr(ExrFile{.channels = {"A", "B", "G", "R", "Z", "b.B", "b.G", "b.R", "id"}}.text());
  std::vector<std::string> names;
  for (const Channel& channel : image.channels) names.push_back(channel.name);
  EXPECT_THAT(names, ElementsAre("R", "G", "B", "A", "Z", "id", "b.R", "b.G", "b.B"));
  expect_values(image, "b.G", 6);
}

TEST(Exr, IntegersAreTheirValues) {
  const Image image = exr(ExrFile{.channels = {"id"}, .type = Imf::UINT}.text());
  const auto& values = image.find("id")->values;
  for (int x = 0; x < kWidth; ++x) {
    EXPECT_EQ(values[static_cast<std::size_t>(x)],
              static_cast<float>(static_cast<unsigned>(value_at(x, 0, 0) * 1000000)));
  }
}

TEST(Exr, TexelsAreColoursOrGreys) {
  TexelImage texels;
  ASSERT_EQ(
      read_exr_texels(ExrFile{.channels = {"B", "G", "R", "depth.Z"}, .type = Imf::HALF, .left = 3}.text(), texels),
      "");
  EXPECT_EQ(
      texels.remark,
      "has a data window of 45x39 at 3,0 in a display window of 200x100 at 0,0: the data window is taken for the whole "
      "image");
  EXPECT_EQ(texels.channels, 3);
  EXPECT_FALSE(texels.is_encoded);
  ASSERT_EQ(texels.values.size(), static_cast<std::size_t>(kWidth * kHeight * 3));
  EXPECT_EQ(texels.values[3 * kWidth], value_at(0, 1, 2)) << "red is the third that was written";
  EXPECT_EQ(texels.values[3 * kWidth + 2], value_at(0, 1, 0));
}

/// Parts with the red of `value_at(.., part)`.
std::string parts_of(const std::vector<std::string>& names) {
  std::vector<Imf::Header> headers;
  for (const std::string& name : names) {
    Imf::Header& header = headers.emplace_back(kWidth, kHeight);
    header.setName(name);
    header.setType(Imf::SCANLINEIMAGE);
    header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  }
  MemoryFile file;
  Imf::MultiPartOutputFile output(file, headers.data(), static_cast<int>(headers.size()));
  for (int part = 0; part < output.parts(); ++part) {
    std::vector<float> values;
    for (int i = 0; i < kWidth * kHeight; ++i) values.push_back(value_at(i % kWidth, i / kWidth, part));
    Imf::FrameBuffer buffer;
    buffer.insert("R", Imf::Slice::Make(Imf::FLOAT, values.data(), headers[0].dataWindow()));
    Imf::OutputPart to(output, part);
    to.setFrameBuffer(buffer);
    to.writePixels(kHeight);
  }
  return file.text();
}

TEST(Exr, OfSeveralPartsTheFirstCounts) {
  const Image image = exr(parts_of({"beauty", "albedo"}));
  EXPECT_EQ(image.channels.size(), 1u);
  expect_values(image, "R", 0);
}

TEST(Exr, DeepImagesAreRefused) {
  Imf::Header header(1, 1);
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  MemoryFile file;
  {
    Imf::DeepScanLineOutputFile output(file, header);
    unsigned count = 1;
    float value = 1;
    float* values = &value;
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(&count), sizeof count, sizeof count));
    buffer.insert(
        "R", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(&values), sizeof values, sizeof values, sizeof value));
    output.setFrameBuffer(buffer);
    output.writePixels(1);
  }
  Image image;
  EXPECT_EQ(read_exr(file.text(), image), "deep images are not read");
}

TEST(Exr, ChannelsOfFewerPixelsAreRefused) {
  Imf::Header header(2, 2);
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  header.channels().insert("RY", Imf::Channel(Imf::FLOAT, 2, 2));
  MemoryFile file;
  {
    float values[4] = {};
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, values, header.dataWindow()));
    buffer.insert("RY", Imf::Slice::Make(Imf::FLOAT, values, header.dataWindow(), 0, 0, 2, 2));
    Imf::OutputFile output(file, header);
    output.setFrameBuffer(buffer);
    output.writePixels(2);
  }
  Image image;
  EXPECT_EQ(read_exr(file.text(), image), "its channel 'RY' has fewer pixels than the image, which is not read");
}

TEST(Exr, WhatIsCutOffIsRefused) {
  for (const int tile : {0, 16}) {
    const std::string whole = ExrFile{.tile = tile}.text();
    for (std::size_t size = 4; size < whole.size(); size += 11) {
      Image image;
      EXPECT_NE(read_exr(whole.substr(0, size), image), "") << size << " of " << whole.size();
    }
    Image image;
    EXPECT_THAT(read_exr(whole.substr(0, whole.size() - 1), image), HasSubstr("it is damaged or cut off: "));
  }
}

TEST(Exr, SizesAreHeldAgainstTheFileAndTheBudget) {
  std::string file = ExrFile{}.text();
  const std::size_t at = file.find("dataWindow") + 11 + 6 + 4;
  const std::int32_t large[] = {0, 0, 9999, 99999};
  std::memcpy(&file[at], large, sizeof large);
  Image image;
  EXPECT_THAT(read_exr(file, image), HasSubstr("it is damaged or cut off: the file ends too early"));
  const auto budget = std::make_shared<MemoryBudget>(kWidth * kHeight * 3 * 4 + 3 * 16 * kWidth * 3 * 4 - 1);
  const MemoryScope scope(budget);
  EXPECT_THROW(read_exr(ExrFile{}.text(), image), MemoryExceeded);
  EXPECT_EQ(budget->used(), 0u);
}

}  // namespace
}  // namespace norrsken
