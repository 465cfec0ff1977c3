// glTF by what its specification defines: where normal maps lean, how bright photometric lights are, what is transparent.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "norrsken/image.h"
#include "tests/end_to_end/rendering.h"

namespace norrsken::end_to_end {
namespace {

constexpr double kPi = std::numbers::pi;

std::string bytes_of(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) {
    const auto raw = std::bit_cast<std::array<char, sizeof(float)>>(value);
    bytes.append(raw.data(), raw.size());
  }
  return bytes;
}

/// The mean of red of a square from -1 to 1 that fills the view of an orthographic camera before it. `material` is its
/// material, in single quotes as everything; `nodes` stand beside it. Textures are of the image "i.ppm".
double brightness(const std::string& material, const std::string& nodes, const std::string& extensions,
                  bool mirrored_uv = false, const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
  const float u0 = mirrored_uv ? 1.0f : 0.0f;
  const std::string buffer = bytes_of(
      {-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0, u0, 1, 1 - u0, 1, u0, 0, 1 - u0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  std::string text =
      "{'asset':{'version':'2.0'},'nodes':[{'mesh':0},{'camera':0,'translation':[0,0,2]}" + nodes +
      "],'cameras':[{'type':'orthographic','orthographic':{'xmag':0.9,'ymag':0.9,'znear':0.1,'zfar':10}}],"
      "'meshes':[{'primitives':[{'mode':5,'material':0,'attributes':{'POSITION':0,'TEXCOORD_0':1,'NORMAL':2}}]}],"
      "'materials':[" +
      material +
      "],'textures':[{'source':0}],'images':[{'uri':'i.ppm'}],"
      "'accessors':[{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3'},"
      "{'bufferView':0,'byteOffset':48,'componentType':5126,'count':4,'type':'VEC2'},"
      "{'bufferView':0,'byteOffset':80,'componentType':5126,'count':4,'type':'VEC3'}],"
      "'bufferViews':[{'buffer':0,'byteLength':128}],'buffers':[{'uri':'b.bin','byteLength':128}]" +
      extensions + "}";
  for (char& c : text) c = c == '\'' ? '"' : c;
  LoadOptions load;
  load.parameters = parameters;
  load.width = load.height = 8;
  // Its normal leans upwards: (0, 0.6, 0.8).
  auto scene = Scene::load(
      SceneSource::memory("a.gltf", text, {{"b.bin", buffer}, {"i.ppm", "P3 1 1 255 128 204 230\n"}}), load);
  EXPECT_TRUE(scene) << scene.error();
  if (!scene) return 0;
  RenderOptions options;
  options.samples_per_pixel = 64;
  const Image image = render_image(*scene, options);
  double sum = 0;
  for (const float value : image.find("R")->values) sum += value;
  return sum / static_cast<double>(image.find("R")->values.size());
}

/// Light of pi W/m^2 at right angles, from 45 degrees above.
const std::string kFromAbove =
    ",{'rotation':[-0.3826834323650898,0,0,0.9238795325112867],'extensions':{'KHR_lights_punctual':{'light':0}}}";
const std::string kLight =
    ",'extensions':{'KHR_lights_punctual':{'lights':[{'type':'directional','intensity':" + std::to_string(683 * kPi) +
    "}]}}";
const std::string kDiffuse =
    "'pbrMetallicRoughness':{'metallicFactor':0},'extensions':{'KHR_materials_specular':{'specularFactor':0}}";

TEST(Gltf, LuxAreWattsByTheirLumens) {
  EXPECT_NEAR(brightness("{" + kDiffuse + "}", kFromAbove, kLight), std::sqrt(0.5), 1e-4);
  EXPECT_NEAR(brightness("{" + kDiffuse + "}", kFromAbove, kLight, false, {{"lumens_per_watt", "1366"}}),
              std::sqrt(0.125), 1e-4);
}

TEST(Gltf, NormalMapsLeanUpwardsWhicheverWayTheyAreMirrored) {
  const std::string material = "{'normalTexture':{'index':0}," + kDiffuse + "}";
  const double expected = (0.6 + 0.8) * std::sqrt(0.5);
  EXPECT_NEAR(brightness(material, kFromAbove, kLight), expected, 0.01);
  EXPECT_NEAR(brightness(material, kFromAbove, kLight, true), expected, 0.01);
}

TEST(Gltf, CoverageLetsLightPass) {
  const std::string blend =
      "{'alphaMode':'BLEND','pbrMetallicRoughness':{'metallicFactor':0,'baseColorFactor':[1,1,1,0.25]},"
      "'extensions':{'KHR_materials_specular':{'specularFactor':0}}}";
  EXPECT_NEAR(brightness(blend, kFromAbove, kLight), 0.25 * std::sqrt(0.5), 0.02);
}

TEST(Gltf, UnlitSurfacesAreAsBrightAsTheirColour) {
  EXPECT_NEAR(
      brightness("{'pbrMetallicRoughness':{'baseColorFactor':[0.3,1,1,1]},'extensions':{'KHR_materials_unlit':{}}}",
                 kFromAbove, kLight),
      0.3, 1e-4);
}

TEST(Gltf, BacksOfOneSidedSurfacesAreNotThere) {
  // Before the square that shines, and turned away from the camera.
  const std::string turned = ",{'mesh':0,'translation':[0,0,1],'rotation':[0,1,0,0]}";
  const std::string material = "{'emissiveFactor':[0.5,0,0],'pbrMetallicRoughness':{'baseColorFactor':[0,0,0,1]}";
  EXPECT_NEAR(brightness(material + "}", turned, {}, false, {{"sky", "false"}}), 0.5, 1e-4);
}

}  // namespace
}  // namespace norrsken::end_to_end
