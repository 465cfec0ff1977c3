#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <memory>
#include <string>
#include <vector>

#include "color/srgb.h"
#include "image/raster_image.h"
#include "tests/address_space_limit.h"

namespace norrsken {
namespace {

using namespace std::string_literals;
using Bytes8 = Array<std::uint8_t>;

struct PngFile {
  int width = 2, height = 1;
  int bits = 8, color = PNG_COLOR_TYPE_GRAY;
  std::string pixels = {};  ///< as stored, big-endian
  bool interlaced = false;
  double gamma = 0;  ///< if not 0
  std::vector<png_color> palette = {};
  std::string palette_alpha = {};
  std::string title = "rummet";  ///< compressed

  std::string text() const {
    std::string file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    const auto write = [](png_structp to, png_bytep bytes, std::size_t count) {
      static_cast<std::string*>(png_get_io_ptr(to))->append(reinterpret_cast<char*>(bytes), count);
    };
    png_set_write_fn(png, &file, write, [](png_structp) {});
    png_set_IHDR(png, info, width, height, bits, color, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, 0, 0);
    if (gamma > 0) png_set_gAMA(png, info, gamma);
    if (!palette.empty()) png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    const auto* alpha = reinterpret_cast<const std::uint8_t*>(palette_alpha.data());
    if (!palette_alpha.empty()) png_set_tRNS(png, info, alpha, static_cast<int>(palette_alpha.size()), nullptr);
    png_text note{};
    char key[] = "Title";
    std::string value = title;
    note.compression = PNG_TEXT_COMPRESSION_zTXt;
    note.key = key;
    note.text = value.data();
    png_set_text(png, info, &note, 1);
    png_write_info(png, info);
    const std::size_t row = png_get_rowbytes(png, info);
    const int passes = png_set_interlace_handling(png);
    for (int pass = 0; pass < passes; ++pass) {
      for (int y = 0; y < height; ++y) {
        png_write_row(png, reinterpret_cast<const std::uint8_t*>(pixels.data()) + y * row);
      }
    }
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file;
  }
};

RasterImage png(const PngFile& file) {
  RasterImage image;
  EXPECT_TRUE(is_png(file.text()));
  EXPECT_EQ(read_png(file.text(), image), "");
  return image;
}

TEST(Png, EightBitsAndFewerAreEight) {
  const RasterImage image = png({.pixels = "\1\2"});
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(image.channels, 1);
  EXPECT_FALSE(image.is_linear);
  EXPECT_EQ(image.bytes, (Bytes8{1, 2}));
  EXPECT_EQ(image.metadata.at("Title"), "rummet");
  EXPECT_EQ(png({.bits = 1, .pixels = "\x40"}).bytes, (Bytes8{0, 255}));
  EXPECT_EQ(png({.bits = 4, .pixels = "\x1f"}).bytes, (Bytes8{17, 255}));
  EXPECT_EQ(png({.color = PNG_COLOR_TYPE_GRAY_ALPHA, .pixels = "\1\2\3\4"}).channels, 2);
  EXPECT_EQ(png({.color = PNG_COLOR_TYPE_RGB, .pixels = "\1\2\3\4\5\6"}).bytes, (Bytes8{1, 2, 3, 4, 5, 6}));
}

TEST(Png, PalettesBecomeColoursAndTheirAlpha) {
  PngFile file{.bits = 1, .color = PNG_COLOR_TYPE_PALETTE, .pixels = "\x40", .palette = {{1, 2, 3}, {4, 5, 6}}};
  EXPECT_EQ(png(file).bytes, (Bytes8{1, 2, 3, 4, 5, 6}));
  file.palette_alpha = "\7";
  const RasterImage image = png(file);
  EXPECT_EQ(image.channels, 4);
  EXPECT_EQ(image.bytes, (Bytes8{1, 2, 3, 7, 4, 5, 6, 255}));
}

TEST(Png, SixteenBitsAreKept) {
  const std::string contents = PngFile{.bits = 16, .pixels = "\1\2\xff\xff"}.text();
  RasterImage image;
  ASSERT_EQ(read_png(contents, image), "");
  EXPECT_TRUE(image.bytes.empty());
  EXPECT_EQ(image.words, (Array<std::uint16_t>{0x102, 0xffff}));
  TexelImage texels;
  ASSERT_EQ(read_raster_texels(contents, texels), "");
  EXPECT_TRUE(texels.is_encoded);
  EXPECT_EQ(texels.values, (Array<float>{258.0f / 65535, 1}));
  Image channels;
  ASSERT_EQ(read_image_contents(contents, 1 << 10, channels), "");
  EXPECT_EQ(channels.find("Y")->values, (std::vector<float>{linear_from_srgb(258.0f / 65535), 1}));
}

TEST(Png, ColoursAreAsStoredIfTheirGammaIsOne) {
  EXPECT_TRUE(png({.pixels = "\1\2", .gamma = 1}).is_linear);
  EXPECT_FALSE(png({.pixels = "\1\2", .gamma = 1 / 2.2}).is_linear);
}

TEST(Png, InterlacedPixelsComeIntoTheirPlaces) {
  PngFile file{.width = 11, .height = 9, .interlaced = true};
  for (char i = 0; i < 99; ++i) file.pixels += i;
  const RasterImage image = png(file);
  EXPECT_EQ(std::string(image.bytes.begin(), image.bytes.end()), file.pixels);
}

TEST(Png, DamageIsToldAndCostsNoMemory) {
  const std::string whole = PngFile{.width = 40, .height = 40, .pixels = std::string(1600, 'x')}.text();
  for (std::size_t size = 8; size < whole.size() - 16; ++size) {  // the end mark may be missing
    RasterImage image;
    EXPECT_NE(read_png(whole.substr(0, size), image), "") << size;
  }
  std::string changed = whole;
  changed[20] = 'x';
  RasterImage image;
  EXPECT_EQ(read_png(changed, image), "IHDR: CRC error");
  // Rows are made as they come.
  const auto budget = std::make_shared<MemoryBudget>(std::uint64_t{1} << 20);
  const MemoryScope scope(budget);
  EXPECT_THROW(png({.width = 2000, .height = 2000, .pixels = std::string(4000000, 'x')}), MemoryExceeded);
  EXPECT_EQ(budget->used(), 0u);
}

TEST(Png, TextThatIsLongOnceItIsUnpackedIsLeftOut) {
  PngFile file{.pixels = "\1\2"};
  file.title = std::string(4 << 20, 'x');
  const std::string contents = file.text();
  ASSERT_LT(contents.size(), 10000u);
  RasterImage image;
  const AddressSpaceLimit limit(std::uint64_t{64} << 20);
  EXPECT_EQ(read_png(contents, image), "");
  EXPECT_EQ(image.bytes, (Bytes8{1, 2}));
  EXPECT_TRUE(image.metadata.empty());
}

/// The file with a header of other measures, and its checksum.
std::string with_size(std::string file, std::uint32_t width, std::uint32_t height) {
  std::string header = "IHDR";
  for (const std::uint32_t size : {width, height}) {
    for (int shift = 24; shift >= 0; shift -= 8) header += static_cast<char>(size >> shift & 0xff);
  }
  header += file.substr(24, 5);
  const auto crc = crc32(0, reinterpret_cast<const std::uint8_t*>(header.data()), static_cast<unsigned>(header.size()));
  file.replace(12, header.size(), header);
  for (int i = 0; i < 4; ++i) file[29 + i] = static_cast<char>(crc >> (24 - 8 * i) & 0xff);
  return file;
}

TEST(Png, HeadersThatPromiseMoreThanTheFileHoldsAreNotBelieved) {
  const std::string file = PngFile{.pixels = "\1\2"}.text();
  const AddressSpaceLimit limit(std::uint64_t{64} << 20);
  RasterImage image;
  EXPECT_EQ(read_png(with_size(file, 50000, 40000), image),
            "its header says that it has 50000x40000 pixels, which do not fit a file of " +
                std::to_string(file.size()) + " bytes");
  EXPECT_EQ(read_png(with_size(file, 1u << 30, 1), image),
            "its header says that it has 1073741824x1 pixels, which do not fit a file of " +
                std::to_string(file.size()) + " bytes");
}

}  // namespace
}  // namespace norrsken
