#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "image/raster_image.h"

namespace norrsken {
namespace {

using namespace std::string_literals;
using Bytes8 = Array<std::uint8_t>;

RasterImage pnm(const std::string& file) {
  RasterImage image;
  EXPECT_TRUE(is_pnm(file)) << file;
  EXPECT_EQ(read_pnm(file, image), "") << file;
  return image;
}
std::string complaint(const std::string& file) {
  RasterImage image;
  return read_pnm(file, image);
}

TEST(Pnm, BytesOfGreysAndColours) {
  const RasterImage grey = pnm("P5\n3 2\n255\n\1\2\3\4\5\6"), color = pnm("P6 2 1 255\n\1\2\3\4\5\6");
  EXPECT_EQ(grey.width, 3);
  EXPECT_EQ(grey.height, 2);
  EXPECT_EQ(grey.channels, 1);
  EXPECT_FALSE(grey.is_linear);
  EXPECT_EQ(grey.bytes, (Bytes8{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(color.width, 2);
  EXPECT_EQ(color.channels, 3);
  EXPECT_EQ(color.bytes, (Bytes8{1, 2, 3, 4, 5, 6}));
}

TEST(Pnm, TextsWithComments) {
  EXPECT_EQ(pnm("P2#grey\n3 # wide\n2\n255 1 2 3# a row\n4\t5\r\n6").bytes, (Bytes8{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(pnm("P3\n2 1\n255\n1 2 3 4 5 6\n").bytes, (Bytes8{1, 2, 3, 4, 5, 6}));
}

TEST(Pnm, WhiteIsWhatTheHeaderSays) {
  EXPECT_EQ(pnm("P5 4 1 100\n\0\x32\x63\x64"s).bytes, (Bytes8{0, 128, 252, 255}));
  EXPECT_EQ(pnm("P2 3 1 15\n0 5 15").bytes, (Bytes8{0, 85, 255}));
  EXPECT_EQ(pnm("P5 2 1 65535\n\1\2\xff\xff").words, (Array<std::uint16_t>{0x102, 0xffff})) << "the high byte first";
  EXPECT_EQ(pnm("P2 3 1 1000\n0 500 1000").words, (Array<std::uint16_t>{0, 32768, 65535}));
  EXPECT_EQ(complaint("P5 2 1 100\n\1\x65"), "its pixels are cut off, or not numbers of 0 to 100");
  EXPECT_EQ(complaint("P5 2 1 0\n\1\1"), "its header does not say what white is, accepted are 1 to 65535");
  EXPECT_EQ(complaint("P5 2 1 65536\n\1\1"), "its header does not say what white is, accepted are 1 to 65535");
}

TEST(Pnm, BitsAreInk) {
  EXPECT_EQ(pnm("P1\n5 2\n10110\n0 1 0 0 1\n").bytes, (Bytes8{0, 255, 0, 0, 255, 255, 0, 255, 255, 0}));
  EXPECT_EQ(pnm("P4 9 2\n\xb2\x80\x01\x00"s).bytes,
            (Bytes8{0, 255, 0, 0, 255, 255, 0, 255, 0, 255, 255, 255, 255, 255, 255, 255, 0, 255}));
}

std::string floats(std::initializer_list<float> values, bool is_big_endian) {
  std::string bytes;
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(bits >> (is_big_endian ? 24 - 8 * i : 8 * i) & 0xff);
  }
  return bytes;
}

TEST(Pfm, FloatsFromTheBottomInBothOrdersOfBytes) {
  for (const bool is_big_endian : {false, true}) {
    const std::string scale = is_big_endian ? "1" : "-1.0";
    const RasterImage grey = pnm("Pf\n2 2\n" + scale + "\n" + floats({1, -2.5f, 3e20f, 4}, is_big_endian));
    EXPECT_EQ(grey.channels, 1);
    EXPECT_TRUE(grey.is_linear);
    EXPECT_EQ(grey.floats, (Array<float>{3e20f, 4, 1, -2.5f}));
    const RasterImage color = pnm("PF\n1 2\n" + scale + "\n" + floats({1, 2, 3, 4, 5, 6}, is_big_endian));
    EXPECT_EQ(color.channels, 3);
    EXPECT_EQ(color.floats, (Array<float>{4, 5, 6, 1, 2, 3}));
  }
  EXPECT_EQ(pnm("Pf 1 1 -2.5\n" + floats({2}, false)).floats, (Array<float>{5})) << "times their scale";
  for (const char* scale : {"0", "nan", "x"}) {
    EXPECT_EQ(complaint("Pf 1 1 "s + scale + "\n" + floats({2}, false)), "its header has no scale") << scale;
  }
}

TEST(Pnm, WhatIsCutOffIsRefused) {
  for (const std::string& whole : {"P6\n2 1\n255\n123456"s, "P4\n9 2\n1234"s, "P3\n2 1\n255\n1 2 3 4 5 6"s,
                                   "PF 1 1 -1\n123456789012"s, "P1\n3 1\n101"s}) {
    EXPECT_EQ(complaint(whole), "") << whole;
    for (std::size_t size = 3; size < whole.size(); ++size) EXPECT_NE(complaint(whole.substr(0, size)), "") << size;
  }
  EXPECT_EQ(complaint("P6\n30000 10000\n255\nabc"),
            "its header says that it has 30000x10000 pixels, which do not fit a file of 22 bytes");
}

TEST(Pnm, SizesAreHeldAgainstTheFile) {
  EXPECT_EQ(complaint("P5\n0 1\n255\n"), "it has no pixels");
  EXPECT_EQ(complaint("P5\n1 -1\n255\n"), "it has no pixels");
  EXPECT_EQ(complaint("P5\n1\n"), "its header is damaged or cut off");
  EXPECT_EQ(complaint("P5\n99999999999 1\n255\n"), "its header is damaged or cut off");
  EXPECT_EQ(complaint("P5\n2147483647 2147483647\n255\n"),
            "it has 2147483647x2147483647 pixels of 1 channels, accepted are 1073741824 values in all");
}

TEST(Pnm, OtherKindsAreNot) {
  for (const char* other : {"P7\n", "P0\n", "P55", "PF", "p5\n", "BM\n"}) EXPECT_FALSE(is_pnm(other)) << other;
}

}  // namespace
}  // namespace norrsken
