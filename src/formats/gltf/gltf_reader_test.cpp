// What becomes of glTF files, and what is said of those that are wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "formats/gltf/gltf_testing.h"
#include "formats/gltf/json.h"

namespace norrsken::gltf {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A scene of one node with one primitive of `attributes`; the buffer is "b.bin" of `bytes`, in views of the given lengths.
TestFiles primitive(const std::string& primitive, const std::string& accessors, const std::string& bytes,
                    const std::vector<std::size_t>& views, const std::string& more = {}) {
  std::string list;
  std::size_t at = 0;
  for (const std::size_t length : views) {
    list += (list.empty() ? "" : ",") + std::string("{'buffer':0,'byteOffset':") + std::to_string(at) +
            ",'byteLength':" + std::to_string(length) + "}";
    at += length;
  }
  const std::string nodes = more.find("'nodes'") == std::string::npos ? "'nodes':[{'mesh':0}],\n" : "";
  return {{"a.gltf", file(nodes + "'meshes':[{'primitives':[" + primitive + "]}],\n'accessors':[" + accessors +
                          "],\n'bufferViews':[" + list + "],\n'buffers':[{'uri':'b.bin','byteLength':" +
                          std::to_string(bytes.size()) + "}]" + (more.empty() ? "" : ",\n" + more))},
          {"b.bin", bytes}};
}

const std::string kCorners = Bytes().add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}).text();
const std::string kPositions = "{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3'}";

TestFiles corners(const std::string& members, const std::string& more = {}) {
  return primitive("{'attributes':{'POSITION':0}" + members + "}", kPositions, kCorners, {48}, more);
}

std::shared_ptr<const Mesh> first_mesh(const TestFiles& files, const TestParameters& parameters = {}) {
  const auto shapes = nodes_of(files, "shape", parameters);
  return shapes.empty() ? std::make_shared<const Mesh>() : mesh_of(*shapes[0]);
}

std::string first_text(const TestFiles& files, const std::string& kind, const TestParameters& parameters = {}) {
  const auto nodes = nodes_of(files, kind, parameters);
  return nodes.empty() ? "none" : text_of(*nodes[0]);
}

TEST(GltfJson, TellsWhereValuesAre) {
  MemoryReservation memory{0};
  JsonFault fault;
  const std::string text = R"({"a": [1, {"b/c": -2.5e1 }], "d":"x"})";
  const auto root = parse_json(text, memory, fault);
  ASSERT_TRUE(root) << fault.message;
  const Json& b = root->find("a")->items[1].members[0].second;
  EXPECT_EQ(b.number, -25);
  EXPECT_EQ(text.substr(b.offset, b.length), "-2.5e1");
  EXPECT_EQ(pointer_to(*root, b), "/a/1/b~1c");
  EXPECT_EQ(text.substr(root->find("d")->offset, 3), R"("x")");
}

TEST(GltfJson, IsBoundedInDepth) {
  EXPECT_THAT(complaints_of({{"a.gltf", std::string(100000, '[')}}),
              HasSubstr("a.gltf:1:65: error: the JSON is damaged: more than 64"));
  EXPECT_THAT(complaints_of({{"a.gltf", "{\n\"asset\": {1} }"}}), HasSubstr("a.gltf:2:"));
}

TEST(GltfPrimitives, AreTrianglesStripsAndFans) {
  EXPECT_THAT(first_mesh(corners(",'mode':5"))->triangles, ElementsAre(0, 1, 2, 1, 3, 2));
  EXPECT_THAT(first_mesh(corners(",'mode':6"))->triangles, ElementsAre(1, 2, 0, 2, 3, 0));
  EXPECT_THAT(first_mesh(corners(""))->triangles, ElementsAre(0, 1, 2));
  EXPECT_THAT(complaints_of(corners(",'mode':1")), HasSubstr("warning: points and lines have no area"));
}

TEST(GltfPrimitives, WithoutNormalsAreFlatAndKeepTheirFrontWhenMirrored) {
  EXPECT_THAT(first_text(corners(""), "shape"),
              AllOf(HasSubstr("face_normals = true"), Not(HasSubstr("flip_normals"))));
  EXPECT_THAT(first_text(corners("", "'nodes':[{'mesh':0,'scale':[-1,1,1]}]"), "shape"),
              HasSubstr("flip_normals = true"));
}

TEST(GltfPrimitives, WithoutAreaAreLeftOut) {
  EXPECT_EQ(
      nodes_of(primitive("{'attributes':{'POSITION':0}}", kPositions, std::string(48, '\0'), {48}), "shape").size(),
      0u);
}

TEST(GltfAccessors, OfIntegersAreFractionsIfTheyAreNormalized) {
  const std::string bytes = Bytes().add<std::int16_t>({32767, -32768, 0, 0, 16384, 0, 0, 0, 0}).text();
  const auto mesh = first_mesh(
      primitive("{'attributes':{'POSITION':0}}",
                "{'bufferView':0,'componentType':5122,'normalized':true,'count':3,'type':'VEC3'}", bytes, {18}));
  ASSERT_EQ(mesh->positions.size(), 9u);
  EXPECT_FLOAT_EQ(mesh->positions[0], 1);
  EXPECT_FLOAT_EQ(mesh->positions[1], -1);
  EXPECT_FLOAT_EQ(mesh->positions[4], 16384.0f / 32767);
  const auto plain = first_mesh(primitive(
      "{'attributes':{'POSITION':0}}", "{'bufferView':0,'componentType':5122,'count':3,'type':'VEC3'}", bytes, {18}));
  EXPECT_FLOAT_EQ(plain->positions[0], 32767);
}

TEST(GltfAccessors, AreReplacedInPlaces) {
  const std::string bytes = kCorners + Bytes().add<std::uint16_t>({2, 0}).add<float>({5, 6, 7}).text();
  const auto mesh =
      first_mesh(primitive("{'attributes':{'POSITION':0}}",
                           "{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3','sparse':{'count':1,"
                           "'indices':{'bufferView':1,'componentType':5123},'values':{'bufferView':2}}}",
                           bytes, {48, 4, 12}));
  EXPECT_THAT(mesh->positions, ElementsAre(0, 0, 0, 1, 0, 0, 5, 6, 7, 1, 1, 0));
}

TEST(GltfAccessors, ThatDoNotFitAreErrorsWithTheirPlace) {
  EXPECT_THAT(complaints_of(primitive("{'attributes':{'POSITION':0}}",
                                      "{'bufferView':0,'componentType':5126,'count':5,'type':'VEC3'}", kCorners, {48})),
              AllOf(HasSubstr("a.gltf:4:14: error: 5 elements of 12 bytes"), HasSubstr("(at /accessors/0)")));
  EXPECT_THAT(complaints_of(primitive("{'attributes':{'POSITION':0}}", kPositions, kCorners, {49})),
              HasSubstr("the buffer view goes from byte 0 to 49 of a buffer that has 48"));
  EXPECT_THAT(complaints_of(corners(",'indices':7")), HasSubstr("there is no element 7 of 'accessors'"));
}

TEST(GltfBuffers, MayStandInTheFile) {
  std::string text = corners("").at("a.gltf");
  const std::string uri = R"("uri":"b.bin")";
  text.replace(
      text.find(uri), uri.size(),
      R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAA")");
  EXPECT_THAT(first_mesh({{"a.gltf", text}})->positions, ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0));
}

TEST(GltfBuffers, MayNotBeOutsideOfTheFolder) {
  for (const std::string path : {"../b.bin", "/b.bin", "x/../../b.bin", "%2e%2e/b.bin"}) {
    std::string text = corners("").at("a.gltf");
    text.replace(text.find("b.bin"), 5, path);
    EXPECT_THAT(complaints_of({{"a.gltf", text}}), HasSubstr("is outside of the scene's folder"));
  }
}

TEST(GltfNodes, AreATree) {
  EXPECT_THAT(complaints_of({{"a.gltf", file("'nodes':[{'children':[1]},{'children':[0]}]")}}),
              HasSubstr("nodes are children of themselves"));
  EXPECT_THAT(complaints_of({{"a.gltf", file("'nodes':[{'children':[2]},{'children':[2]},{}]")}}),
              HasSubstr("a node has two parents"));
}

TEST(GltfNodes, ArePlacedByTheirParents) {
  const TestFiles files = corners("",
                                  "'nodes':[{'children':[1],'translation':[1,2,3]},{'mesh':0,'rotation':[0,0,0."
                                  "7071067811865476,0.7071067811865476],"
                                  "'scale':[2,2,2]}]");
  EXPECT_THAT(first_text(files, "shape"), HasSubstr(" -2 0 1 2 "));
}

TEST(GltfNodes, AreInstancedAndHidden) {
  const std::string bytes = kCorners + Bytes().add<float>({1, 0, 0, 2, 0, 0}).text();
  const auto files =
      primitive("{'attributes':{'POSITION':0}}",
                kPositions + ",{'bufferView':1,'componentType':5126,'count':2,'type':'VEC3'}", bytes, {48, 24},
                "'nodes':[{'mesh':0,'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':1}}}},"
                "{'mesh':0,'extensions':{'KHR_node_visibility':{'visible':false}}}]");
  EXPECT_EQ(nodes_of(files, "shape").size(), 2u);
}

TEST(GltfAnimations, AreAskedForByTheTime) {
  const std::string bytes = kCorners + Bytes().add<float>({0, 2}).add<float>({0, 0, 0, 4, 0, 0}).text();
  const auto files = primitive("{'attributes':{'POSITION':0}}",
                               kPositions +
                                   ",{'bufferView':1,'componentType':5126,'count':2,'type':'SCALAR'},"
                                   "{'bufferView':2,'componentType':5126,'count':2,'type':'VEC3'}",
                               bytes, {48, 8, 24},
                               "'animations':[{'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}],'"
                               "samplers':[{'input':1,'output':2}]}]");
  EXPECT_THAT(first_text(files, "shape"), Not(HasSubstr("to_world")));
  EXPECT_THAT(complaints_of(files), HasSubstr("-Dtime=SECONDS"));
  EXPECT_THAT(first_text(files, "shape", {{"time", "0.5"}}), HasSubstr("matrix 1 0 0 1 0 1 0 0"));
}

TEST(GltfSkins, MoveVerticesToTheirJoints) {
  const std::string bytes = kCorners +
                            Bytes().add<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}).text() +
                            Bytes().add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}).text();
  const auto files = primitive("{'attributes':{'POSITION':0,'JOINTS_0':1,'WEIGHTS_0':2}}",
                               kPositions +
                                   ",{'bufferView':1,'componentType':5121,'count':4,'type':'VEC4'},"
                                   "{'bufferView':2,'componentType':5126,'count':4,'type':'VEC4'}",
                               bytes, {48, 16, 64},
                               "'nodes':[{'mesh':0,'skin':0,'translation':[9,9,9]},{},{'translation':[0,3,0]}],"
                               "'skins':[{'joints':[1,2]}]");
  EXPECT_THAT(first_mesh(files)->positions, ElementsAre(0, 0, 0, 1, 0, 0, 0, 4, 0, 1, 4, 0));
}

TEST(GltfMaterials, AreMetalWhereNothingIsSaid) {
  EXPECT_THAT(first_text(corners(""), "shape"),
              AllOf(HasSubstr("bsdf twosided"), HasSubstr("bsdf gltf"), HasSubstr("bsdf null"),
                    HasSubstr("metallic = 1"), HasSubstr("roughness = 1"), HasSubstr("base_color = rgb 1 1 1")));
}

TEST(GltfMaterials, HaveLayersOfExtensions) {
  const std::string text = first_text(
      corners(
          ",'material':0",
          "'materials':[{'doubleSided':true,'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[0.5,0.6,0.7,"
          "0.25],"
          "'metallicFactor':0},'emissiveFactor':[1,0.5,0],'extensions':{'KHR_materials_ior':{'ior':1.4},"
          "'KHR_materials_emissive_strength':{'emissiveStrength':4},'KHR_materials_specular':{'specularFactor':0.5},"
          "'KHR_materials_transmission':{'transmissionFactor':0.75},'KHR_materials_volume':{'thicknessFactor':2,"
          "'attenuationDistance':1,'attenuationColor':[0.5,1,1]},'KHR_materials_clearcoat':{'clearcoatFactor':0.3}}}]"),
      "shape");
  EXPECT_THAT(text, AllOf(HasSubstr("bsdf mask"), HasSubstr("opacity = 0.25"), HasSubstr("ior = 1.4"),
                          HasSubstr("specular = 0.5"), HasSubstr("transmission = 0.75"), HasSubstr("thin = false"),
                          // Half of the way of 2 through what lets a half of the red light pass on a way of 1.
                          HasSubstr("base_color = rgb 0.25 0.6 0.7"), HasSubstr("clearcoat = 0.3")));
  EXPECT_THAT(text, AllOf(HasSubstr("radiance = rgb 1 0.5 0"), Not(HasSubstr("twosided"))));
}

TEST(GltfMaterials, ThatAreUnlitShineAlone) {
  EXPECT_THAT(first_text(corners(",'material':0",
                                 "'materials':[{'pbrMetallicRoughness':{'baseColorFactor':[0.5,0.6,0.7,1]},"
                                 "'extensions':{'KHR_materials_unlit':{}}}]"),
                         "shape"),
              AllOf(HasSubstr("radiance = rgb 0.5 0.6 0.7"), HasSubstr("reflectance = 0"), Not(HasSubstr("gltf"))));
}

TEST(GltfMaterials, AreChosenByVariant) {
  const TestFiles files =
      corners(",'material':0,'extensions':{'KHR_materials_variants':{'mappings':[{'material':1,'variants':[1]}]}}",
              "'materials':[{},{'pbrMetallicRoughness':{'roughnessFactor':0.5}}],"
              "'extensions':{'KHR_materials_variants':{'variants':[{'name':'day'},{'name':'night'}]}}");
  EXPECT_THAT(first_text(files, "shape"), HasSubstr("roughness = 1"));
  EXPECT_THAT(first_text(files, "shape", {{"variant", "night"}}), HasSubstr("roughness = 0.5"));
  EXPECT_THAT(complaints_of(files, {{"variant", "nihgt"}}), HasSubstr("did you mean 'night'?"));
}

TEST(GltfTextures, AreMovedAndWrapped) {
  const std::string bytes = kCorners + Bytes().add<float>({0, 0, 1, 0, 0, 1, 1, 1}).text();
  TestFiles files = primitive(
      "{'attributes':{'POSITION':0,'TEXCOORD_0':1},'material':0}",
      kPositions + ",{'bufferView':1,'componentType':5126,'count':4,'type':'VEC2'}", bytes, {48, 32},
      "'materials':[{'pbrMetallicRoughness':{'baseColorFactor':[0.5,1,1,1],'baseColorTexture':{'index':0,'extensions':{"
      "'KHR_texture_transform':{'offset':[0.25,0.5],'scale':[2,3],'rotation':1.5707963267948966}}}}}],"
      "'textures':[{'source':0,'sampler':0}],'samplers':[{'wrapS':33071,'wrapT':33648,'magFilter':9728}],"
      "'images':[{'uri':'i.ppm'}]");
  files["i.ppm"] = "P3 1 1 255 255 255 255\n";
  EXPECT_THAT(first_text(files, "shape"),
              AllOf(HasSubstr("texture bitmap 'base_color'"), HasSubstr("wrap_mode_u = clamp"),
                    HasSubstr("wrap_mode_v = mirror"), HasSubstr("filter_type = nearest"), HasSubstr(" 3 0 0.25 -2 "),
                    HasSubstr(" 0 0.5 0 0 1 0")));
}

TEST(GltfCameras, LookAlongMinusZ) {
  const TestFiles files = corners("",
                                  "'nodes':[{'mesh':0},{'camera':0}],'cameras':[{'type':'perspective','perspective':{'"
                                  "yfov':1,'aspectRatio':2,'znear':0.5}}]");
  EXPECT_THAT(first_text(files, "sensor"), AllOf(HasSubstr("fov = 57.295779"), HasSubstr("fov_axis = y"),
                                                 HasSubstr("matrix -1 0 0 0 0 1 0 0 0 0 -1 0"),
                                                 HasSubstr("width = 1152"), HasSubstr("near_clip = 0.5")));
  EXPECT_THAT(
      first_text(corners("",
                         "'nodes':[{'mesh':0},{'camera':0}],'cameras':[{'type':'orthographic','orthographic':{'xmag':3,"
                         "'ymag':2,'znear':0.5,'zfar':10}}]"),
                 "sensor"),
      AllOf(HasSubstr("sensor orthographic"), HasSubstr("matrix -3 0 0 0 0 3 0 0 0 0 -1 0"), HasSubstr("width = 864")));
}

TEST(GltfCameras, AreAddedWhereThereAreNone) {
  EXPECT_THAT(complaints_of(corners("")), AllOf(HasSubstr("note: the scene has no camera: all of it is framed"),
                                                HasSubstr("note: the scene has no light: a grey sky")));
  EXPECT_EQ(nodes_of(corners(""), "emitter").size(), 1u);
  EXPECT_EQ(nodes_of(corners(""), "emitter", {{"sky", "false"}}).size(), 0u);
}

TEST(GltfLights, ArePhotometric) {
  const TestFiles files =
      corners("",
              "'nodes':[{'mesh':0},{'translation':[0,0,5],'extensions':{'KHR_lights_punctual':{'light':0}}}],"
              "'extensions':{'KHR_lights_punctual':{'lights':[{'type':'point','intensity':1366,'color':[1,0.5,0]}]}}");
  EXPECT_THAT(first_text(files, "emitter"), AllOf(HasSubstr("intensity = rgb 2 1 0"), HasSubstr("position = 0 0 5")));
  EXPECT_THAT(first_text(files, "emitter", {{"lumens_per_watt", "1"}}), HasSubstr("intensity = rgb 1366 683 0"));
  EXPECT_EQ(nodes_of(files, "emitter").size(), 1u);
  EXPECT_THAT(complaints_of(files), HasSubstr("note: 683 candela or lux of a light are 1 W/sr or W/m^2"));
}

TEST(GltfExtensions, ThatAreRequiredAndNotSupportedAreErrors) {
  EXPECT_THAT(complaints_of({{"a.gltf", file("'extensionsRequired':['KHR_draco_mesh_compression']")}}),
              AllOf(HasSubstr("a.gltf:2:23: error: the file requires the extension 'KHR_draco_mesh_compression'"),
                    HasSubstr("(at /extensionsRequired/0)")));
  EXPECT_THAT(complaints_of({{"a.gltf", file("'extensionsUsed':['VENDOR_thing']")}}),
              HasSubstr("warning: the extension 'VENDOR_thing' is not supported"));
}

TEST(GltfFiles, AreToldByWhatTheyBeginWith) {
  EXPECT_TRUE(looks_like_gltf("glTF\2\0\0\0"));
  EXPECT_TRUE(looks_like_gltf(file("")));
  EXPECT_FALSE(looks_like_gltf("{\"a\":1}"));
  EXPECT_THAT(complaints_of({{"a.gltf", "{}"}}), HasSubstr("it has no 'asset'"));
  EXPECT_THAT(complaints_of({{"a.gltf", R"({"asset":{"version":"1.0"}})"}}),
              HasSubstr("version '1.0' of glTF is not supported"));
  EXPECT_THAT(complaints_of({{"a.gltf", "glTF\2"}}), HasSubstr("the binary glTF is cut off"));
}

TEST(GltfFiles, MayBeBinary) {
  const std::string json =
      file("'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],'accessors':[" + kPositions +
           "],'bufferViews':[{'buffer':0,'byteLength':48}],'buffers':[{'byteLength':48}]");
  const auto word = [](std::size_t value) {
    return Bytes().add<std::uint32_t>({static_cast<std::uint32_t>(value)}).text();
  };
  std::string glb = word(json.size()) + "JSON" + json + word(48) + std::string("BIN\0", 4) + kCorners;
  glb = "glTF" + word(2) + word(glb.size() + 12) + glb;
  EXPECT_EQ(first_mesh({{"a.gltf", glb}})->positions.size(), 12u);
  glb.resize(glb.size() - 10);
  EXPECT_THAT(complaints_of({{"a.gltf", glb}}), HasSubstr("the binary glTF is damaged"));
}

}  // namespace
}  // namespace norrsken::gltf
