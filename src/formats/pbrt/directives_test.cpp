#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "formats/pbrt/pbrt_testing.h"

namespace norrsken::pbrt {
namespace {

using testing::HasSubstr;

/// The matrix of the sphere that is placed by `world`, upside down as spheres are: see shapes.cpp.
std::string placed(const std::string& world, const std::string& header = {}) {
  const std::string text = node_of_scene("shape", header + "WorldBegin\n" + world + "\nShape \"sphere\"");
  const std::size_t at = text.find("matrix ");
  return at == std::string::npos ? text : text.substr(at + 7, text.find('\n', at) - at - 7);
}

TEST(PbrtDirectives, TransformsMultiplyOnTheRight) {
  EXPECT_EQ(placed("Translate 1 2 3\nScale 2 2 2"), "2 0 0 1 0 2 0 2 0 0 -2 3 0 0 0 1");
  EXPECT_EQ(placed("Scale 2 2 2\nTranslate 1 2 3"), "2 0 0 2 0 2 0 4 0 0 -2 6 0 0 0 1");
  EXPECT_EQ(placed("Translate 9 9 9\nIdentity\nTranslate 1 2 3"), "1 0 0 1 0 1 0 2 0 0 -1 3 0 0 0 1");
  EXPECT_EQ(placed("Translate 9 9 9\nTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  4 5 6 1 ]"),
            "1 0 0 4 0 1 0 5 0 0 -1 6 0 0 0 1");
  EXPECT_EQ(placed("Translate 1 0 0\nConcatTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  4 5 6 1 ]"),
            "1 0 0 5 0 1 0 5 0 0 -1 6 0 0 0 1");
  EXPECT_THAT(placed("Rotate 90 0 0 1"), HasSubstr(" -1 0 0 1 "));
}

TEST(PbrtDirectives, BlocksKeepEverything) {
  EXPECT_EQ(
      placed(
          "AttributeBegin\nTranslate 1 0 0\nTransformBegin\nScale 2 2 2\nTransformEnd\nAttributeEnd\nTranslate 0 1 0"),
      "1 0 0 0 0 1 0 1 0 0 -1 0 0 0 0 1");
  EXPECT_THAT(node_of("bsdf", "AttributeBegin\nMaterial \"dielectric\"\nAttributeEnd\nShape \"sphere\""),
              HasSubstr("diffuse"));
}

TEST(PbrtDirectives, CoordinateSystemsHaveNames) {
  EXPECT_EQ(
      placed("AttributeBegin\nTranslate 1 2 3\nCoordinateSystem \"here\"\nAttributeEnd\nCoordSysTransform \"here\""),
      "1 0 0 1 0 1 0 2 0 0 -1 3 0 0 0 1");
  EXPECT_EQ(placed("CoordSysTransform \"camera\"", "Translate -1 -2 -3\nCamera \"perspective\"\n"),
            "1 0 0 1 0 1 0 2 0 0 -1 3 0 0 0 1");
  EXPECT_EQ(messages_of("WorldBegin\nCoordSysTransform \"there\""), "there is no coordinate system 'there'\n");
}

TEST(PbrtDirectives, WhatMovesIsShownAtTheStart) {
  EXPECT_EQ(placed("ActiveTransform EndTime\nTranslate 9 0 0\nActiveTransform StartTime\nTranslate 1 0 "
                   "0\nActiveTransform All\nTranslate 0 0 1"),
            "1 0 0 1 0 1 0 0 0 0 -1 1 0 0 0 1");
}

TEST(PbrtDirectives, IncludesAreTextAndImportsKeepTheirState) {
  const TestFiles files = {{"move.pbrt", "Translate 1 0 0\n"}};
  const auto shape = [&](const std::string& by) {
    return node_of_scene("shape", "WorldBegin\n" + by + " \"move.pbrt\"\nShape \"sphere\"", files);
  };
  EXPECT_THAT(shape("Include"), HasSubstr("matrix 1 0 0 1 0"));
  EXPECT_THAT(shape("Import"), HasSubstr("matrix 1 0 0 0 0"));
}

TEST(PbrtDirectives, AttributesAreDefaultsOfParameters) {
  EXPECT_THAT(
      node_of("shape",
              "Attribute \"shape\" \"float radius\" 2\nAttribute \"shape\" \"float radius\" 3\nShape \"sphere\""),
      HasSubstr("radius = 3\n"));
  EXPECT_THAT(node_of("shape", "Attribute \"shape\" \"float radius\" 2\nShape \"sphere\" \"float radius\" 4"),
              HasSubstr("radius = 4\n"));
  EXPECT_THAT(
      node_of("shape", "AttributeBegin\nAttribute \"shape\" \"float radius\" 2\nAttributeEnd\nShape \"sphere\""),
      HasSubstr("radius = 1\n"));
}

TEST(PbrtDirectives, ColorSpacesHoldForWhatFollows) {
  const auto color = [](const std::string& space, const std::string& rgb) {
    return node_of("bsdf", "ColorSpace \"" + space + "\"\nMaterial \"diffuse\" \"rgb reflectance\" [ " + rgb +
                               " ]\nShape \"sphere\"");
  };
  EXPECT_THAT(color("sRGB", ".2 .4 .6"), HasSubstr("rgb 0.2 0.4 0.6\n"));
  for (const char* space : {"dci-p3", "rec2020", "aces2065-1"})
    EXPECT_THAT(color(space, ".5 .5 .5"), HasSubstr("rgb 0.5 0.5 0.5\n")) << space;
  // BT.2087 has the matrix from BT.2020 to BT.709: 1.6605 -0.5876 -0.0728.
  EXPECT_THAT(color("rec2020", ".5 .4 .3"), HasSubstr("rgb 0.5733"));
}

TEST(PbrtDirectives, OptionsAreReadInAnySpelling) {
  EXPECT_THAT(node_of_scene("sampler", "Option \"seed\" 7\nWorldBegin"), HasSubstr("seed = 7\n"));
  EXPECT_EQ(messages_of("Option \"disable_pixel-jitter\" false\nOption \"rendercoordsys\" \"world\"\nOption \"string "
                        "rendercoordsys\" [ \"world\" ]\nWorldBegin"),
            "");
  EXPECT_THAT(messages_of("Option \"forcediffuse\" true\nWorldBegin"), HasSubstr("not supported"));
}

TEST(PbrtDirectives, OldWordsHaveTheirMeaningToday) {
  EXPECT_EQ(node_of("bsdf", "Material \"matte\" \"color Kd\" [ .1 .2 .3 ]\nShape \"sphere\""),
            node_of("bsdf", "Material \"diffuse\" \"rgb reflectance\" [ .1 .2 .3 ]\nShape \"sphere\""));
  EXPECT_EQ(
      node_of("bsdf", "Material \"plastic\"\nShape \"sphere\""),
      node_of(
          "bsdf",
          "Material \"coateddiffuse\" \"float roughness\" .1 \"rgb reflectance\" [ .25 .25 .25 ]\nShape \"sphere\""));
  EXPECT_EQ(messages_of("Film \"image\"\nWorldBegin\nMaterial \"matte\" \"rgb Kd\" [ 0 0 0 ]\nWorldEnd"),
            "Film 'image', of pbrt's version 3, is 'rgb'\nMaterial 'matte', of pbrt's version 3, is 'diffuse'\n"
            "'Kd' of Material 'matte', of pbrt's version 3, is 'reflectance'\nWorldEnd, of pbrt's version 3, is not "
            "needed\n");
}

}  // namespace
}  // namespace norrsken::pbrt
