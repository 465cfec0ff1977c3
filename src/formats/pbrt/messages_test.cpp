// What is said of scenes that are wrong, or that are shown otherwise than by pbrt.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/pbrt/pbrt_testing.h"

namespace norrsken::pbrt {
namespace {

using testing::HasSubstr;

TEST(PbrtMessages, ParametersThatNobodyAsksForAreErrors) {
  EXPECT_EQ(complaints_of("WorldBegin\nShape \"sphere\" \"integer radius\" 2 \"float radis\" 3"),
            "scene.pbrt:2:16: error: shape 'sphere' has no parameter 'integer radius'\n"
            "    2 | Shape \"sphere\" \"integer radius\" 2 \"float radis\" 3\n"
            "      |                ^~~~~~~~~~~~~~~~\n"
            "accepted: float alpha, float phimax, float radius, float zmax, float zmin, texture alpha\n"
            "scene.pbrt:2:35: error: shape 'sphere' has no parameter 'float radis', did you mean 'float radius'?\n"
            "    2 | Shape \"sphere\" \"integer radius\" 2 \"float radis\" 3\n"
            "      |                                   ^~~~~~~~~~~~~\n"
            "accepted: float alpha, float phimax, float radius, float zmax, float zmin, texture alpha");
  EXPECT_THAT(messages_of("WorldBegin\nMaterial \"conductor\" \"float eta\" 1.5"),
              HasSubstr("material 'conductor' has no parameter 'float eta'"));
  EXPECT_THAT(messages_of("Film \"rgb\" \"float isoo\" 1\nWorldBegin"),
              HasSubstr("film 'rgb' has no parameter 'float isoo', did you mean 'float iso'?"));
  EXPECT_THAT(messages_of("WorldBegin\nTexture \"t\" \"float\" \"constant\" \"float valeu\" 1"),
              HasSubstr("did you mean 'float value'?"));
  EXPECT_THAT(messages_of("WorldBegin\nLightSource \"point\" \"rgb L\" [ 1 1 1 ]"),
              HasSubstr("light 'point' has no parameter 'rgb L'"));
  EXPECT_EQ(messages_of("WorldBegin\nAttribute \"shape\" \"float radius\" 2\nShape \"disk\"\nShape \"trianglemesh\" "
                        "\"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]"),
            "");
}

TEST(PbrtMessages, UnknownWordsHaveANeighbour) {
  const std::pair<const char*, const char*> kCases[] = {
      {"Shpe \"sphere\"", "unknown directive 'Shpe', did you mean 'Shape'?"},
      {"Shape \"spher\"", "unknown shape 'spher', did you mean 'sphere'?"},
      {"Material \"difuse\"", "unknown material 'difuse', did you mean 'diffuse'?"},
      {"LightSource \"spt\"", "unknown light 'spt'"},
      {"Texture \"t\" \"float\" \"imgemap\"", "unknown texture 'imgemap', did you mean 'imagemap'?"},
      {"Texture \"t\" \"flaot\" \"constant\"", "unknown kind 'flaot' of a texture"},
      {"AreaLightSource \"sphere\"", "unknown area light 'sphere'"},
      {"ColorSpace \"srbg\"", "unknown color space 'srbg', did you mean 'srgb'?"},
      {"Option \"sed\" 1", "unknown option 'sed', did you mean 'seed'?"},
      {"Shape \"sphere\" \"flota radius\" 1", "unknown type 'flota' of a parameter, did you mean 'float'?"},
      {"Shape \"sphere\" \"radius\" 1", "'radius' declares no parameter"},
      {"Shape \"sphere\" \"float radius\" abc", "abc is no value of 'float radius'"},
      {"Shape \"sphere\" \"float radius\"", "'float radius' has no value"},
      {"Shape \"sphere\" \"float radius\" [ 1", "the list of 'float radius' does not end"},
      {"Shape \"sphere\" \"float radius\" [ 1 2 ]", "'radius' of shape 'sphere' has 2 values"},
      {"Shape \"trianglemesh\" \"integer indices\" [ 1.5 ]", "1.5 is no value of 'integer indices'"},
      {"AttributeEnd", "AttributeEnd without a beginning"},
      {"ObjectBegin \"a\"\nObjectBegin \"b\"", "an object inside of another"},
      {"ObjectBegin \"a\"\nObjectInstance \"a\"", "an instance inside of an object"},
      {"Camera \"perspective\"", "Camera behind WorldBegin"},
      {"AttributeBegin", "the block does not end"},
      {"ObjectInstance \"a\"", "there is no object 'a'"},
      {"NamedMaterial \"a\"\nShape \"sphere\"", "there is no material 'a'"},
      {"Material \"diffuse\" \"texture reflectance\" \"a\"", "there is no spectrum texture 'a'"},
      {"Material \"diffuse\" \"rgb reflectance\" [ 2 0 0 ]", "'reflectance' of material 'diffuse' is 2 0 0"},
      {"Texture \"a\" \"float\" \"scale\" \"texture tex\" \"a\"\nShape \"sphere\" \"texture alpha\" \"a\"",
       "texture 'a' is made of itself"},
      {"MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [ \"m\" \"m\" ]",
       "material 'mix' is made of itself"},
      {"Scale 1 0 1\nShape \"sphere\"", "shape 'sphere' is placed where it has no volume"},
      {"Scale 1 0 1\nLightSource \"point\"", "light 'point' is placed where it has no volume"},
      {"Shape \"plymesh\" \"string filename\" \"no.ply\"", "there is no file 'no.ply'"},
      {"Shape \"plymesh\"", "shape 'plymesh' has no file"},
      {"Shape \"curve\" \"point3 P\" [ 0 0 0 1 1 1 ]", "shape 'curve' has 2 control points"},
      {"Translate 1 2 x", "'x' in the numbers of Translate"},
      {"Include \"scene.pbrt\"", "the file includes itself: scene.pbrt -> scene.pbrt"},
      {"LightSource \"spot\" \"float coneangle\" 5 \"float conedeltaangle\" 10",
       "the cone of light 'spot' is 5 degrees with an edge of 10"},
      {"LightSource \"infinite\" \"rgb L\" [ 1 1 1 ] \"string filename\" \"a\"",
       "light 'infinite' has 'filename' beside 'L'"},
  };
  for (const auto& [scene, message] : kCases)
    EXPECT_THAT(messages_of(std::string("WorldBegin\n") + scene), HasSubstr(message)) << scene;
}

TEST(PbrtMessages, PartsOfAFileHaveTheirOrder) {
  EXPECT_EQ(messages_of("Shape \"sphere\""), "Shape before WorldBegin\n");
  EXPECT_EQ(messages_of("Camera \"perspective\""), "the scene ends before its world\n");
  EXPECT_EQ(messages_of("WorldBegin\nWorldBegin"), "WorldBegin behind WorldBegin\n");
}

TEST(PbrtMessages, WhatIsUnsupportedIsToldOncePerName) {
  EXPECT_EQ(
      messages_of("WorldBegin\nMakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\nMediumInterface \"fog\" \"\"\n"
                  "Material \"subsurface\"\nShape \"sphere\"\nMaterial \"subsurface\"\nShape \"sphere\""),
      "media are not supported: 'fog'; instead: empty space\n"
      "material 'subsurface' is not supported; instead: a coat over a surface that scatters as much light back where "
      "it "
      "came in\n");
  EXPECT_EQ(
      messages_of("Camera \"spherical\"\nIntegrator \"bdpt\"\nFilm \"rgb\" \"float maxcomponentvalue\" 10\nWorldBegin"),
      "maxcomponentvalue is not supported; instead: samples as they are\n"
      "camera 'spherical' is not supported; instead: a perspective camera of 90 degrees\n"
      "integrator 'bdpt' is not supported; instead: path\n");
}

TEST(PbrtMessages, ComplaintsOfIncludedFilesSayWhereTheyAreNamed) {
  EXPECT_EQ(complaints_of({{"scene.pbrt", "WorldBegin\nInclude \"a.pbrt\"\n"}, {"a.pbrt", "Shape \"sfere\"\n"}}),
            "a.pbrt:1:7: error: unknown shape 'sfere', did you mean 'sphere'? (named at scene.pbrt:2:9)\n"
            "    1 | Shape \"sfere\"\n"
            "      |       ^~~~~~~\n"
            "accepted: bilinearmesh, curve, cylinder, disk, loopsubdiv, plymesh, sphere, trianglemesh");
}

}  // namespace
}  // namespace norrsken::pbrt
