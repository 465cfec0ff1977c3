#include "norrsken/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "color/srgb.h"
#include "tests/temporary_folder.h"
#include "tests/told.h"

namespace norrsken {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Values that differ in every pixel and channel, from 0 up to about 1.3.
Image made_up_image(int width, int height, const std::vector<std::string>& names = {"R", "G", "B"}) {
  Image image;
  image.width = width;
  image.height = height;
  for (std::size_t c = 0; c < names.size(); ++c) {
    auto& values = image.channel(names[c]).values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = 0.3f * static_cast<float>(c) + static_cast<float>(i) / static_cast<float>(values.size());
    }
  }
  return image;
}

class ImageFileTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  std::string bytes_of(const std::string& name) const {
    std::ostringstream bytes;
    bytes << std::ifstream(path(name), std::ios::binary).rdbuf();
    return bytes.str();
  }
  Image read_back(const std::string& name) const { return value_of(read_image(path(name))); }
  int files() const { return static_cast<int>(std::distance(fs::directory_iterator(folder_.path()), {})); }

  const TemporaryFolder folder_;
};

TEST(Image, ChannelAddsZerosOnceAndFindFindsThem) {
  Image image;
  image.width = 3;
  image.height = 2;
  EXPECT_EQ(image.find("depth.Z"), nullptr);
  image.channel("depth.Z").values[4] = 7;
  ASSERT_NE(image.find("depth.Z"), nullptr);
  EXPECT_THAT(image.find("depth.Z")->values, testing::ElementsAre(0, 0, 0, 0, 7, 0));
  EXPECT_EQ(image.channel("depth.Z").values[4], 7);
  EXPECT_EQ(image.channels.size(), 1u);
  EXPECT_EQ(image.find("depth"), nullptr);
}

TEST(Image, OfNoSizeHasNoValues) {
  Image image;
  image.width = -3, image.height = 2;
  EXPECT_TRUE(image.channel("R").values.empty());
}

TEST_F(ImageFileTest, ExrGivesBackEveryBit) {
  Image image = made_up_image(37, 21, {"R", "G", "B", "samples", "variance.R", "depth.Z", "id"});
  auto& red = image.channels[0].values;
  red[0] = kInfinity;
  red[1] = -kInfinity;
  red[2] = std::numeric_limits<float>::quiet_NaN();
  red[3] = std::numeric_limits<float>::denorm_min();
  red[4] = -std::numeric_limits<float>::max();
  red[5] = 16'777'215;
  image.metadata["norrsken:scene"] = "hexagon_room, π";
  ASSERT_TRUE(write_image(path("a.exr"), image));
  EXPECT_EQ(files(), 1);

  Image back = read_back("a.exr");
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 21);
  EXPECT_EQ(back.metadata["norrsken:scene"], "hexagon_room, π");
  ASSERT_EQ(back.channels.size(), 7u);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(back.channels[c].name, image.channels[c].name);
  for (const Channel& channel : image.channels) {
    const Channel* other = back.find(channel.name);
    ASSERT_NE(other, nullptr) << channel.name;
    for (std::size_t i = 0; i < channel.values.size(); ++i) {
      if (std::isnan(channel.values[i])) {
        EXPECT_TRUE(std::isnan(other->values[i]));
      } else {
        ASSERT_EQ(other->values[i], channel.values[i]) << channel.name << " " << i;
      }
    }
  }
}

// An attribute is its name, its type and its size in bytes, then the values (OpenEXR file layout).
TEST_F(ImageFileTest, ExrNamesItsPrimaries) {
  ASSERT_TRUE(write_image(path("a.exr"), made_up_image(4, 4)));
  const std::string bytes = bytes_of("a.exr"), head("chromaticities\0chromaticities\0\x20\0\0\0", 34);
  const std::size_t at = bytes.find(head);
  ASSERT_NE(at, std::string::npos);
  float values[8];
  std::memcpy(values, bytes.data() + at + head.size(), sizeof values);
  EXPECT_THAT(values, testing::ElementsAre(0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f));
}

TEST_F(ImageFileTest, ExrOfSeveralBlocksOfRows) {
  const Image image = made_up_image(5, 201);
  ASSERT_TRUE(write_image(path("a.exr"), image));
  Image back = read_back("a.exr");
  for (int c = 0; c < 3; ++c) EXPECT_EQ(back.channels[c].values, image.channels[c].values);
}

TEST_F(ImageFileTest, PngHoldsTheNearestSrgbByte) {
  Image image = made_up_image(64, 16);
  ASSERT_TRUE(write_image(path("a.PNG"), image));
  Image back = read_back("a.PNG");
  ASSERT_EQ(back.channels.size(), 3u);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(back.channels[c].name, image.channels[c].name);
    for (std::size_t i = 0; i < image.channels[c].values.size(); ++i) {
      const float byte = std::round(255 * srgb_from_linear(std::min(image.channels[c].values[i], 1.0f)));
      ASSERT_NEAR(back.channels[c].values[i], linear_from_srgb(byte / 255), 1e-6f) << c << " " << i;
    }
  }
}

TEST_F(ImageFileTest, PngTakesToneMappingAndWhatIsNotFinite) {
  Image image = made_up_image(4, 1);
  for (Channel& channel : image.channels) {
    channel.values = {0.5f, kInfinity, -1, std::numeric_limits<float>::quiet_NaN()};
  }
  ASSERT_TRUE(write_image(path("a.png"), image, {ToneMapping::Curve::filmic, 1}));
  Image back = read_back("a.png");
  EXPECT_NEAR(back.channels[0].values[0], 2.54f / 3.16f, 0.004f);  // the curve at 1, within half a byte
  EXPECT_EQ(back.channels[1].values[1], 1);
  EXPECT_EQ(back.channels[1].values[2], 0);
  EXPECT_EQ(back.channels[2].values[3], 0);
}

TEST_F(ImageFileTest, PngCarriesMetadataAndIsTaggedSrgb) {
  Image image = made_up_image(4, 4);
  image.metadata["Software"] = "norrsken";
  image.metadata["norrsken:scene"] = "rum, på svenska";
  ASSERT_TRUE(write_image(path("a.png"), image));
  Image back = read_back("a.png");
  EXPECT_EQ(back.metadata["Software"], "norrsken");
  EXPECT_EQ(back.metadata["norrsken:scene"], "rum, på svenska");
  EXPECT_NE(bytes_of("a.png").find("sRGB"), std::string::npos);
}

TEST_F(ImageFileTest, JpegIsNear) {
  const Image image = made_up_image(64, 48);
  for (const char* name : {"a.jpg", "a.jpeg"}) {
    ASSERT_TRUE(write_image(path(name), image));
    Image back = read_back(name);
    for (int c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < image.channels[c].values.size(); ++i) {
        const float expected = srgb_from_linear(std::min(image.channels[c].values[i], 1.0f));
        ASSERT_NEAR(srgb_from_linear(back.channels[c].values[i]), expected, 0.04f) << c << " " << i;
      }
    }
  }
}

TEST_F(ImageFileTest, SaysWhichFormatsThereAre) {
  const Image image = made_up_image(4, 4);
  EXPECT_EQ(write_image("out.tga", image).error,
            "cannot write 'out.tga': unknown file name extension '.tga', accepted: .exr, .png, .jpg, .jpeg");
  EXPECT_EQ(check_writable("out").error,
            "cannot write 'out': no file name extension, accepted: .exr, .png, .jpg, .jpeg");
  EXPECT_THAT(check_writable(path(".png")).error, HasSubstr("no file name extension"));
}

TEST_F(ImageFileTest, RefusesImagesThatAreNone) {
  const auto complaint = [&](const Image& image, const char* name = "a.exr") {
    return write_image(path(name), image).error;
  };
  EXPECT_THAT(complaint(Image{}), HasSubstr("the image has 0x0 pixels"));
  Image image = made_up_image(4, 4, {});
  EXPECT_THAT(complaint(image), HasSubstr("no channels"));
  image = made_up_image(4, 4);
  image.channels[1].values.pop_back();
  EXPECT_THAT(complaint(image), HasSubstr("channel 'G' does not have 4x4 pixels"));
  image = made_up_image(4, 4);
  image.channels[1].name = "R";
  EXPECT_THAT(complaint(image), HasSubstr("two channels 'R'"));
  image.channels[1].name = "";
  EXPECT_THAT(complaint(image), HasSubstr("a channel has no name"));
  image = made_up_image(4, 4, {"R", "G", "depth.Z"});
  EXPECT_EQ(complaint(image), "");
  EXPECT_THAT(complaint(image, "a.png"), HasSubstr("the image has no channel B, the format needs R, G and B"));
  image = made_up_image(4, 4);
  image.metadata["channels"] = "";
  EXPECT_THAT(complaint(image, "b.exr"), HasSubstr("metadata 'channels'"));
  image.metadata = {{std::string(80, 'k'), ""}};
  EXPECT_THAT(complaint(image, "a.png"), HasSubstr("1 to 79 characters"));
  EXPECT_THAT(complaint(made_up_image(70'000, 1), "a.jpg"), HasSubstr("70000x1 pixels, the format takes 65500"));
  EXPECT_THAT(complaint(made_up_image(1, 1'000'001), "a.png"), HasSubstr("the format takes 1000000"));
  EXPECT_EQ(files(), 1);  // the one that was right
}

TEST_F(ImageFileTest, SaysWhichFolderIsMissing) {
  const Image image = made_up_image(4, 4);
  std::ofstream(path("file")) << "x";
  for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
    EXPECT_EQ(write_image(path("file/") + name, image).error,
              "cannot write '" + path("file/") + name + "': '" + path("file") + "' is not a folder");
    EXPECT_THAT(write_image(path("none/") + name, image).error, HasSubstr("there is no folder '" + path("none") + "'"));
    EXPECT_EQ(check_writable(path("none/") + name).error, write_image(path("none/") + name, image).error);
  }
}

TEST_F(ImageFileTest, AFullDiskKeepsTheOldFile) {
  const std::vector<std::string> names = {"a.exr", "a.png", "a.jpg"};
  const Image old_image = made_up_image(2, 2);
  Image image = made_up_image(200, 200);
  for (std::size_t i = 0; i < image.channels[0].values.size(); ++i) {
    image.channels[0].values[i] = static_cast<float>((i * 7919) % 1009) / 1009;  // hard to compress
  }
  for (const std::string& name : names) ASSERT_TRUE(write_image(path(name), old_image));

  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const rlimit limit{5000, old_limit.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  std::vector<IoStatus> statuses;
  statuses.reserve(names.size());
  for (const std::string& name : names) statuses.push_back(write_image(path(name), image));
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);

  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(statuses[i].error, "cannot write '" + path(names[i]) + "': File too large");
    EXPECT_EQ(read_back(names[i]).width, 2);
  }
  EXPECT_EQ(files(), 3);
}

TEST_F(ImageFileTest, CheckWritableLeavesNoTrace) {
  EXPECT_TRUE(check_writable(path("a.exr")));
  EXPECT_EQ(files(), 0);
  std::ofstream(path("a.exr")) << "old";
  EXPECT_TRUE(check_writable(path("a.exr")));
  EXPECT_EQ(fs::file_size(path("a.exr")), 3u);
  EXPECT_EQ(files(), 1);
}

TEST_F(ImageFileTest, ReadRefusesWhatIsNoFile) {
  const auto complaint = [](const std::string& name) { return read_image(name).error(); };
  EXPECT_THAT(complaint(path("none.png")), HasSubstr("cannot read '" + path("none.png") + "': "));
  EXPECT_THAT(complaint(folder_.string()), HasSubstr("it is a folder"));
  EXPECT_THAT(complaint("/dev/zero"), HasSubstr("it is not a regular file"));
  ASSERT_EQ(mkfifo(path("fifo.png").c_str(), 0600), 0);
  EXPECT_THAT(complaint(path("fifo.png")), HasSubstr("it is not a regular file"));  // and does not wait for a writer
  EXPECT_THAT(complaint(std::string("a\0.png", 6)), HasSubstr("not a file name"));
}

TEST_F(ImageFileTest, ReadRefusesDamagedFiles) {
  ASSERT_TRUE(write_image(path("whole.exr"), made_up_image(64, 64)));
  fs::copy_file(path("whole.exr"), path("half.exr"));
  fs::resize_file(path("half.exr"), fs::file_size(path("whole.exr")) / 2);
  std::ofstream(path("text.png")) << "this is not a picture";
  std::ofstream(path("empty.png")) << "";
  std::ofstream(path("noextension")) << "neither";
  for (const char* name : {"half.exr", "text.png", "empty.png", "noextension"}) {
    const std::string error = read_image(path(name)).error();
    EXPECT_THAT(error, HasSubstr("cannot read '" + path(name) + "': "));
    EXPECT_GT(error.size(), ("cannot read '" + path(name) + "': ").size());
  }
}

// A portable pixmap's header may claim any size at no cost.
TEST_F(ImageFileTest, ReadRefusesForgedSizesBeforeAllocating) {
  std::ofstream(path("huge.ppm")) << "P6\n100000 100000\n255\nabc";
  EXPECT_THAT(read_image(path("huge.ppm")).error(), HasSubstr("100000x100000 pixels"));
}

TEST_F(ImageFileTest, ReadLooksAtTheSizeOfTheFileFirst) {
  std::ofstream(path("large.png")) << std::string(3 << 20, 'x');
  EXPECT_EQ(read_image(path("large.png"), std::make_shared<MemoryBudget>(2 << 20)).error(),
            "cannot read '" + path("large.png") +
                "': it does not fit into memory: it needs 3.00 MiB, and 2.00 MiB of 2.00 MiB are left");
}

TEST_F(ImageFileTest, ReadDecodesGreyFromSrgb) {
  std::ofstream(path("grey.pgm"), std::ios::binary) << "P5\n2 1\n255\n" << char(128) << char(255);
  const Image image = read_back("grey.pgm");
  ASSERT_EQ(image.channels.size(), 1u);
  EXPECT_NEAR(image.channels[0].values[0], linear_from_srgb(128 / 255.0f), 1e-6f);
  EXPECT_EQ(image.channels[0].values[1], 1);
}

}  // namespace
}  // namespace norrsken
