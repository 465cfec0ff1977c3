#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>
// jpeglib.h wants <cstdio> before it.
#include <jpeglib.h>

#include "image/raster_image.h"

namespace norrsken {
namespace {

struct JpegFile {
  int width = 16, height = 8;
  J_COLOR_SPACE color = JCS_RGB;
  std::vector<std::uint8_t> pixel = {200, 100, 50};  ///< the same everywhere, but for noise
  bool progressive = false, noisy = false;

  std::string text() const {
    jpeg_error_mgr errors;
    jpeg_compress_struct jpeg{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = static_cast<JDIMENSION>(width);
    jpeg.image_height = static_cast<JDIMENSION>(height);
    jpeg.input_components = static_cast<int>(pixel.size());
    jpeg.in_color_space = color;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    if (progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < height; ++y) {
      std::vector<std::uint8_t> row;
      for (int x = 0; x < width; ++x) {
        for (const std::uint8_t value : pixel) {
          row.push_back(static_cast<std::uint8_t>(noisy ? (value + x * 37 + y * 91) % 256 : value));
        }
      }
      JSAMPROW start = row.data();
      jpeg_write_scanlines(&jpeg, &start, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::string file(reinterpret_cast<const char*>(bytes), size);
    std::free(bytes);
    return file;
  }
};

RasterImage jpeg(const JpegFile& file) {
  RasterImage image;
  EXPECT_TRUE(is_jpeg(file.text()));
  EXPECT_EQ(read_jpeg(file.text(), image), "");
  return image;
}

void expect_pixels(const RasterImage& image, const std::vector<int>& expected) {
  ASSERT_EQ(image.channels, static_cast<int>(expected.size()));
  ASSERT_EQ(image.bytes.size(), image.width * image.height * expected.size());
  for (std::size_t i = 0; i < image.bytes.size(); ++i) {
    ASSERT_NEAR(image.bytes[i], expected[i % expected.size()], 2) << i;
  }
}

TEST(Jpeg, ColoursGreysAndInks) {
  for (const bool progressive : {false, true}) {
    expect_pixels(jpeg({.progressive = progressive}), {200, 100, 50});
    expect_pixels(jpeg({.color = JCS_GRAYSCALE, .pixel = {77}, .progressive = progressive}), {77});
    // Adobe stores what an ink leaves: of 200, 100, 50 black takes a half.
    expect_pixels(jpeg({.color = JCS_CMYK, .pixel = {200, 100, 50, 128}, .progressive = progressive}), {100, 50, 25});
  }
  const RasterImage image = jpeg({.width = 5, .height = 3});
  EXPECT_EQ(image.width, 5);
  EXPECT_EQ(image.height, 3);
  EXPECT_FALSE(image.is_linear);
}

TEST(Jpeg, WhatIsCutOffOrDamagedIsAnErrorAndNotGrey) {
  for (const bool progressive : {false, true}) {
    const std::string whole = JpegFile{.width = 64, .height = 64, .progressive = progressive, .noisy = true}.text();
    RasterImage image;
    constexpr std::size_t kEndMark = 2;
    EXPECT_EQ(read_jpeg(whole.substr(0, whole.size() - kEndMark), image),
              progressive ? "Premature end of JPEG file" : "");
    for (std::size_t size = 3; size < whole.size() - 8; size += 5) {
      RasterImage cut;
      EXPECT_NE(read_jpeg(whole.substr(0, size), cut), "") << size << " of " << whole.size();
    }
  }
  const std::string whole = JpegFile{.width = 64, .height = 64, .noisy = true}.text();
  RasterImage image;
  EXPECT_EQ(read_jpeg(whole.substr(0, whole.size() / 2), image), "Corrupt JPEG data: premature end of data segment");
}

TEST(Jpeg, OrientationIsNotHeededAndTold) {
  using namespace std::string_literals;
  const std::string whole = JpegFile{}.text();
  // Exif with one entry, a short: little-endian and big-endian.
  const std::string little = "II*\0\x08\0\0\0\1\0\x12\1\3\0\1\0\0\0\6\0\0\0\0\0\0\0"s;
  const std::string big = "MM\0*\0\0\0\x08\0\1\1\x12\0\3\0\0\0\1\0\6\0\0\0\0\0\0"s;
  const auto remark = [&](const std::string& exif) {
    const std::string marker = "\xff\xe1\0"s + static_cast<char>(exif.size() + 8) + "Exif\0\0"s + exif;
    RasterImage image;
    EXPECT_EQ(read_jpeg(whole.substr(0, 2) + marker + whole.substr(2), image), "");
    return image.remark;
  };
  for (const std::string& exif : {little, big}) {
    EXPECT_EQ(remark(exif), "says that it is to be turned (orientation 6 in place of 1): it is taken as it is stored");
    for (std::size_t size = 0; size < 19; ++size) EXPECT_EQ(remark(exif.substr(0, size)), "") << size;
  }
  std::string upright = little;
  upright[18] = 1;
  EXPECT_EQ(remark(upright), "");
  EXPECT_EQ(jpeg({}).remark, "");
}

/// The file with another height and width in its frame header (SOF0 or SOF2).
std::string with_size(std::string file, int width, int height) {
  std::size_t at = file.find("\xff\xc0");
  if (at == std::string::npos) at = file.find("\xff\xc2");
  for (int i = 0; i < 2; ++i) {
    file[at + 5 + i] = static_cast<char>(height >> (8 - 8 * i));
    file[at + 7 + i] = static_cast<char>(width >> (8 - 8 * i));
  }
  return file;
}

TEST(Jpeg, SizesAreHeldAgainstTheFileAndTheBudget) {
  RasterImage image;
  const std::string small = JpegFile{}.text();
  EXPECT_EQ(read_jpeg(with_size(small, 16000, 16000), image),
            "its header says that it has 16000x16000 pixels, which do not fit a file of " +
                std::to_string(small.size()) + " bytes");
  EXPECT_EQ(read_jpeg(with_size(small, 65000, 65000), image),
            "it has 65000x65000 pixels of 3 channels, accepted are 1073741824 values in all");
  // The coefficients of several scans are all held at once: two bytes for each value.
  const auto budget = std::make_shared<MemoryBudget>(1 << 20);
  const MemoryScope scope(budget);
  EXPECT_THROW(read_jpeg(with_size(JpegFile{.progressive = true}.text(), 1000, 1000), image), MemoryExceeded);
  EXPECT_EQ(budget->used(), 0u);
}

}  // namespace
}  // namespace norrsken
