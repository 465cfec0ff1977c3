#include "image/texel_image.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include "norrsken/image.h"
#include "tests/address_space_limit.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

using namespace std::string_view_literals;

/// The bytes of a file that `write` makes.
template <class Write>
std::string bytes_of(const std::string& name, const Write& write) {
  const TemporaryFolder folder;
  write(folder.file(name));
  std::ostringstream bytes;
  bytes << std::ifstream(folder / name, std::ios::binary).rdbuf();
  return bytes.str();
}

/// The header of a PPM of bytes, whose pixels follow.
std::string ppm(std::uint32_t width, std::uint32_t height, const std::string& pixels) {
  return "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n" + pixels;
}
/// The same of a grey TGA, top row first.
std::string tga(std::uint16_t width, std::uint16_t height, const std::string& pixels) {
  std::string header("\0\0\3\0\0\0\0\0\0\0\0\0wwhh\x08\x20", 18);
  std::memcpy(&header[12], &width, 2);
  std::memcpy(&header[14], &height, 2);
  return header + pixels;
}

TEST(TexelImage, FilesOfBytesKeepTheirBytes) {
  TexelImage image;
  ASSERT_EQ(read_texels(ppm(2, 1, "\1\2\3\4\5\6"), image), "");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(image.channels, 3);
  EXPECT_TRUE(image.is_encoded);
  EXPECT_EQ(image.bytes, (Array<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(image.values.empty());
}

TEST(TexelImage, WhatAFileIsTellItsContents) {
  TexelImage image;
  ASSERT_EQ(read_texels(tga(1, 2, "\1\2"), image), "");
  EXPECT_EQ(image.channels, 1);
  EXPECT_EQ(image.bytes, (Array<std::uint8_t>{1, 2}));
  ASSERT_EQ(read_texels(ppm(1, 1, "\1\2\3"), image), "");
  EXPECT_EQ(image.bytes, (Array<std::uint8_t>{1, 2, 3}));
}

TEST(TexelImage, RadianceFilesAreLinear) {
  // 1 x 2 in "-Y 2 +X 1": mantissas and a shared exponent of 128 + 1.
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n";
  TexelImage image;
  ASSERT_EQ(read_texels(header + std::string("\x80\x40\x20\x81\x20\x40\x80\x81", 8), image), "");
  EXPECT_FALSE(image.is_encoded);
  ASSERT_EQ(image.values.size(), 6u);
  EXPECT_NEAR(image.values[0], 1, 0.01);
  EXPECT_NEAR(image.values[1], 0.5, 0.01);
  EXPECT_NEAR(image.values[5], 1, 0.01);
}

TEST(TexelImage, WhatTheProgramWritesItReads) {
  Image written;
  written.width = 2;
  written.height = 1;
  written.channel("R").values = {0, 0.25f};
  written.channel("G").values = {1, 4};
  written.channel("B").values = {0.5f, -1};
  written.channel("depth.Z").values = {7, 8};
  const auto write = [&](const std::string& path) { ASSERT_TRUE(write_image(path, written)); };

  TexelImage exr, png, jpeg;
  ASSERT_EQ(read_texels(bytes_of("a.exr", write), exr), "");
  EXPECT_FALSE(exr.is_encoded);
  EXPECT_EQ(exr.channels, 3);
  EXPECT_EQ(exr.values, (Array<float>{0, 1, 0.5f, 0.25f, 4, -1}));

  ASSERT_EQ(read_texels(bytes_of("a.png", write), png), "");
  EXPECT_TRUE(png.is_encoded);
  EXPECT_EQ(png.bytes, (Array<std::uint8_t>{0, 255, 188, 137, 255, 0}));

  ASSERT_EQ(read_texels(bytes_of("a.jpg", write), jpeg), "");
  EXPECT_TRUE(jpeg.is_encoded);
  EXPECT_EQ(jpeg.bytes.size(), 6u);
}

/// An EXR whose channels have these names and values, one pixel each.
TexelImage exr_of(const std::vector<std::pair<std::string, float>>& channels) {
  Image written;
  written.width = written.height = 1;
  for (const auto& [name, value] : channels) written.channel(name).values = {value};
  TexelImage image;
  EXPECT_EQ(
      read_texels(bytes_of("a.exr", [&](const std::string& path) { ASSERT_TRUE(write_image(path, written)); }), image),
      "");
  return image;
}

TEST(TexelImage, XyzBecomesSrgb) {
  // The columns of the standard's matrix (IEC 61966-2-1): what red, green and blue are.
  const TexelImage red = exr_of({{"X", 0.4124f}, {"Y", 0.2126f}, {"Z", 0.0193f}});
  ASSERT_EQ(red.channels, 3);
  EXPECT_NEAR(red.values[0], 1, 1e-3);
  EXPECT_NEAR(red.values[1], 0, 1e-3);
  EXPECT_NEAR(red.values[2], 0, 1e-3);
  EXPECT_NEAR(exr_of({{"X", 0.1805f}, {"Y", 0.0722f}, {"Z", 0.9505f}}).values[2], 1, 1e-3);
  EXPECT_EQ(exr_of({{"Y", 0.5f}}).values, (Array<float>{0.5f})) << "alone it is grey";
  const TexelImage small = exr_of({{"x", 0.4124f}, {"y", 0.2126f}, {"z", 0.0193f}});
  EXPECT_EQ(small.values, red.values);
  EXPECT_EQ(small.remark, "");
  EXPECT_EQ(exr_of({{"main.X", 0.4124f}, {"main.Y", 0.2126f}, {"main.Z", 0.0193f}}).values, red.values);
}

TEST(TexelImage, GuessesAtChannelsAreTold) {
  EXPECT_EQ(exr_of({{"depth", 4}}).remark, "has no channels R, G, B or Y: depth is taken for grey");
  EXPECT_EQ(exr_of({{"N.X", 1}, {"N.Y", 2}, {"N.Z", 3}}).remark, "has N.X, N.Y, N.Z, which are taken for CIE X, Y, Z");
  EXPECT_EQ(exr_of({{"R", 1}, {"G", 2}}).remark, "has no channels R, G, B or Y: R is taken for grey");
  EXPECT_EQ(exr_of({{"A", 1}, {"R", 2}}).remark, "");
  const TexelImage layers =
      exr_of({{"a.R", 1}, {"a.G", 2}, {"a.B", 3}, {"b.R", 4}, {"b.G", 5}, {"b.B", 6}, {"c.Z", 7}});
  EXPECT_EQ(layers.remark, "has the layers a, b, of which the first is taken");
  EXPECT_EQ(layers.values, (Array<float>{1, 2, 3}));
  const TexelImage beside = exr_of({{"R", 1}, {"G", 2}, {"B", 3}, {"b.R", 4}, {"b.G", 5}, {"b.B", 6}});
  EXPECT_EQ(beside.remark, "");
  EXPECT_EQ(beside.values, (Array<float>{1, 2, 3}));
  const TexelImage grey = exr_of({{"Y", 7}, {"albedo.R", 1}, {"albedo.G", 2}, {"albedo.B", 3}});
  EXPECT_EQ(grey.remark, "");
  EXPECT_EQ(grey.values, Array<float>{7});
  const TexelImage written_out = exr_of({{"Red", 1}, {"Green", 2}, {"Blue", 3}});
  EXPECT_EQ(written_out.remark, "");
  EXPECT_EQ(written_out.values, (Array<float>{1, 2, 3}));
  EXPECT_EQ(exr_of({{"Y", 1}, {"RY", 0}, {"BY", 0}}).remark,
            "has colours in channels RY and BY, which are not read: Y is taken for grey");
  EXPECT_EQ(exr_of({{"R", 1}}).remark, "");
  EXPECT_EQ(exr_of({{"Y", 1}}).remark, "");
  EXPECT_EQ(exr_of({{"r", 1}, {"g", 2}, {"b", 3}}).remark, "");
  const TexelImage layer = exr_of({{"View.Combined.R", 1}, {"View.Combined.G", 2}, {"View.Combined.B", 3}});
  EXPECT_EQ(layer.remark, "");
  EXPECT_EQ(layer.values, (Array<float>{1, 2, 3}));
}

TEST(TexelImage, BadFilesAreRefused) {
  TexelImage image;
  EXPECT_EQ(read_texels("no image", image), "unknown or damaged image file");
  EXPECT_EQ(read_texels("", image), "it is empty");
  EXPECT_EQ(read_texels("x", image), "unknown or damaged image file");
  EXPECT_EQ(read_texels("RIFF....WEBPVP8 ", image), "it is a WebP image, which is not read");
  for (const std::string_view start : {"GIF89a"sv, "8BPS"sv, "DDS "sv, "\0\0\0\x0cjP  "sv,
                                       "\0\0\0\x18"
                                       "ftypheic"sv,
                                       "\0\0\0\x1c"
                                       "ftypavif"sv,
                                       "P7\n"sv, "\0\0\0\x0cJXL "sv, "\xff\x0a"sv}) {
    const std::string error = read_texels(std::string(start) + std::string(20, '.'), image);
    EXPECT_TRUE(error.starts_with("it is a ") && error.ends_with(" image, which is not read"))
        << start << ": " << error;
  }
  EXPECT_EQ(read_texels("PK\3\4", image), "it is a packed file (ZIP), which is not read");
  EXPECT_EQ(read_texels("version https://git-lfs.github.com/spec/v1\n", image),
            "it is a pointer of Git LFS in place of the image");
  EXPECT_EQ(read_texels("\x76\x2f\x31\x01\x02", image), "it is a damaged EXR file, or of a kind that is not read");
  EXPECT_EQ(image.width, 0) << "changed on success only";
  Image planes;
  EXPECT_EQ(
      read_image_contents("GIF89a", 1 << 20, planes),
      "it is a GIF image, which is not read; accepted are EXR, PNG, JPEG, HDR, PFM, PPM, PGM, PBM, BMP, TGA and TIFF");
}

/// Of what is written, no part is enough.
TEST(TexelImage, FilesThatAreCutOffAreErrorsWhereverThatIs) {
  Image written;
  written.width = 19, written.height = 23;
  for (const char* name : {"R", "G", "B"}) {
    auto& values = written.channel(name).values;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i * 37 % 101) / 101;
  }
  const auto write = [&](const std::string& path) { ASSERT_TRUE(write_image(path, written)); };
  for (const char* name : {"a.exr", "a.jpg", "a.png"}) {
    const std::string whole = bytes_of(name, write);
    TexelImage image;
    ASSERT_EQ(read_texels(whole, image), "") << name;
    constexpr std::size_t kEndMark = 16;  // of PNG and JPEG, which may be missing
    for (std::size_t size = 0; size < whole.size() - kEndMark; size += 7) {
      TexelImage cut;
      EXPECT_NE(read_texels(whole.substr(0, size), cut), "") << name << " " << size << " of " << whole.size();
      EXPECT_EQ(cut.width, 0);
      Image planes;
      EXPECT_NE(read_image_contents(whole.substr(0, size), 1 << 20, planes), "") << name << " " << size;
    }
  }
}

TEST(TexelImage, HeadersThatPromiseMoreThanTheFileHoldsAreNotBelieved) {
  TexelImage image;
  EXPECT_EQ(read_texels(tga(60000, 60000, "123456"), image),
            "its header says that it has 60000x60000 pixels, which do not fit a file of 24 bytes");
  EXPECT_EQ(read_texels(ppm(20000000, 5, ""), image),
            "its header says that it has 20000000x5 pixels, which do not fit a file of 18 bytes");
  // What deflate might still make of so few bytes is given up when the file ends.
  const MemoryScope scope(std::make_shared<MemoryBudget>(std::uint64_t{1} << 30));
  EXPECT_NE(read_texels(ppm(200, 200, "123456"), image), "");
}

TEST(TexelImage, RowsOfMillionsOfPixelsAreReadWithoutGigabytes) {
  TexelImage image;
  constexpr std::uint32_t kWidth = 2000000, kHeight = 5;
  std::string pixels;
  for (std::uint32_t i = 0; i < kWidth * 3 * kHeight; ++i) pixels += static_cast<char>(i % 251);
  const std::string file = ppm(kWidth, kHeight, pixels);
  {
    const AddressSpaceLimit limit(std::uint64_t{300} << 20);
    ASSERT_EQ(read_texels(file, image), "");
  }
  EXPECT_EQ(std::string(image.bytes.begin(), image.bytes.end()), pixels);
}

TEST(TexelImage, WhatItsImageAndItsDecoderTakeIsCounted) {
  // 2 x 2 pixels of 3 bytes.
  const std::string file = ppm(2, 2, "123456123456");
  for (const std::uint64_t limit : {12, 11}) {
    const auto budget = std::make_shared<MemoryBudget>(limit);
    const MemoryScope scope(budget);
    TexelImage image;
    if (limit == 12) {
      EXPECT_EQ(read_texels(file, image), "");
      EXPECT_EQ(budget->used(), 12u);
    } else {
      EXPECT_THROW(read_texels(file, image), MemoryExceeded);
      EXPECT_EQ(budget->used(), 0u);
    }
    EXPECT_EQ(image.width, limit == 12 ? 2 : 0) << "changed on success only";
  }
}

}  // namespace
}  // namespace norrsken
