#include "formats/texel_image.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "norrsken/image.h"
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

std::string little_endian(std::initializer_list<std::pair<std::uint32_t, int>> numbers) {
  std::string bytes;
  for (auto [value, size] : numbers) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(std::uint64_t{value} >> (8 * i) & 0xff);
  }
  return bytes;
}

/// 2 x 2, bottom row first: blue, green, red; rows are padded to four bytes.
std::string bmp_header(std::uint32_t width, std::uint32_t height) {
  const std::uint32_t row_bytes = (width * 3 + 3) / 4 * 4, bytes = row_bytes * height;
  return "BM" + little_endian({{54 + bytes, 4}, {0, 4}, {54, 4}, {40, 4}, {width, 4}, {height, 4}, {1, 2}, {24, 2}}) +
         little_endian({{0, 4}, {bytes, 4}, {2835, 4}, {2835, 4}, {0, 4}, {0, 4}});
}
std::string bmp() {
  return bmp_header(2, 2) + std::string("\x07\x08\x09\x0a\x0b\x0c\0\0\x01\x02\x03\x04\x05\x06\0\0", 16);
}

/// 2 x 1, top row first, uncompressed, of 24 bits.
std::string tga(std::uint32_t width = 2, std::uint32_t height = 1) {
  return little_endian({{0, 1}, {0, 1}, {2, 1}, {0, 5}, {0, 4}, {width, 2}, {height, 2}, {24, 1}, {0x20, 1}}) +
         std::string("\x03\x02\x01\x06\x05\x04", 6);
}

TEST(TexelImage, BitmapFilesKeepTheirBytes) {
  TexelImage image;
  ASSERT_EQ(read_texels("a.bmp", bmp(), image), "");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.channels, 3);
  EXPECT_TRUE(image.is_encoded);
  EXPECT_EQ(image.bytes, (Array<std::uint8_t>{3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}));
  EXPECT_TRUE(image.values.empty());
}

TEST(TexelImage, TargaFilesKeepTheirBytes) {
  TexelImage image;
  ASSERT_EQ(read_texels("a.tga", tga(), image), "");
  EXPECT_EQ(image.bytes, (Array<std::uint8_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(image.is_encoded);
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

TEST(TexelImage, BadFilesAreRefused) {
  TexelImage image;
  EXPECT_NE(read_texels("a.png", "no image", image), "");
  EXPECT_NE(read_texels("a.exr", "", image), "");
  EXPECT_NE(read_texels("a", "x", image), "");
  EXPECT_EQ(image.width, 0) << "changed on success only";
}

TEST(TexelImage, HeadersThatPromiseMoreThanTheFileHoldsAreNotBelieved) {
  TexelImage image;
  EXPECT_EQ(read_texels("a.tga", tga(60000, 60000), image),
            "its header says that it has 60000x60000 pixels, which do not fit a file of 24 bytes");
  EXPECT_EQ(read_texels("a.bmp", bmp_header(20000000, 5), image),
            "its header says that it has 20000000x5 pixels, which do not fit a file of 54 bytes");
  // What deflate might still make of so few bytes is given up when the file ends.
  const MemoryScope scope(std::make_shared<MemoryBudget>(std::uint64_t{1} << 30));
  EXPECT_NE(read_texels("a.tga", tga(400, 400), image), "");
}

/// Lets the process set aside so many bytes more than now, touched or not.
class AddressSpaceLimit {
 public:
  explicit AddressSpaceLimit(std::uint64_t bytes_more) {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before_);
    const rlimit limit{pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes_more, before_.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
  }
  ~AddressSpaceLimit() { setrlimit(RLIMIT_AS, &before_); }
  AddressSpaceLimit(const AddressSpaceLimit&) = delete;
  AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

 private:
  rlimit before_{};
};

TEST(TexelImage, RowsOfMillionsOfPixelsAreReadWithoutGigabytes) {
  TexelImage image;
  ASSERT_EQ(read_texels("a.bmp", bmp(), image), "") << "the module and its libraries come with the first image";
  constexpr std::uint32_t kWidth = 2000000;
  std::string file = bmp_header(kWidth, 5);
  for (std::uint32_t i = 0; i < kWidth * 3 * 5; ++i) file += static_cast<char>(i % 251);
  {
    const AddressSpaceLimit limit(std::uint64_t{300} << 20);
    ASSERT_EQ(read_texels("a.bmp", file, image), "");
  }
  ASSERT_EQ(image.bytes.size(), std::size_t{kWidth} * 3 * 5);
  // Bottom row first, blue first.
  for (const std::uint32_t x : {0u, 1u, kWidth / 2, kWidth - 1}) {
    for (std::uint32_t y = 0; y < 5; ++y) {
      const std::uint32_t stored = (4 - y) * kWidth * 3 + x * 3;
      for (std::uint32_t c = 0; c < 3; ++c) {
        ASSERT_EQ(image.bytes[(std::size_t{y} * kWidth + x) * 3 + c], (stored + 2 - c) % 251) << x << " " << y;
      }
    }
  }
}

TEST(TexelImage, WhatItsImageAndItsDecoderTakeIsCounted) {
  // 2 x 2 pixels of 3 bytes, twice.
  for (const std::uint64_t limit : {24, 23}) {
    const auto budget = std::make_shared<MemoryBudget>(limit);
    const MemoryScope scope(budget);
    TexelImage image;
    if (limit == 24) {
      EXPECT_EQ(read_texels("a.bmp", bmp(), image), "");
      EXPECT_EQ(budget->used(), 12u);
    } else {
      EXPECT_THROW(read_texels("a.bmp", bmp(), image), MemoryExceeded);
      EXPECT_EQ(budget->used(), 0u);
    }
    EXPECT_EQ(image.width, limit == 24 ? 2 : 0) << "changed on success only";
  }
}

}  // namespace
}  // namespace norrsken
