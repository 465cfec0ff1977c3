// Radiance pictures, made byte by byte, and what becomes of them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "image/raster_image.h"
#include "image/texel_image.h"

namespace norrsken {
namespace {

using namespace std::string_literals;

/// A pixel of grey `value`, exact for small integers.
std::string grey(int value) {
  const auto byte = static_cast<char>(2 * value);  // 1 would be a run
  return {byte, byte, byte, static_cast<char>(128 + 7)};
}

std::string picture(const std::string& size, const std::string& pixels,
                    const std::string& header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n") {
  return header + size + "\n" + pixels;
}

/// The first channel from the top left, row by row.
std::vector<float> reds(const std::string& file) {
  RasterImage image;
  EXPECT_TRUE(is_radiance(file));
  EXPECT_EQ(read_radiance(file, image), "");
  EXPECT_TRUE(image.is_linear);
  EXPECT_EQ(image.channels, 3);
  std::vector<float> values;
  for (std::size_t i = 0; i < image.floats.size(); i += 3) values.push_back(image.floats[i]);
  return values;
}

std::string complaint(const std::string& file) {
  RasterImage image;
  return read_radiance(file, image);
}

TEST(Radiance, MantissasShareAnExponent) {
  RasterImage image;
  ASSERT_EQ(read_radiance(picture("-Y 1 +X 2", "\x80\x40\x20\x81\x20\x40\x80\x00"s), image), "");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(image.floats, (Array<float>{1, 0.5f, 0.25f, 0, 0, 0}));
}

TEST(Radiance, RowsAndColumnsComeInAnyOrder) {
  // The picture whose rows are 1 2 3 and 4 5 6, as each order has it.
  const std::vector<float> picture_rows{1, 2, 3, 4, 5, 6};
  const std::vector<std::pair<std::string, std::vector<int>>> orders = {
      {"-Y 2 +X 3", {1, 2, 3, 4, 5, 6}}, {"+Y 2 +X 3", {4, 5, 6, 1, 2, 3}}, {"-Y 2 -X 3", {3, 2, 1, 6, 5, 4}},
      {"+Y 2 -X 3", {6, 5, 4, 3, 2, 1}}, {"+X 3 -Y 2", {1, 4, 2, 5, 3, 6}}, {"-X 3 -Y 2", {3, 6, 2, 5, 1, 4}},
      {"+X 3 +Y 2", {4, 1, 5, 2, 6, 3}}, {"-X 3 +Y 2", {6, 3, 5, 2, 4, 1}}};
  for (const auto& [size, order] : orders) {
    std::string pixels;
    for (const int value : order) pixels += grey(value);
    EXPECT_EQ(reds(picture(size, pixels)), picture_rows) << size;
    TexelImage texels;
    ASSERT_EQ(read_texels(picture(size, pixels), texels), "");
    EXPECT_EQ(texels.width, 3);
    EXPECT_EQ(texels.height, 2);
  }
}

TEST(Radiance, HeaderLinesMayEndWithCarriageReturns) {
  EXPECT_EQ(reds(picture("-Y 1 +X 1\r", grey(3), "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n")),
            (std::vector<float>{3}));
}

TEST(Radiance, OtherLinesOfTheHeaderChangeNothing) {
  EXPECT_EQ(reds(picture("-Y 1 +X 1", grey(3),
                         "#?RGBE\n# made by hand\nEXPOSURE=4\nGAMMA=2.2\nPRIMARIES=0 0 0 0 0 0 0 0\nVIEW= -vtv\n\n")),
            (std::vector<float>{3}));
}

TEST(Radiance, RunsOfComponents) {
  // Nine pixels: reds 5 five times and then 1 2 3 4, the rest runs.
  const std::string line = "\2\2\0\x09"s + "\x85\5\4\1\2\3\4"s + "\x89\0"s + "\x89\0"s + "\x89\x88"s;
  EXPECT_EQ(reds(picture("-Y 2 +X 9", line + line)),
            (std::vector<float>{5, 5, 5, 5, 5, 1, 2, 3, 4, 5, 5, 5, 5, 5, 1, 2, 3, 4}));
  EXPECT_EQ(reds(picture("+X 2 -Y 9", line + line)).at(1), 5);
}

TEST(Radiance, RunsOfPixels) {
  EXPECT_EQ(reds(picture("-Y 1 +X 5", grey(7) + "\1\1\1\3"s + grey(2))), (std::vector<float>{7, 7, 7, 7, 2}));
  // Two run pixels behind each other are one number: 2 + 256.
  const auto values = reds(picture("-Y 1 +X 260", grey(7) + "\1\1\1\2\1\1\1\1"s + grey(2)));
  ASSERT_EQ(values.size(), 260u);
  EXPECT_EQ(values[258], 7);
  EXPECT_EQ(values[259], 2);
}

TEST(Radiance, XyzBecomesSrgb) {
  // D65's white times 128, to the nearest integers.
  RasterImage image;
  ASSERT_EQ(read_radiance(picture("-Y 1 +X 1", "\x7a\x80\x8b\x88"s, "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n"), image),
            "");
  for (const float value : image.floats) EXPECT_NEAR(value, 128, 1.5);
}

TEST(Radiance, WhatIsDamagedIsRefused) {
  EXPECT_EQ(complaint("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"), "its header has no end");
  EXPECT_EQ(complaint(picture("-Y 1 +X 1", grey(1), "#?RADIANCE\nFORMAT=16-bit\n\n")),
            "its FORMAT is neither 32-bit_rle_rgbe nor 32-bit_rle_xyze");
  for (const char* size :
       {"", "-Y 1", "-Y 1 +Y 1", "-Y 0 +X 1", "-Y 1 +X -1", "*Y 1 +X 1", "-Y 1 +X 1 1", "-Y 1 +X 99999999999"})
    EXPECT_EQ(complaint(picture(size, grey(1))), "its size is not given as in '-Y 512 +X 1024'") << size;
  EXPECT_EQ(complaint(picture("-Y 2 +X 1", grey(1))), "line 2 of its pixels is damaged or cut off");
  EXPECT_EQ(complaint(picture("-Y 1 +X 60000", "")), "line 1 of its pixels is damaged or cut off");
  EXPECT_EQ(complaint(picture("-Y 60000 +X 60000", "")),
            "its header says that it has 60000x60000 pixels, which do not fit a file of 53 bytes");
  const std::string damaged = "line 1 of its pixels is damaged or cut off";
  EXPECT_EQ(complaint(picture("-Y 1 +X 3", "\1\1\1\2"s + grey(1))), damaged) << "nothing to repeat";
  EXPECT_EQ(complaint(picture("-Y 1 +X 3", grey(1) + "\1\1\1\3"s)), damaged) << "more than the line has";
  EXPECT_EQ(complaint(picture("-Y 1 +X 9", "\2\2\0\x08\x88\1\x88\1\x88\1\x88\1"s)), damaged) << "another length";
  EXPECT_EQ(complaint(picture("-Y 1 +X 9", "\2\2\0\x09\x8a\1\x89\1\x89\1\x89\1"s)), damaged) << "too long a run";
  EXPECT_EQ(complaint(picture("-Y 1 +X 9", "\2\2\0\x09\0\x89\1\x89\1\x89\1"s)), damaged) << "a count of 0";
  const std::string whole =
      picture("-Y 2 +X 9", "\2\2\0\x09\x89\1\x89\1\x89\1\x89\1\2\2\0\x09\x89\1\x89\1\x89\1\x89\1"s);
  EXPECT_EQ(complaint(whole), "");
  for (std::size_t size = 2; size < whole.size(); ++size) EXPECT_NE(complaint(whole.substr(0, size)), "") << size;
}

TEST(Radiance, MemoryIsCounted) {
  const std::string file = picture("-Y 2 +X 2", grey(1) + grey(2) + grey(3) + grey(4));
  const MemoryScope scope(std::make_shared<MemoryBudget>(63));  // 4 bytes and 3 floats a pixel
  TexelImage image;
  EXPECT_THROW(read_texels(file, image), MemoryExceeded);
}

}  // namespace
}  // namespace norrsken
