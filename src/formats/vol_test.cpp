#include "formats/vol.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "formats/reader_testing.h"

namespace norrsken {
namespace {

using ::testing::ElementsAre;

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

struct Header {
  std::string magic = "VOL";
  char version = 3;
  std::vector<std::int32_t> integers = {1, 3, 2, 1, 1};  ///< encoding, x, y, z, channels
};

std::string file(const Header& header, const std::vector<float>& values) {
  return header.magic + header.version + bytes_of(header.integers) + bytes_of(std::vector<float>(6, NAN)) +
         bytes_of(values);
}
const std::vector<float> kSix = {0, 1, 2, 3, 4, -5};

std::string complaints(const std::string& bytes) {
  Diagnostics diagnostics;
  const bool read = read_vol(bytes, "a.vol", diagnostics).has_value();
  EXPECT_EQ(read, diagnostics.all().empty());
  return to_text(diagnostics);
}
std::string complaints(std::size_t integer, std::int32_t value) {
  Header header;
  header.integers[integer] = value;
  return complaints(file(header, kSix));
}

TEST(Vol, ReadsSizesAndValues) {
  Diagnostics diagnostics;
  const auto volume = read_vol(file({}, kSix), "a.vol", diagnostics);
  ASSERT_TRUE(volume.has_value()) << to_text(diagnostics);
  EXPECT_THAT(volume->size, ElementsAre(3, 2, 1));
  EXPECT_EQ(volume->channels, 1u);
  EXPECT_EQ(volume->values, Array<float>(kSix.begin(), kSix.end()));
}

TEST(Vol, ReadsSeveralChannelsAndSkipsWhatIsBehind) {
  Diagnostics diagnostics;
  const auto volume = read_vol(file({.integers = {1, 1, 1, 2, 3}}, kSix) + "more", "a.vol", diagnostics);
  ASSERT_TRUE(volume.has_value()) << to_text(diagnostics);
  EXPECT_THAT(volume->size, ElementsAre(1, 1, 2));
  EXPECT_EQ(volume->channels, 3u);
  EXPECT_EQ(volume->values, Array<float>(kSix.begin(), kSix.end()));
}

TEST(Vol, RefusesOtherFiles) {
  const std::string none = "a.vol: error: this is no volume file\naccepted: a file that begins with VOL";
  EXPECT_EQ(complaints(""), none);
  EXPECT_EQ(complaints("VO"), none);
  EXPECT_EQ(complaints(file({.magic = "VDB"}, kSix)), none);
  EXPECT_EQ(complaints(file({.version = 2}, kSix)), "a.vol: error: version 2\naccepted: 3");
  EXPECT_EQ(complaints(file({.version = '\xff'}, kSix)), "a.vol: error: version 255\naccepted: 3");
  EXPECT_EQ(complaints(0, 2), "a.vol: error: encoding 2\naccepted: 1, for 32-bit floats");
}

TEST(Vol, RefusesFilesThatEndEarly) {
  const std::string whole = file({}, kSix);
  for (std::size_t size = 3; size < 48; ++size) {
    EXPECT_EQ(complaints(whole.substr(0, size)),
              "a.vol: error: the file ends after " + std::to_string(size) + " bytes\naccepted: 48 or more");
  }
  for (std::size_t size = 48; size < whole.size(); ++size) {
    EXPECT_EQ(complaints(whole.substr(0, size)), "a.vol: error: 3 x 2 x 1 values of 1 channel do not fit the " +
                                                     std::to_string(size - 48) +
                                                     " bytes behind the header\naccepted: 4 bytes for each");
  }
  EXPECT_EQ(complaints(whole), "");
}

TEST(Vol, RefusesSizesThatCannotBe) {
  EXPECT_EQ(complaints(1, 0), "a.vol: error: 0 x 2 x 1 values\naccepted: 1 or more along x, y and z");
  EXPECT_EQ(complaints(2, -2), "a.vol: error: 3 x -2 x 1 values\naccepted: 1 or more along x, y and z");
  EXPECT_EQ(complaints(3, -1), "a.vol: error: 3 x 2 x -1 values\naccepted: 1 or more along x, y and z");
  EXPECT_EQ(complaints(4, 0), "a.vol: error: 0 channels\naccepted: 1 or more");
  EXPECT_EQ(complaints(4, -1), "a.vol: error: -1 channels\naccepted: 1 or more");
  // The product of these is 0 in 64 bits.
  EXPECT_EQ(complaints(file({.integers = {1, 1 << 30, 1 << 30, 1 << 30, 1 << 30}}, kSix)),
            "a.vol: error: 1073741824 x 1073741824 x 1073741824 values of 1073741824 channels do not fit the 24 bytes "
            "behind the header\naccepted: 4 bytes for each");
}

TEST(Vol, RefusesValuesThatAreNotFinite) {
  EXPECT_EQ(complaints(file({}, {0, 1, 2, 3, NAN, -INFINITY})),
            "a.vol: error: the value at (1, 1, 0) is nan\naccepted: finite numbers\n"
            "a.vol: error: the value at (2, 1, 0) is -inf\naccepted: finite numbers");
  const std::string many = complaints(file({.integers = {1, 1, 10, 10, 1}}, std::vector<float>(100, NAN)));
  EXPECT_NE(many.find("the value at (0, 9, 1) is nan"), std::string::npos) << many;
  EXPECT_EQ(many.find("the value at (0, 1, 2) is nan"), std::string::npos) << many;
  EXPECT_TRUE(many.ends_with("a.vol: error: and more errors in this file")) << many;
}

}  // namespace
}  // namespace norrsken
