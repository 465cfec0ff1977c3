// What EXR files hold for each pixel_format and component_format: which channels of which type, and what is in them.
#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>

#include "norrsken/image.h"
#include "tests/end_to_end/param_name.h"
#include "tests/end_to_end/scene_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

using Types = std::map<std::string, std::string>;

Types types_in(const std::string& file) {
  const Imf::InputFile exr(file.c_str());
  Types types;
  const Imf::ChannelList& channels = exr.header().channels();
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    types[c.name()] = c.channel().type == Imf::HALF ? "half" : c.channel().type == Imf::FLOAT ? "float" : "uint";
  }
  return types;
}

struct FormatCase {
  std::string name;  ///< of the pixel format
  std::string colors;
  bool alpha;
};
std::ostream& operator<<(std::ostream& out, const FormatCase& c) { return out << c.name; }

/// A coloured lamp that covers the left half of the picture.
const std::string kHalf =
    R"(<shape type="rectangle"><transform name="to_world"><translate x="-1"/><scale x="10" y="10"/>
  </transform><bsdf type="diffuse"><float name="reflectance" value="0"/></bsdf>
  <emitter type="area"><rgb name="radiance" value="0.7, 0.3, 0.11"/></emitter></shape>)";

class PixelFormat : public SceneFolder, public ::testing::WithParamInterface<FormatCase> {
 protected:
  static constexpr int kSize = 8;

  /// What is in the file that a rendering leaves.
  Image written(const std::string& pixel_format, const std::string& component_format, bool layers = false) const {
    const Scene scene = load_elements("<integrator type=\"path\"/>" +
                                      camera(kSize, {},
                                             "<rfilter type=\"box\"/>" + text("pixel_format", pixel_format) +
                                                 text("component_format", component_format)) +
                                      kHalf);
    const Image image = render_image(scene, {.samples_per_pixel = 4, .threads = kThreads}, layers);
    EXPECT_EQ(write_image(path("a.exr"), image).error, "");
    return value_of(read_image(path("a.exr")));
  }
};

TEST_P(PixelFormat, HasItsChannelsOfTheirType) {
  for (const auto& [component_format, type] : {std::pair("float32", "float"), {"float16", "half"}}) {
    Types wanted;
    for (const char color : GetParam().colors) wanted[std::string(1, color)] = type;
    if (GetParam().alpha) wanted["A"] = type;
    written(GetParam().name, component_format);
    EXPECT_EQ(types_in(path("a.exr")), wanted) << component_format;
    // Other layers would not bear it.
    written(GetParam().name, component_format, true);
    const Types with_layers = types_in(path("a.exr"));
    EXPECT_EQ(with_layers.at(std::string(1, GetParam().colors[0])), type);
    EXPECT_EQ(with_layers.at("variance.G"), "float");
    EXPECT_EQ(with_layers.at("samples"), "float");
  }
}

/// IEC 61966-2-1: the matrix of sRGB's primaries and white.
TEST_P(PixelFormat, HoldsItsWeightsOfRedGreenAndBlue) {
  const std::map<char, std::array<double, 3>> weights{{'R', {1, 0, 0}},
                                                      {'G', {0, 1, 0}},
                                                      {'B', {0, 0, 1}},
                                                      {'X', {0.412453, 0.357580, 0.180423}},
                                                      {'Y', {0.212671, 0.715160, 0.072169}},
                                                      {'Z', {0.019334, 0.119193, 0.950227}}};
  for (const auto& [component_format, precision] : {std::pair("float32", 3e-4), {"float16", 8e-4}}) {
    const Image image = written(GetParam().name, component_format);
    for (const char color : GetParam().colors) {
      const auto& w = weights.at(color);
      const double left = w[0] * 0.7 + w[1] * 0.3 + w[2] * 0.11;
      const Channel* channel = image.find(std::string(1, color));
      ASSERT_NE(channel, nullptr) << color;
      for (std::size_t i = 0; i < channel->values.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(channel->values[i]), i % kSize < kSize / 2 ? left : 0, precision * left)
            << color << ", pixel " << i;
      }
    }
    if (!GetParam().alpha) continue;
    const auto& alpha = image.find("A")->values;
    for (std::size_t i = 0; i < alpha.size(); ++i) EXPECT_EQ(alpha[i], i % kSize < kSize / 2 ? 1.0f : 0.0f) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(, PixelFormat,
                         ::testing::Values(FormatCase{"rgb", "RGB", false}, FormatCase{"rgba", "RGB", true},
                                           FormatCase{"xyz", "XYZ", false}, FormatCase{"xyza", "XYZ", true},
                                           FormatCase{"luminance", "Y", false},
                                           FormatCase{"luminance_alpha", "Y", true}),
                         kParamName);

}  // namespace
}  // namespace norrsken::end_to_end
