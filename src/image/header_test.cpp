// What image files say about themselves, and what is made of files that lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "norrsken/image.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ImageHeaders : public testing::Test {
 protected:
  std::string write_file(const std::string& name) const {
    Image image;
    image.width = 3, image.height = 2;
    for (const char* channel : {"R", "G", "B"}) image.channel(channel);
    image.metadata = {{"Software", "norrsken"}, {"norrsken.scene", "rum, på svenska"}, {"norrsken.seed", ""}};
    EXPECT_TRUE(write_image(folder_.file(name), image));
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// The complaint about a file of these bytes, without its name.
  std::string complaint(const std::string& bytes, ImageHeader* header = nullptr) const {
    ImageHeader read;
    const std::string path = folder_.write("input", bytes);
    std::string error = read_image_header(path, header ? *header : read).error;
    const std::string begin = "cannot read '" + path + "': ";
    return error.starts_with(begin) ? error.substr(begin.size()) : error;
  }

  const TemporaryFolder folder_;
};

TEST_F(ImageHeaders, AreReadFromExrAndPng) {
  for (const char* name : {"a.exr", "a.png"}) {
    write_file(name);
    EXPECT_TRUE(has_image_header(folder_.file(name)));
    ImageHeader header;
    ASSERT_EQ(read_image_header(folder_.file(name), header).error, "");
    EXPECT_EQ(header.width, 3);
    EXPECT_EQ(header.height, 2);
    EXPECT_THAT(header.channels, testing::UnorderedElementsAre("R", "G", "B"));
    EXPECT_THAT(header.metadata,
                testing::ElementsAre(std::pair("Software", "norrsken"), std::pair("norrsken.scene", "rum, på svenska"),
                                     std::pair("norrsken.seed", "")));
  }
  write_file("a.jpg");
  EXPECT_FALSE(has_image_header(folder_.file("a.jpg")));
  EXPECT_FALSE(has_image_header(folder_.file("none")));
  EXPECT_FALSE(has_image_header(folder_.string()));
  EXPECT_EQ(complaint("<scene/>"), "it is neither EXR nor PNG");
}

TEST_F(ImageHeaders, NeedNoPixels) {
  std::string exr = write_file("a.exr"), png = write_file("a.png");
  EXPECT_EQ(complaint(exr.substr(0, exr.find("chromaticities"))), "its header is damaged, or longer than 4 MiB");
  EXPECT_EQ(complaint(png.substr(0, png.find("IDAT") + 4)), "");
}

TEST_F(ImageHeaders, OfPngAreTheTextsBehindThePixelsToo) {
  const std::string png = write_file("a.png");
  const auto chunk = [](const std::string& type, const std::string& data) {
    const std::string body = type + data;
    std::uint32_t crc = ~0u;
    for (const char c : body) {
      crc ^= static_cast<unsigned char>(c);
      for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
    }
    const auto word = [](std::uint32_t v) {
      return std::string{static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8),
                         static_cast<char>(v)};
    };
    return word(static_cast<std::uint32_t>(data.size())) + body + word(~crc);
  };
  const std::string text = chunk("tEXt", std::string("Comment\0behind", 14));
  std::string changed = png;
  changed.insert(png.rfind("IEND") - 4, text);
  ImageHeader header;
  EXPECT_EQ(complaint(changed, &header), "");
  EXPECT_EQ(header.metadata["Comment"], "behind");
  EXPECT_EQ(header.metadata["Software"], "norrsken");
  // 6 MiB of what nobody reads, in front of the pixels.
  std::string noisy = changed;
  noisy.insert(png.find("IDAT") - 4, chunk("noIz", std::string(std::size_t{6} << 20, 'x')));
  ImageHeader noisy_header;
  EXPECT_EQ(complaint(noisy, &noisy_header), "");
  EXPECT_EQ(noisy_header.metadata, header.metadata);
  EXPECT_EQ(complaint(changed.substr(0, changed.size() - 20), &header), "") << "half a text, behind whole pixels";
}

/// Every length that could be too large is made so, and every file cut off anywhere.
TEST_F(ImageHeaders, AreNotBelievedBeforeTheBytesAreThere) {
  const std::string exr = write_file("a.exr");
  for (const char* type : {"string", "chlist", "box2i", "chromaticities", "float"}) {
    const std::size_t at = exr.rfind(std::string(type) + '\0') + std::strlen(type) + 1;
    for (const std::int32_t size : {-1, 0x7fffffff, 1 << 24}) {
      std::string changed = exr;
      std::memcpy(changed.data() + at, &size, sizeof size);
      EXPECT_EQ(complaint(changed), "its header is damaged, or longer than 4 MiB") << type << " " << size;
    }
  }
  std::string huge = exr;
  const std::int32_t window[] = {-2147483647 - 1, 0, 2147483647, 0};
  std::memcpy(huge.data() + huge.find("dataWindow") + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4,
              window, sizeof window);
  EXPECT_EQ(complaint(huge), "its header is damaged, or longer than 4 MiB");
  for (const std::string& whole : {exr, write_file("a.png")}) {
    for (std::size_t size = 0; size < 500; size += 3) {
      ImageHeader header;
      const std::string error = complaint(whole.substr(0, size), &header);
      EXPECT_EQ(error.empty(), header.width > 0) << size;
    }
  }
}

TEST_F(ImageHeaders, CannotCommandTheTerminal) {
  std::string exr = write_file("a.exr");
  exr[exr.find("rum, p")] = '\x1b';
  ImageHeader header;
  ASSERT_EQ(complaint(exr, &header), "");
  EXPECT_EQ(header.metadata["norrsken.scene"], "\uFFFDum, på svenska");
}

}  // namespace
}  // namespace norrsken
