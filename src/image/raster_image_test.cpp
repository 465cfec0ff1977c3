// BMP and TGA files, made byte by byte, and what becomes of them.
#include "image/raster_image.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "color/srgb.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

using namespace std::string_literals;
using Bytes8 = Array<std::uint8_t>;

std::string little_endian(std::initializer_list<std::pair<std::uint32_t, int>> numbers) {
  std::string bytes;
  for (auto [value, size] : numbers) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(std::uint64_t{value} >> (8 * i) & 0xff);
  }
  return bytes;
}

struct BmpFile {
  std::int32_t width = 2, height = 1;
  std::uint32_t bits = 24, compression = 0, colors = 0;
  std::string behind_header = {};  ///< masks of a 40-byte header, or palette
  std::string pixels = {};
  std::uint32_t header_bytes = 40;

  std::string text() const {
    const auto body = [&] {
      if (header_bytes == 12) {
        return little_endian(
                   {{static_cast<std::uint32_t>(width), 2}, {static_cast<std::uint32_t>(height), 2}, {1, 2}}) +
               little_endian({{bits, 2}});
      }
      return little_endian({{static_cast<std::uint32_t>(width), 4}, {static_cast<std::uint32_t>(height), 4}, {1, 2}}) +
             little_endian({{bits, 2}, {compression, 4}, {0, 4}, {2835, 4}, {2835, 4}, {colors, 4}, {0, 4}});
    }();
    const auto pixels_at = static_cast<std::uint32_t>(18 + body.size() + behind_header.size());
    return "BM" + little_endian({{0, 4}, {0, 4}, {pixels_at, 4}, {header_bytes, 4}}) + body + behind_header + pixels;
  }
};

/// What is read of it, which must be without complaint.
RasterImage bmp(const BmpFile& file) {
  RasterImage image;
  EXPECT_TRUE(is_bmp(file.text()));
  EXPECT_EQ(read_bmp(file.text(), image), "");
  return image;
}
std::string bmp_complaint(const BmpFile& file) {
  RasterImage image;
  return read_bmp(file.text(), image);
}

TEST(Bmp, RowsAreReadFromTheBottomAndColoursFromBlue) {
  const RasterImage image = bmp({.height = 2, .pixels = "\7\10\11\12\13\14\0\0\1\2\3\4\5\6\0\0"s});
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.channels, 3);
  EXPECT_EQ(image.bytes, (Bytes8{3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}));
}

TEST(Bmp, NegativeHeightsAreReadFromTheTop) {
  EXPECT_EQ(bmp({.width = 1, .height = -2, .pixels = "\1\2\3\0\4\5\6\0"s}).bytes, (Bytes8{3, 2, 1, 6, 5, 4}));
}

TEST(Bmp, TheLastRowMayLackItsPadding) {
  EXPECT_EQ(bmp({.width = 1, .height = 2, .pixels = "\1\2\3\0\4\5\6"s}).bytes, (Bytes8{6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(bmp_complaint({.width = 1, .height = 2, .pixels = "\1\2\3\0\4\5"s}),
            "its header says that it has 1x2 pixels, which do not fit a file of 60 bytes");
}

TEST(Bmp, PalettesOfEightFourAndOneBits) {
  const std::string palette = "\1\2\3\0\4\5\6\0"s;
  const Bytes8 colors{6, 5, 4, 3, 2, 1};
  EXPECT_EQ(bmp({.bits = 8, .colors = 2, .behind_header = palette, .pixels = "\1\0\0\0"s}).bytes, colors);
  EXPECT_EQ(bmp({.bits = 4, .colors = 2, .behind_header = palette, .pixels = "\x10\0\0\0"s}).bytes, colors);
  EXPECT_EQ(bmp({.bits = 1, .colors = 2, .behind_header = palette, .pixels = "\x80\0\0\0"s}).bytes, colors);
  EXPECT_EQ(bmp({.bits = 1, .behind_header = palette, .pixels = "\x80\0\0\0"s}).bytes, colors) << "all of them";
}

TEST(Bmp, APaletteOfGreysMakesAGreyImage) {
  const RasterImage image = bmp({.bits = 1, .behind_header = "\1\1\1\0\xff\xff\xff\0"s, .pixels = "\x40\0\0\0"s});
  EXPECT_EQ(image.channels, 1);
  EXPECT_EQ(image.bytes, (Bytes8{1, 255}));
}

TEST(Bmp, SixteenBitsAreFiveOfEachUnlessMasksSayOtherwise) {
  // Red 31; green 16, blue 1.
  EXPECT_EQ(bmp({.bits = 16, .pixels = "\0\x7c\1\2"s}).bytes, (Bytes8{255, 0, 0, 0, 132, 8}));
  const std::string masks = little_endian({{0xf800, 4}, {0x07e0, 4}, {0x001f, 4}});
  EXPECT_EQ(bmp({.bits = 16, .compression = 3, .behind_header = masks, .pixels = "\0\xf8\xe1\7"s}).bytes,
            (Bytes8{255, 0, 0, 0, 255, 8}));
  EXPECT_EQ(bmp_complaint({.bits = 16, .compression = 3, .behind_header = little_endian({{5, 4}, {0, 4}, {0, 4}})}),
            "the bits of its channels are not next to each other");
}

TEST(Bmp, ThirtyTwoBitsHaveAlphaIfItsMaskIsThere) {
  EXPECT_EQ(bmp({.width = 1, .bits = 32, .pixels = "\1\2\3\4"s}).bytes, (Bytes8{3, 2, 1}));
  const std::string masks = little_endian({{0xff, 4}, {0xff00, 4}, {0xff0000, 4}, {0xff000000, 4}});
  const RasterImage image =
      bmp({.width = 1, .bits = 32, .compression = 6, .behind_header = masks, .pixels = "\1\2\3\4"s});
  EXPECT_EQ(image.channels, 4);
  EXPECT_EQ(image.bytes, (Bytes8{1, 2, 3, 4}));
  // In later headers the masks are fields.
  BmpFile later{.width = 1, .bits = 32, .compression = 3, .behind_header = masks, .pixels = "\1\2\3\4"s};
  later.header_bytes = 56;
  EXPECT_EQ(bmp(later).bytes, (Bytes8{1, 2, 3, 4}));
}

TEST(Bmp, PalettesFollowLaterHeaders) {
  BmpFile file{.bits = 1, .behind_header = std::string(68, 'x') + "\1\2\3\0\4\5\6\0"s, .pixels = "\x80\0\0\0"s};
  file.header_bytes = 108;
  EXPECT_EQ(bmp(file).bytes, (Bytes8{6, 5, 4, 3, 2, 1}));
}

TEST(Bmp, TheHeaderOfOs2HasColoursOfThreeBytes) {
  BmpFile file{.bits = 1, .behind_header = "\1\2\3\4\5\6"s, .pixels = "\x80\0\0\0"s};
  file.header_bytes = 12;
  EXPECT_EQ(bmp(file).bytes, (Bytes8{6, 5, 4, 3, 2, 1}));
}

/// What is read of a BMP whose palette is 0, 1, 2, ... of grey and whose pixels are runs: its bytes, or the complaint.
std::string indices_in_runs(std::uint32_t bits, std::int32_t width, std::int32_t height, const std::string& runs) {
  BmpFile file{.width = width, .height = height, .bits = bits, .compression = bits == 8 ? 1u : 2u, .pixels = runs};
  for (char i = 0; i < 16; ++i) file.behind_header += {i, i, i, 0};
  file.colors = 16;
  RasterImage image;
  const std::string complaint = read_bmp(file.text(), image);
  return complaint.empty() ? std::string(image.bytes.begin(), image.bytes.end()) : complaint;
}

TEST(Bmp, RunsOfEightBits) {
  EXPECT_EQ(indices_in_runs(8, 5, 1, "\2\7\0\3\1\2\3\0\0\1"s), "\7\7\1\2\3") << "a run, three as they are";
  EXPECT_EQ(indices_in_runs(8, 2, 2, "\2\1\0\0\2\2\0\1"s), "\2\2\1\1") << "the bottom row first";
  EXPECT_EQ(indices_in_runs(8, 2, 3, "\1\1\0\2\0\2\1\5\0\1"s), "\0\5\0\0\1\0"s) << "what is passed over is zero";
  EXPECT_EQ(indices_in_runs(8, 2, 1, "\4\1\0\1"s), "\1\1") << "what is right of the image is not in it";
  EXPECT_EQ(indices_in_runs(8, 2, 1, "\2\7"s), "\7\7") << "the mark of the end may be missing";
}

TEST(Bmp, RunsOfFourBits) {
  EXPECT_EQ(indices_in_runs(4, 3, 1, "\3\x12\0\1"s), "\1\2\1");
  EXPECT_EQ(indices_in_runs(4, 6, 1, "\1\x70\0\5\x12\x34\x50\0\0\1"s), "\7\1\2\3\4\5");
}

TEST(Bmp, RunsThatLeaveTheImageAreRefused) {
  const std::string complaint = "its pixels are cut off, or more than it has room for";
  for (const std::string& runs :
       {""s, "\1"s, "\1\1"s, "\1\1\0"s, "\0\0\1\1\0\1"s, "\0\2\0"s, "\0\2\0\1\1\1\0\1"s, "\0\3\1\2\3"s}) {
    EXPECT_EQ(indices_in_runs(8, 2, 1, runs), complaint);
  }
  EXPECT_EQ(indices_in_runs(8, 1, 1, "\1\x10\0\1"s), "a pixel has a colour that its palette lacks");
  EXPECT_EQ(indices_in_runs(8, 1, 1, "\1\1\0\0\0\1"s), "\1") << "the last row's end";
}

TEST(Bmp, WhatIsNotReadIsRefused) {
  const std::string ways = ", accepted are 0 (not), 1 for 8 bits, 2 for 4 bits, and 3 and 6 for 16 and 32 bits";
  EXPECT_EQ(bmp_complaint({.bits = 24, .compression = 1}), "its 24 bits a pixel are compressed in way 1" + ways);
  EXPECT_EQ(bmp_complaint({.bits = 8, .compression = 2}), "its 8 bits a pixel are compressed in way 2" + ways);
  EXPECT_EQ(bmp_complaint({.bits = 1, .compression = 2}), "its 1 bits a pixel are compressed in way 2" + ways);
  EXPECT_EQ(bmp_complaint({.bits = 24, .compression = 3}), "its 24 bits a pixel are compressed in way 3" + ways);
  EXPECT_EQ(bmp_complaint({.bits = 7}), "it has 7 bits a pixel, accepted are 1, 4, 8, 16, 24 and 32");
  EXPECT_EQ(bmp_complaint({.bits = 4, .colors = 17}), "it has a palette of 17 colours, accepted are 16");
  EXPECT_EQ(bmp_complaint({.bits = 4, .colors = 16}), "it has no palette");
  std::string inside = BmpFile{.pixels = std::string(100, 'x')}.text();
  inside[10] = 53;
  EXPECT_EQ(bmp_complaint({.width = -2}), "it has no pixels");
  EXPECT_EQ(bmp_complaint({.height = 0}), "it has no pixels");
  EXPECT_EQ(bmp_complaint({.height = std::numeric_limits<std::int32_t>::min()}),
            "it has 2x2147483648 pixels of 3 channels, accepted are 1073741824 values in all");
  EXPECT_EQ(bmp_complaint({.width = 30000,
                           .height = 30000,
                           .bits = 8,
                           .compression = 1,
                           .behind_header = "\1\1\1\0"s,
                           .pixels = "\0\1"s}),
            "its header says that it has 30000x30000 pixels, which do not fit a file of 60 bytes");
  EXPECT_EQ(bmp_complaint({.width = 20000000, .height = 5}),
            "its header says that it has 20000000x5 pixels, which do not fit a file of 54 bytes");
  EXPECT_EQ(bmp_complaint({.bits = 8, .colors = 1, .behind_header = "\0\0\0\0"s, .pixels = "\0\1\0\0"s}),
            "a pixel has a colour that its palette lacks");
  BmpFile file;
  file.header_bytes = 13;
  EXPECT_EQ(bmp_complaint(file), "its header has 13 bytes, accepted are 12 and from 40 on");
  const std::string whole = BmpFile{.bits = 1, .colors = 2}.text();
  RasterImage image;
  EXPECT_EQ(read_bmp(inside, image), "its pixels begin within its header");
  for (std::size_t size = 2; size < whole.size(); ++size) {
    EXPECT_EQ(read_bmp(whole.substr(0, size), image), "its header is cut off") << size;
  }
}

struct TgaFile {
  std::uint32_t type = 2, bits = 24;
  std::uint32_t width = 2, height = 1;
  std::string pixels = {};
  std::uint32_t descriptor = 0x20;  ///< top row first
  std::uint32_t palette_bits = 0, palette_first = 0, palette_length = 0;
  std::string palette = {};
  std::string id = {};

  std::string text() const {
    const auto id_bytes = static_cast<std::uint32_t>(id.size());
    return little_endian({{id_bytes, 1}, {palette_bits > 0 ? 1u : 0u, 1}, {type, 1}, {palette_first, 2}}) +
           little_endian({{palette_length, 2}, {palette_bits, 1}, {0, 4}, {width, 2}, {height, 2}, {bits, 1}}) +
           little_endian({{descriptor, 1}}) + id + palette + pixels;
  }
};

RasterImage tga(const TgaFile& file) {
  RasterImage image;
  EXPECT_TRUE(is_targa(file.text()));
  EXPECT_EQ(read_targa(file.text(), image), "");
  return image;
}
std::string tga_complaint(const TgaFile& file) {
  RasterImage image;
  return read_targa(file.text(), image);
}

TEST(Targa, ColoursOfEveryDepth) {
  EXPECT_EQ(tga({.pixels = "\3\2\1\6\5\4"}).bytes, (Bytes8{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(tga({.bits = 16, .pixels = "\0\x7c\1\x82"s}).bytes, (Bytes8{255, 0, 0, 0, 132, 8}));
  EXPECT_EQ(tga({.bits = 15, .width = 1, .pixels = "\xe0\3"}).bytes, (Bytes8{0, 255, 0}));
  const RasterImage image = tga({.bits = 32, .width = 1, .pixels = "\3\2\1\4"});
  EXPECT_EQ(image.channels, 4);
  EXPECT_EQ(image.bytes, (Bytes8{1, 2, 3, 4}));
}

TEST(Targa, GreyWithAndWithoutAlpha) {
  EXPECT_EQ(tga({.type = 3, .bits = 8, .pixels = "\1\2"}).bytes, (Bytes8{1, 2}));
  const RasterImage image = tga({.type = 3, .bits = 16, .width = 1, .pixels = "\1\2"});
  EXPECT_EQ(image.channels, 2);
  EXPECT_EQ(image.bytes, (Bytes8{1, 2}));
}

TEST(Targa, TheFirstPixelMayBeInAnyCorner) {
  const TgaFile file{.type = 3, .bits = 8, .width = 2, .height = 3, .pixels = "\1\2\3\4\5\6"};
  const auto from = [&](std::uint32_t descriptor) {
    TgaFile turned = file;
    turned.descriptor = descriptor;
    return tga(turned).bytes;
  };
  EXPECT_EQ(from(0x20), (Bytes8{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(from(0x00), (Bytes8{5, 6, 3, 4, 1, 2}));
  EXPECT_EQ(from(0x30), (Bytes8{2, 1, 4, 3, 6, 5}));
  EXPECT_EQ(from(0x10), (Bytes8{6, 5, 4, 3, 2, 1}));
}

TEST(Targa, RunsMayCrossRowsAndEndWithTheImage) {
  // Three times 7; then 8 and 9; then a run of which one pixel is left.
  const TgaFile file{.type = 11, .bits = 8, .width = 2, .height = 3, .pixels = "\x82\7\1\10\11\x8f\12"};
  EXPECT_EQ(tga(file).bytes, (Bytes8{7, 7, 7, 8, 9, 10}));
  EXPECT_EQ(tga({.type = 10, .pixels = "\x81\3\2\1"}).bytes, (Bytes8{1, 2, 3, 1, 2, 3}));
}

TEST(Targa, PalettesMayBeginAtAnyIndex) {
  TgaFile file{.type = 1,
               .bits = 8,
               .pixels = "\6\5",
               .palette_bits = 24,
               .palette_first = 5,
               .palette_length = 2,
               .palette = "\3\2\1\6\5\4",
               .id = "named"};
  EXPECT_EQ(tga(file).bytes, (Bytes8{4, 5, 6, 1, 2, 3}));
  for (const char* beyond : {"\5\7", "\5\4"}) {
    file.pixels = beyond;
    EXPECT_EQ(tga_complaint(file), "a pixel has a colour that its palette lacks");
  }
  file.bits = 16;
  file.pixels = "\6\0\5\0"s;
  EXPECT_EQ(tga(file).bytes, (Bytes8{4, 5, 6, 1, 2, 3}));
  // A palette that is not used is passed over.
  EXPECT_EQ(tga({.pixels = "\3\2\1\6\5\4", .palette_bits = 16, .palette_length = 1, .palette = "xx"}).bytes,
            (Bytes8{1, 2, 3, 4, 5, 6}));
}

TEST(Targa, WhatIsCutOffIsRefused) {
  EXPECT_EQ(tga_complaint({.pixels = "\3\2\1\6\5"}),
            "its header says that it has 2x1 pixels, which do not fit a file of 23 bytes");
  EXPECT_EQ(tga_complaint({.type = 10, .pixels = "\x80\3\2\1"}), "its pixels are cut off");
  EXPECT_EQ(tga_complaint({.type = 10, .pixels = "\1\3\2\1\6\5"}), "its pixels are cut off");
  EXPECT_EQ(tga_complaint({.type = 10, .width = 60000, .height = 60000, .pixels = "\x80\3\2\1"}),
            "its header says that it has 60000x60000 pixels, which do not fit a file of 22 bytes");
  EXPECT_EQ(tga_complaint({.width = 0}), "it has no pixels");
  EXPECT_EQ(tga_complaint({.type = 1, .bits = 8, .palette_bits = 24, .palette_length = 2, .palette = "\3\2\1\6\5"}),
            "its palette is cut off");
}

TEST(Targa, OnlyItsOwnHeadersAreTakenForIt) {
  for (const TgaFile& file :
       {TgaFile{}, TgaFile{.type = 1, .bits = 8, .palette_bits = 24}, TgaFile{.type = 3, .bits = 8}}) {
    const std::string valid = file.text() + std::string(30, '\0');
    ASSERT_TRUE(is_targa(valid));
    for (const std::string& other : {"\x89PNG\r\n\x1a\n"s, "\xff\xd8\xff\xe0"s, "II*\0"s, "MM\0*"s, "v/1\1"s,
                                     "#?RADIANCE\n"s, "P6\n1 1\n255\n"s, "PF\n1 1\n-1.0\n"s, "BM"s}) {
      EXPECT_FALSE(is_targa(other + valid.substr(other.size()))) << other;
    }
  }
  EXPECT_FALSE(is_targa(""));
  EXPECT_FALSE(is_targa(TgaFile{.bits = 17}.text()));
  EXPECT_FALSE(is_targa(TgaFile{.type = 4}.text()));
  EXPECT_FALSE(is_targa(TgaFile{.type = 0}.text()));
  EXPECT_FALSE(is_targa(TgaFile{.type = 1, .bits = 8}.text())) << "no palette";
}

TEST(RasterImage, BecomesChannelsOfLinearColourAndTexelsWithoutAlpha) {
  const TemporaryFolder folder;
  const std::string contents = TgaFile{.bits = 32, .pixels = "\3\2\1\x33\6\5\4\xff"}.text();
  const Result<Image> read = read_image(folder.write("a.tga", contents));
  ASSERT_TRUE(read) << read.error();
  const Image& image = *read;
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  ASSERT_NE(image.find("A"), nullptr);
  EXPECT_EQ(image.find("A")->values, (std::vector<float>{0.2f, 1}));
  EXPECT_EQ(image.find("R")->values, (std::vector<float>{linear_from_srgb(1 / 255.0f), linear_from_srgb(4 / 255.0f)}));
  EXPECT_EQ(image.find("B")->values, (std::vector<float>{linear_from_srgb(3 / 255.0f), linear_from_srgb(6 / 255.0f)}));
  TexelImage texels;
  ASSERT_EQ(read_texels(contents, texels), "");
  EXPECT_EQ(texels.channels, 3);
  EXPECT_EQ(texels.bytes, (Bytes8{1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(read_texels(TgaFile{.type = 3, .bits = 16, .pixels = "\1\2\3\4"}.text(), texels), "");
  EXPECT_EQ(texels.channels, 1);
  EXPECT_EQ(texels.bytes, (Bytes8{1, 3}));
}

TEST(RasterImage, MemoryIsCounted) {
  const std::string contents = TgaFile{.pixels = "\3\2\1\6\5\4"}.text();
  Image image;
  EXPECT_EQ(read_image_contents(contents, 6 + 24, image), "");
  EXPECT_NE(read_image_contents(contents, 6 + 23, image), "");
  const auto budget = std::make_shared<MemoryBudget>(5);
  const MemoryScope scope(budget);
  TexelImage texels;
  EXPECT_THROW(read_raster_texels(contents, texels), MemoryExceeded);
  EXPECT_EQ(budget->used(), 0u);
}

}  // namespace
}  // namespace norrsken
