#include "formats/texel_image.h"

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
  ASSERT_EQ(read_texels("a.ppm", ppm(2, 1, "\1\2\3\4\5\6"), image), "");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(image.channels, 3);
  EXPECT_TRUE(image.is_encoded);
  EXPECT_EQ(image.bytes, (Array<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(image.values.empty());
}

TEST(TexelImage, WhatAFileIsTellsItsContentsNotItsName) {
  TexelImage image;
  ASSERT_EQ(read_texels("a.png", tga(1, 2, "\1\2"), image), "");
  EXPECT_EQ(image.channels, 1);
  EXPECT_EQ(image.bytes, (Array<std::uint8_t>{1, 2}));
  ASSERT_EQ(read_texels("a.bmp", ppm(1, 1, "\1\2\3"), image), "");
  EXPECT_EQ(image.bytes, (Array<std::uint8_t>{1, 2, 3}));
}

TEST(TexelImage, RadianceFilesAreLinear) {
  // 1 x 2 in "-Y 2 +X 1": mantissas and a shared exponent of 128 + 1.
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n";
  TexelImage image;
  ASSERT_EQ(read_texels("a.hdr", header + std::string("\x80\x40\x20\x81\x20\x40\x80\x81", 8), image), "");
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
  ASSERT_EQ(read_texels("a.exr", bytes_of("a.exr", write), exr), "");
  EXPECT_FALSE(exr.is_encoded);
  EXPECT_EQ(exr.channels, 3);
  EXPECT_EQ(exr.values, (Array<float>{0, 1, 0.5f, 0.25f, 4, -1}));

  ASSERT_EQ(read_texels("a.png", bytes_of("a.png", write), png), "");
  EXPECT_TRUE(png.is_encoded);
  EXPECT_EQ(png.bytes, (Array<std::uint8_t>{0, 255, 188, 137, 255, 0}));

  ASSERT_EQ(read_texels("a.jpg", bytes_of("a.jpg", write), jpeg), "");
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
      read_texels("a.exr", bytes_of("a.exr", [&](const std::string& path) { ASSERT_TRUE(write_image(path, written)); }),
                  image),
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
  EXPECT_EQ(read_texels("a.png", "no image", image), "unknown or damaged image file");
  EXPECT_EQ(read_texels("a.exr", "", image), "it is empty");
  EXPECT_EQ(read_texels("a", "x", image), "unknown or damaged image file");
  EXPECT_EQ(read_texels("a.jpg", "RIFF....WEBPVP8 ", image), "it is a WebP file, which is not read");
  EXPECT_EQ(read_texels("a.png", "version https://git-lfs.github.com/spec/v1\n", image),
            "it is a pointer of Git LFS in place of the image");
  EXPECT_EQ(read_texels("a.exr", "\x76\x2f\x31\x01\x02", image),
            "it is a damaged EXR file, or of a kind that is not read");
  EXPECT_EQ(image.width, 0) << "changed on success only";
}

TEST(TexelImage, HeadersThatPromiseMoreThanTheFileHoldsAreNotBelieved) {
  TexelImage image;
  EXPECT_EQ(read_texels("a.tga", tga(60000, 60000, "123456"), image),
            "its header says that it has 60000x60000 pixels, which do not fit a file of 24 bytes");
  EXPECT_EQ(read_texels("a.ppm", ppm(20000000, 5, ""), image),
            "its header says that it has 20000000x5 pixels, which do not fit a file of 18 bytes");
  // What deflate might still make of so few bytes is given up when the file ends.
  const MemoryScope scope(std::make_shared<MemoryBudget>(std::uint64_t{1} << 30));
  EXPECT_NE(read_texels("a.ppm", ppm(200, 200, "123456"), image), "");
}

/// A TIFF of four inks: one pixel, or a tile of 16 x 16.
std::string tiff_of_inks(std::uint16_t bits, bool tiled = false) {
  std::string file("II*\0\x08\0\0\0", 8);
  const int size = tiled ? 16 : 1, directory_bytes = 2 + 10 * 12 + 4, bits_at = 8 + directory_bytes;
  const int pixels_at = bits_at + 8, pixel_bytes = size * size * 4;
  // Of tiles: width, height, offset and bytes of one; of strips rows, offset and bytes.
  const std::vector<std::pair<int, std::vector<int>>> tiles = {
      {322, {16}}, {323, {16}}, {324, {pixels_at}}, {325, {pixel_bytes}}};
  const std::vector<std::pair<int, std::vector<int>>> strips = {
      {273, {pixels_at}}, {277, {4}}, {278, {1}}, {279, {pixel_bytes}}};
  std::vector<std::pair<int, std::vector<int>>> entries = {
      {256, {size}}, {257, {size}}, {258, {bits, bits, bits, bits}}, {259, {1}}, {262, {5}}};
  if (tiled) entries.push_back({277, {4}});
  entries.insert(entries.end(), tiled ? tiles.begin() : strips.begin(), tiled ? tiles.end() : strips.end());
  const auto put = [&](int value, int bytes) {
    for (int i = 0; i < bytes; ++i) file += static_cast<char>(value >> (8 * i));
  };
  put(static_cast<int>(entries.size()), 2);
  for (const auto& [tag, values] : entries) {
    put(tag, 2), put(3, 2), put(static_cast<int>(values.size()), 4);
    put(values.size() > 1 ? bits_at : values[0], 4);
  }
  file.resize(static_cast<std::size_t>(bits_at));
  for (int i = 0; i < 4; ++i) put(bits, 2);
  return file + std::string(static_cast<std::size_t>(pixel_bytes), 'x');
}

TEST(TexelImage, InksAreReadUnlessTheirDecoderWouldWritePastItsBuffer) {
  TexelImage image;
  EXPECT_EQ(read_texels("a.tif", tiff_of_inks(8), image), "");
  EXPECT_EQ(image.channels, 3);
  EXPECT_EQ(read_texels("a.tif", tiff_of_inks(4), image),
            "it holds inks (CMYK) in tiles or of fewer than 8 bits, accepted are strips of 8 bits and more");
  EXPECT_EQ(read_texels("a.tif", tiff_of_inks(8, true), image),
            "it holds inks (CMYK) in tiles or of fewer than 8 bits, accepted are strips of 8 bits and more");
}

TEST(TexelImage, RowsOfMillionsOfPixelsAreReadWithoutGigabytes) {
  TexelImage image;
  ASSERT_EQ(read_texels("a.ppm", ppm(1, 1, "123"), image), "")
      << "the module and its libraries come with the first image";
  constexpr std::uint32_t kWidth = 2000000, kHeight = 5;
  std::string pixels;
  for (std::uint32_t i = 0; i < kWidth * 3 * kHeight; ++i) pixels += static_cast<char>(i % 251);
  const std::string file = ppm(kWidth, kHeight, pixels);
  {
    const AddressSpaceLimit limit(std::uint64_t{300} << 20);
    ASSERT_EQ(read_texels("a.ppm", file, image), "");
  }
  EXPECT_EQ(std::string(image.bytes.begin(), image.bytes.end()), pixels);
}

TEST(TexelImage, WhatItsImageAndItsDecoderTakeIsCounted) {
  // 2 x 2 pixels of 3 bytes, twice.
  const std::string file = ppm(2, 2, "123456123456");
  for (const std::uint64_t limit : {24, 23}) {
    const auto budget = std::make_shared<MemoryBudget>(limit);
    const MemoryScope scope(budget);
    TexelImage image;
    if (limit == 24) {
      EXPECT_EQ(read_texels("a.ppm", file, image), "");
      EXPECT_EQ(budget->used(), 12u);
    } else {
      EXPECT_THROW(read_texels("a.ppm", file, image), MemoryExceeded);
      EXPECT_EQ(budget->used(), 0u);
    }
    EXPECT_EQ(image.width, limit == 24 ? 2 : 0) << "changed on success only";
  }
}

}  // namespace
}  // namespace norrsken
