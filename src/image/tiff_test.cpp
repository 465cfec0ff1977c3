#include <Imath/half.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "image/raster_image.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

using Bytes8 = Array<std::uint8_t>;
using Words16 = Array<std::uint16_t>;

/// A picture and how it is stored. `rows` are the bytes of one row of pixels each, of one channel each if it is planar.
struct TiffFile {
  int width = 2, height = 1, samples = 1, bits = 8;
  std::vector<std::string> rows = {};
  int colors = PHOTOMETRIC_MINISBLACK, numbers = SAMPLEFORMAT_UINT, compression = COMPRESSION_NONE;
  bool is_planar = false;
  std::uint16_t extra = EXTRASAMPLE_UNASSALPHA;  ///< of what is no colour, if there is any
  int tile = 0;                                  ///< if not 0
  std::vector<std::uint16_t> palette = {};       ///< reds, then greens, then blues
  const char* mode = "wl";
  std::function<void(TIFF*)> more = {};

  int extra_samples() const {
    return std::max(0, samples - (colors == PHOTOMETRIC_RGB ? 3 : colors == PHOTOMETRIC_SEPARATED ? 4 : 1));
  }

  std::string text() const {
    TIFFSetWarningHandler(nullptr);  // the writer has some
    const TemporaryFolder folder;
    const std::string path = folder.file("a.tif");
    TIFF* tiff = TIFFOpen(path.c_str(), mode);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, colors);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, numbers);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, is_planar ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
    const std::vector<std::uint16_t> extras(static_cast<std::size_t>(extra_samples()), extra);
    if (!extras.empty()) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, static_cast<int>(extras.size()), extras.data());
    const auto third = static_cast<std::ptrdiff_t>(palette.size() / 3);
    if (third > 0) TIFFSetField(tiff, TIFFTAG_COLORMAP, &palette[0], &palette[third], &palette[2 * third]);
    if (more) more(tiff);
    if (tile > 0) {
      TIFFSetField(tiff, TIFFTAG_TILEWIDTH, tile);
      TIFFSetField(tiff, TIFFTAG_TILELENGTH, tile);
      write_tiles(tiff);
    } else {
      TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 2);
      for (int y = 0; y < static_cast<int>(rows.size()); ++y) {
        std::string row = rows[y];
        TIFFWriteScanline(tiff, row.data(), y % height, static_cast<std::uint16_t>(y / height));
      }
    }
    TIFFClose(tiff);
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    return bytes.str();
  }

  void write_tiles(TIFF* tiff) const {
    const int pixel = (is_planar ? 1 : samples) * bits / 8, planes = is_planar ? samples : 1;
    for (int plane = 0; plane < planes; ++plane) {
      for (int top = 0; top < height; top += tile) {
        for (int left = 0; left < width; left += tile) {
          std::string block(static_cast<std::size_t>(tile * tile * pixel), 'x');
          for (int y = top; y < std::min(height, top + tile); ++y) {
            const std::string part = rows[plane * height + y].substr(left * pixel, tile * pixel);
            block.replace(static_cast<std::size_t>((y - top) * tile * pixel), part.size(), part);
          }
          TIFFWriteTile(tiff, block.data(), left, top, 0, static_cast<std::uint16_t>(plane));
        }
      }
    }
  }
};

RasterImage tiff(const TiffFile& file) {
  RasterImage image;
  EXPECT_TRUE(is_tiff(file.text()));
  EXPECT_EQ(read_tiff(file.text(), image), "");
  return image;
}
std::string complaint(const TiffFile& file) {
  RasterImage image;
  return read_tiff(file.text(), image);
}

template <class T>
std::string row_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

TEST(Tiff, IntegersOfEveryDepth) {
  EXPECT_EQ(tiff({.rows = {"\1\2"}}).bytes, (Bytes8{1, 2}));
  EXPECT_EQ(tiff({.bits = 1, .rows = {"\x40"}}).bytes, (Bytes8{0, 255}));
  EXPECT_EQ(tiff({.bits = 2, .rows = {"\x60"}}).bytes, (Bytes8{85, 170}));
  EXPECT_EQ(tiff({.bits = 4, .rows = {"\x1f"}}).bytes, (Bytes8{17, 255}));
  EXPECT_EQ(tiff({.bits = 12, .rows = {std::string("\x80\x0f\xff", 3)}}).words, (Words16{32776, 65535}));
  for (const char* mode : {"wl", "wb", "w8"}) {
    const RasterImage words = tiff({.bits = 16, .rows = {row_of<std::uint16_t>({0x102, 0xffff})}, .mode = mode});
    EXPECT_EQ(words.words, (Words16{0x102, 0xffff})) << mode;
    EXPECT_FALSE(words.is_linear);
  }
  // 32 bits are counts or identifiers.
  const RasterImage counts = tiff({.bits = 32, .rows = {row_of<std::uint32_t>({7, 4000000000u})}, .mode = "wb"});
  EXPECT_EQ(counts.floats, (Array<float>{7, 4e9f}));
  EXPECT_TRUE(counts.is_linear);
}

TEST(Tiff, FloatsOfEveryDepth) {
  TiffFile file{.bits = 32, .rows = {row_of<float>({-1.5f, 1e30f})}, .numbers = SAMPLEFORMAT_IEEEFP};
  for (const char* mode : {"wl", "wb"}) {
    file.mode = mode;
    EXPECT_EQ(tiff(file).floats, (Array<float>{-1.5f, 1e30f}));
  }
  EXPECT_TRUE(tiff(file).is_linear);
  file.bits = 64;
  file.rows = {row_of<double>({-1.5, 0.1})};
  EXPECT_EQ(tiff(file).floats, (Array<float>{-1.5f, 0.1f}));
  file.bits = 16;
  file.rows = {row_of<Imath::half>({Imath::half(-1.5f), std::numeric_limits<Imath::half>::infinity()})};
  EXPECT_EQ(tiff(file).floats, (Array<float>{-1.5f, std::numeric_limits<float>::infinity()}));
}

TEST(Tiff, WhiteMayBeZero) {
  EXPECT_EQ(tiff({.rows = {"\1\xff"}, .colors = PHOTOMETRIC_MINISWHITE}).bytes, (Bytes8{254, 0}));
  EXPECT_EQ(tiff({.bits = 1, .rows = {"\x40"}, .colors = PHOTOMETRIC_MINISWHITE}).bytes, (Bytes8{255, 0}));
}

TEST(Tiff, PalettesOfSixteenBitsAndOfEight) {
  TiffFile file{.bits = 4, .rows = {std::string("\x10", 1)}, .colors = PHOTOMETRIC_PALETTE};
  file.palette.assign(48, 0);
  const auto set = [&](std::size_t index, int red, int green, int blue) {
    file.palette[index] = static_cast<std::uint16_t>(red);
    file.palette[16 + index] = static_cast<std::uint16_t>(green);
    file.palette[32 + index] = static_cast<std::uint16_t>(blue);
  };
  set(0, 1 * 257, 2 * 256, 3 * 257);
  set(1, 200 * 256, 254 * 257, 255 * 257);
  EXPECT_EQ(tiff(file).channels, 3);
  EXPECT_EQ(tiff(file).bytes, (Bytes8{200, 254, 255, 1, 2, 3}));
  set(0, 1, 2, 3);
  set(1, 200, 254, 255);
  EXPECT_EQ(tiff(file).bytes, (Bytes8{200, 254, 255, 1, 2, 3}));
}

TEST(Tiff, InksAreWhatTheyLeaveOfTheLight) {
  const RasterImage image =
      tiff({.samples = 4, .rows = {std::string("\0\x37\xff\0\x37\x9b\0\x80", 8)}, .colors = PHOTOMETRIC_SEPARATED});
  EXPECT_EQ(image.channels, 3);
  EXPECT_EQ(image.bytes, (Bytes8{255, 200, 0, 100, 50, 127}));
  const RasterImage planar = tiff({.width = 1,
                                   .samples = 4,
                                   .bits = 4,
                                   .rows = {std::string("\0", 1), "\x50", "\xf0", "\x30"},
                                   .colors = PHOTOMETRIC_SEPARATED,
                                   .is_planar = true});
  EXPECT_EQ(planar.bytes, (Bytes8{204, 136, 0})) << "12/15 of 15, 10 and 0 of 15";
}

TEST(Tiff, WhatIsNoColourIsAlphaOrLeftOut) {
  const RasterImage grey = tiff({.samples = 2, .rows = {"\1\2\3\4"}});
  EXPECT_EQ(grey.channels, 2);
  EXPECT_EQ(grey.bytes, (Bytes8{1, 2, 3, 4}));
  const RasterImage color = tiff({.width = 1, .samples = 5, .rows = {"\1\2\3\4\5"}, .colors = PHOTOMETRIC_RGB});
  EXPECT_EQ(color.channels, 4);
  EXPECT_EQ(color.bytes, (Bytes8{1, 2, 3, 4}));
  // Bands, as maps have them.
  const RasterImage bands = tiff({.width = 1, .samples = 3, .rows = {"\1\2\3"}, .extra = EXTRASAMPLE_UNSPECIFIED});
  EXPECT_EQ(bands.bytes, (Bytes8{1, 2, 3}));
  EXPECT_EQ(bands.remark, "has several channels of grey: the first three are taken for red, green, blue");
  EXPECT_EQ(color.remark, "");
}

TEST(Tiff, OrientationIsNotHeededAndTold) {
  const RasterImage image =
      tiff({.rows = {"\1\2"}, .more = [](TIFF* to) { TIFFSetField(to, TIFFTAG_ORIENTATION, ORIENTATION_RIGHTTOP); }});
  EXPECT_EQ(image.bytes, (Bytes8{1, 2}));
  EXPECT_EQ(image.remark, "says that it is to be turned (orientation 6 in place of 1): it is taken as it is stored");
  EXPECT_EQ(tiff({.rows = {"\1\2"}}).remark, "");
}

/// A picture of 37 x 21 whose values differ, in rows of pixels or of channels.
TiffFile made_up(int samples, bool is_planar, int colors) {
  TiffFile file{.width = 37, .height = 21, .samples = samples, .colors = colors, .is_planar = is_planar};
  const auto value = [&](int x, int y, int c) { return static_cast<char>((x * 7 + y * 31 + c * 101) % 251); };
  for (int plane = 0; plane < (is_planar ? samples : 1); ++plane) {
    for (int y = 0; y < file.height; ++y) {
      std::string& row = file.rows.emplace_back();
      for (int x = 0; x < file.width; ++x) {
        for (int c = 0; c < (is_planar ? 1 : samples); ++c) row += value(x, y, plane + c);
      }
    }
  }
  return file;
}

TEST(Tiff, StripsAndTilesSideBySideAndApartCompressedAndNot) {
  const TiffFile plain = made_up(3, false, PHOTOMETRIC_RGB);
  std::string pixels;
  for (const std::string& row : plain.rows) pixels += row;
  for (const bool is_planar : {false, true}) {
    for (const int tile : {0, 16, 32}) {
      for (const int compression :
           {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_DEFLATE, COMPRESSION_PACKBITS}) {
        TiffFile file = made_up(3, is_planar, PHOTOMETRIC_RGB);
        file.tile = tile;
        file.compression = compression;
        const RasterImage image = tiff(file);
        EXPECT_EQ(std::string(image.bytes.begin(), image.bytes.end()), pixels)
            << is_planar << " " << tile << " " << compression;
      }
    }
  }
}

TEST(Tiff, PredictorsOfIntegersAndFloats) {
  TiffFile file = made_up(1, false, PHOTOMETRIC_MINISBLACK);
  file.compression = COMPRESSION_LZW;
  std::string pixels;
  for (const std::string& row : file.rows) pixels += row;
  file.more = [](TIFF* to) { TIFFSetField(to, TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL); };
  const RasterImage image = tiff(file);
  EXPECT_EQ(std::string(image.bytes.begin(), image.bytes.end()), pixels);
  TiffFile floats{.bits = 32,
                  .rows = {row_of<float>({0.25f, -3e5f})},
                  .numbers = SAMPLEFORMAT_IEEEFP,
                  .compression = COMPRESSION_LZW};
  floats.more = [](TIFF* to) { TIFFSetField(to, TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT); };
  EXPECT_EQ(tiff(floats).floats, (Array<float>{0.25f, -3e5f}));
}

TEST(Tiff, FaxesAndJpeg) {
  for (const int compression : {COMPRESSION_CCITTRLE, COMPRESSION_CCITTFAX3, COMPRESSION_CCITTFAX4}) {
    EXPECT_EQ(tiff({.width = 8, .bits = 1, .rows = {"\x35"}, .compression = compression}).bytes,
              (Bytes8{0, 0, 255, 255, 0, 255, 0, 255}))
        << compression;
  }
  TiffFile jpeg{.width = 16, .height = 16, .samples = 3, .colors = PHOTOMETRIC_YCBCR, .compression = COMPRESSION_JPEG};
  for (int y = 0; y < 16; ++y) jpeg.rows.push_back(std::string(48, '\x64'));
  jpeg.more = [](TIFF* to) {
    TIFFSetField(to, TIFFTAG_ROWSPERSTRIP, 16);
    TIFFSetField(to, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
  };
  jpeg.tile = 16;
  const RasterImage image = tiff(jpeg);
  ASSERT_EQ(image.bytes.size(), 768u);
  for (const std::uint8_t byte : image.bytes) ASSERT_NEAR(byte, 100, 1);
}

TEST(Tiff, WhatIsNotReadIsRefused) {
  const std::string numbers = ", accepted are unsigned integers of 1 to 16 and 32 bits and floats of 16, 32 and 64";
  EXPECT_EQ(complaint({.rows = {"\1\2"}, .numbers = SAMPLEFORMAT_INT}),
            "its pixels are signed integers of 8 bits" + numbers);
  EXPECT_EQ(complaint({.bits = 24, .rows = {"123456"}}), "its pixels are integers of 24 bits" + numbers);
  EXPECT_EQ(complaint({.bits = 64, .rows = {std::string(16, 'x')}, .numbers = SAMPLEFORMAT_COMPLEXIEEEFP}),
            "its pixels are complex numbers of 64 bits" + numbers);
  const std::string colors = ", accepted are grey, RGB, palettes, CMYK, and YCbCr in JPEG";
  EXPECT_EQ(complaint({.width = 1, .samples = 3, .rows = {"123"}, .colors = PHOTOMETRIC_CIELAB}),
            "its colours are CIE L*a*b*" + colors);
  EXPECT_EQ(complaint({.samples = 4,
                       .rows = {"12345678"},
                       .colors = PHOTOMETRIC_SEPARATED,
                       .more = [](TIFF* to) { TIFFSetField(to, TIFFTAG_INKSET, INKSET_MULTIINK); }}),
            "it holds inks other than cyan, magenta, yellow and black");
  EXPECT_EQ(complaint({.rows = {"\1\2"}, .more = [](TIFF* to) { TIFFSetField(to, TIFFTAG_IMAGEDEPTH, 2); }}),
            "volume images are not read");
  // The compression's number, 1, is followed by that of Zstandard.
  std::string file = TiffFile{.rows = {"\1\2"}}.text();
  const std::size_t at = file.find(std::string("\3\1\3\0\1\0\0\0\1\0", 10));
  ASSERT_NE(at, std::string::npos);
  file[at + 8] = '\x50', file[at + 9] = '\xc3';
  RasterImage image;
  EXPECT_EQ(read_tiff(file, image),
            "it is compressed with Zstandard, accepted are Deflate, LZW, PackBits, JPEG, CCITT and none");
}

TEST(Tiff, WhatIsCutOffIsRefused) {
  for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_DEFLATE}) {
    TiffFile file = made_up(3, false, PHOTOMETRIC_RGB);
    file.compression = compression;
    std::string whole = file.text();
    // Its directory is behind the pixels: the offset in its head leads there.
    std::uint32_t directory = 0;
    std::memcpy(&directory, &whole[4], 4);
    for (std::size_t size = 4; size < directory + 80; size += 7) {
      RasterImage image;
      EXPECT_NE(read_tiff(whole.substr(0, size), image), "") << size << " of " << whole.size();
    }
    whole.erase(100, 200);
    directory -= 200;
    std::memcpy(&whole[4], &directory, 4);
    RasterImage image;
    EXPECT_NE(read_tiff(whole, image), "") << "pixels that are missing";
  }
}

TEST(Tiff, SizesAreHeldAgainstTheFileAndTheBudget) {
  std::string file = TiffFile{.rows = {"\1\2"}}.text();
  const auto width_of = [&](std::uint32_t width) {
    // Tag 256, a short or long.
    const std::size_t at = file.find(std::string("\0\1", 2), 8);
    file[at + 2] = 4;
    std::memcpy(&file[at + 8], &width, 4);
    RasterImage image;
    return read_tiff(file, image);
  };
  EXPECT_EQ(width_of(100000000), "its header says that it has 100000000x1 pixels, which do not fit a file of " +
                                     std::to_string(file.size()) + " bytes");
  EXPECT_NE(width_of(4000000000u), "");
  // A strip, as it is and unpacked, and the pixels.
  const std::string small = TiffFile{.height = 2, .rows = {"\1\2", "\3\4"}}.text();
  for (const std::uint64_t limit : {12, 11}) {
    const auto budget = std::make_shared<MemoryBudget>(limit);
    const MemoryScope scope(budget);
    RasterImage image;
    if (limit == 12) {
      EXPECT_EQ(read_tiff(small, image), "");
    } else {
      EXPECT_THROW(read_tiff(small, image), MemoryExceeded);
    }
  }
}

}  // namespace
}  // namespace norrsken
