#include "scene/parameters_testing.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

namespace norrsken {

std::vector<std::pair<std::string_view, std::string_view>> builtin_files() { return {}; }

namespace {

using Choice = ChoiceParameter<std::string_view>;

TEST_F(ParametersTest, ReadsEveryType) {
  give("b", "boolean", true);
  give("i", "integer", std::int64_t{7});
  give("f", "float", 2.5);
  give("s", "string", std::string("word"));
  give("c", "rgb", Property::Rgb{{0.1, 0.2, 0.3}});
  give("p", "point", Property::Vector{{1, 2, 3}});
  give("t", "transform", glm::translate(glm::dmat4(1), {1, 2, 3}));
  Parameters p = parameters();
  EXPECT_TRUE(p.read(BooleanParameter{"b", false}));
  EXPECT_EQ(p.read(IntegerParameter{"i", 0, 0, 10}), 7);
  EXPECT_EQ(p.read(NumberParameter{"f", 0, {0, 10}}), 2.5);
  EXPECT_EQ(p.read(NumberParameter{"i", 0, {0, 10}}), 7) << "an integer will do as a number";
  EXPECT_EQ(p.read(TextParameter{"s", ""}), "word");
  EXPECT_EQ(p.read(Choice{"s", {{{"other", "other"}, {"word", "word"}}}}), "word");
  EXPECT_EQ(p.read(ColorParameter{.name = "c", .fallback = 0, .range = {0, 1}}).rgb(), glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(p.read(ColorParameter{.name = "f", .fallback = 0, .range = {0, 5}}).rgb(), glm::dvec3(2.5))
      << "a float is grey";
  EXPECT_EQ(p.read(PointParameter{"p"}), glm::dvec3(1, 2, 3));
  EXPECT_EQ(p.read(TransformParameter{"t"})[3], glm::dvec4(1, 2, 3, 1));
  p.finish();
  EXPECT_EQ(complaint(), "");
}

TEST_F(ParametersTest, WhatIsNotGivenIsTheFallback) {
  Parameters p = parameters();
  EXPECT_TRUE(p.read(BooleanParameter{"x", true}));
  EXPECT_EQ(p.read(IntegerParameter{"x", 5, 0, 10}), 5);
  EXPECT_EQ(p.read(NumberParameter{"x", 0.5, {0, 10}}), 0.5);
  EXPECT_EQ(p.read(TextParameter{"x", "t"}), "t");
  EXPECT_EQ(p.read(Choice{"x", {{{"a", "a"}, {"b", "b"}}}}), "a");
  EXPECT_EQ(p.read(ColorParameter{.name = "x", .fallback = 0.5, .range = {0, 1}}).rgb(), glm::dvec3(0.5));
  EXPECT_EQ(p.read(PointParameter{"x", {1, 2, 3}}), glm::dvec3(1, 2, 3));
  EXPECT_EQ(p.read(TransformParameter{"x"}), glm::dmat4(1));
  EXPECT_FALSE(p.has("x"));
  p.finish();
  EXPECT_EQ(complaint(), "");
}

TEST_F(ParametersTest, WrongTypes) {
  give("fov", "string", std::string("abc"));
  give("spp", "float", 4.0);
  give("on", "rgb", Property::Rgb{});
  Parameters p = parameters();
  EXPECT_EQ(p.read(NumberParameter{"fov", 45, {0, 180}}), 45);
  EXPECT_EQ(p.read(IntegerParameter{"spp", 4, 1, 100}), 4);
  EXPECT_FALSE(p.read(BooleanParameter{"on", false}));
  p.finish();
  EXPECT_EQ(complaint(),
            "2: 'fov' is a string (accepted: float); 2: 'spp' is a float (accepted: integer); "
            "2: 'on' is an rgb (accepted: boolean)");
}

TEST_F(ParametersTest, RangesAreNamed) {
  give("fov", "float", 270.0);
  give("spp", "integer", std::int64_t{0});
  give("radius", "float", -1.0);
  give("huge", "float", 1e300);
  Parameters p = parameters();
  EXPECT_EQ(p.read(NumberParameter{"fov", 45, {0, 180}}), 45);
  EXPECT_EQ(p.read(IntegerParameter{"spp", 4, 1, std::numeric_limits<std::int64_t>::max()}), 4);
  EXPECT_EQ(p.read(NumberParameter{"radius", 1, {0, kInfinity}}), 1);
  EXPECT_EQ(p.read(NumberParameter{"huge", 1, {-kInfinity, kInfinity}}), 1);
  EXPECT_EQ(complaint(),
            "2: 'fov' is 270 (accepted: a number from 0 to 180); 2: 'spp' is 0 (accepted: an integer of at least 1); "
            "2: 'radius' is -1 (accepted: a number of at least 0); 2: 'huge' is 1e+300 (accepted: a number of at most "
            "1e+30)");
}

TEST_F(ParametersTest, ChoicesAreListed) {
  give("axis", "string", std::string("hieght"));
  give("mode", "integer", std::int64_t{1});
  Parameters p = parameters();
  EXPECT_EQ(p.read(Choice{"axis", {{{"width", "width"}, {"height", "height"}}}}), "width");
  EXPECT_EQ(p.read(Choice{"mode", {{{"a", "a"}, {"b", "b"}}}}), "a");
  EXPECT_EQ(complaint(),
            "2: 'axis' is 'hieght', did you mean 'height'? (accepted: width, height); "
            "2: 'mode' is an integer (accepted: string: a, b)");
}

TEST_F(ParametersTest, Colors) {
  give("bright", "rgb", Property::Rgb{{0.5, 1.5, 0.5}});
  give("negative", "spectrum", Property::Spectrum{{{400, 0.5}, {500, -1}}});
  give("grey", "spectrum", Property::Spectrum{{{0, 0.25}}});
  give("saturated", "spectrum", Property::Spectrum{{{500, 1}, {520, 1}}});
  give("flat", "spectrum", Property::Spectrum{{{300, 1}, {900, 1}}});
  Parameters p = parameters();
  EXPECT_EQ(p.read(ColorParameter{.name = "bright", .fallback = 0.1, .range = {0, 1}}).rgb(), glm::dvec3(0.1));
  EXPECT_EQ(p.read(ColorParameter{.name = "negative", .fallback = 0.1, .range = {0, 1}}).rgb(), glm::dvec3(0.1));
  EXPECT_EQ(p.read(ColorParameter{.name = "grey", .fallback = 0, .range = {0, 1}}).rgb(), glm::dvec3(0.25));
  EXPECT_NEAR(p.read(ColorParameter{.name = "grey", .fallback = 0, .range = {0, 1}, .of = ColorOf::light}).rgb().x,
              0.25 * 1.2048, 1e-3)
      << "equal energy is reddish as a light";
  EXPECT_EQ(p.read(ColorParameter{.name = "saturated", .fallback = 1, .range = {0, 1}}).rgb().x, 0)
      << "out of gamut: clamped, no complaint";
  EXPECT_NEAR(p.read(ColorParameter{.name = "flat", .fallback = 0, .range = {0, 2}}).rgb().x, 1, 1e-9);
  EXPECT_GT(p.read(ColorParameter{.name = "flat", .fallback = 0, .range = {0, 2}, .of = ColorOf::light}).rgb().x, 1.1)
      << "equal energy is reddish as a light";
  EXPECT_EQ(complaint(),
            "2: 'bright' is (0.5, 1.5, 0.5) (accepted: components from 0 to 1); "
            "2: 'negative' has a value of -1 (accepted: a spectrum with values from 0 to 1)");
}

TEST_F(ParametersTest, PlacementsMustBeUsable) {
  give("flat", "transform", glm::scale(glm::dmat4(1), {1, 0, 1}));
  give("tiny", "transform", glm::scale(glm::dmat4(1), glm::dvec3(1e-9)));
  glm::dmat4 projective(1);
  projective[0][3] = 1;
  give("projective", "transform", projective);
  give("far", "transform", glm::translate(glm::dmat4(1), {1e20, 0, 0}));
  give("origin", "point", Property::Vector{{1e20, 0, 0}});
  Parameters p = parameters();
  EXPECT_EQ(p.read(TransformParameter{"flat"}), glm::dmat4(1));
  EXPECT_EQ(p.read(TransformParameter{"tiny"})[0][0], 1e-9) << "small is not singular";
  EXPECT_EQ(p.read(TransformParameter{"projective"}), glm::dmat4(1));
  EXPECT_EQ(p.read(TransformParameter{"far"}), glm::dmat4(1));
  EXPECT_EQ(p.read(PointParameter{"origin", {1, 1, 1}}), glm::dvec3(1));
  EXPECT_EQ(complaint(),
            "2: 'flat' cannot be inverted (accepted: scale factors other than 0); "
            "2: 'projective' is not affine (accepted: a matrix whose last row is 0 0 0 1); "
            "2: 'far' has elements that are too large (accepted: elements up to 1e+12); "
            "2: 'origin' is (1e+20, 0, 0) (accepted: coordinates from -1e+12 to 1e+12)");
}

TEST_F(ParametersTest, FilesAreLookedUp) {
  files_.add("dir/a.obj", "");
  files_.add("lib/b.obj", "");
  description_.search_paths = {"lib"};
  give("a", "string", std::string("a.obj"));
  give("b", "string", std::string("b.obj"));
  give("c", "string", std::string("c.obj"));
  Parameters p = parameters();
  EXPECT_EQ(p.read(FileParameter{"a"}), "dir/a.obj");
  EXPECT_EQ(p.read(FileParameter{"b"}), "lib/b.obj");
  EXPECT_EQ(p.read(FileParameter{"c"}), "");
  EXPECT_EQ(p.read(FileParameter{"filename"}), "");
  EXPECT_EQ(complaint(),
            "2: there is no file 'c.obj' (accepted: a file in lib, dir/); "
            "1: bsdf 'diffuse' needs a parameter 'filename' (accepted: <string name=\"filename\" value=\"...\"/>)");
}

// As Mitsuba 3 takes them: beside an included file comes last.
TEST_F(ParametersTest, OfTwoFilesTheOneInTheSearchPathsIsMeant) {
  files_.add("dir/a.obj", "");
  files_.add("lib/a.obj", "");
  description_.search_paths = {"lib"};
  give("a", "string", std::string("a.obj"));
  Parameters p = parameters();
  EXPECT_EQ(p.read(FileParameter{"a"}), "lib/a.obj");
  EXPECT_EQ(complaint(), "2: 'a.obj' is 'lib/a.obj' here, and there is 'dir/a.obj' too");
}

TEST_F(ParametersTest, UnusedParametersAreErrors) {
  give("reflectanse", "rgb", Property::Rgb{});
  give("zzz", "float", 1.0);
  Parameters p = parameters();
  p.read(ColorParameter{.name = "reflectance", .fallback = 0, .range = {0, 1}}).rgb();
  p.read(NumberParameter{"alpha", 0, {0, 1}});
  p.finish();
  EXPECT_EQ(complaint(),
            "3: unused parameter 'reflectanse' of bsdf 'diffuse', did you mean 'reflectance'? "
            "(accepted: alpha, reflectance); "
            "3: unused parameter 'zzz' of bsdf 'diffuse' (accepted: alpha, reflectance)");
}

TEST_F(ParametersTest, UnusedChildrenAreErrors) {
  give_child("texture", "bitmap", "reflectance");
  give_child("bsdf", "diffuse");
  give_child("emitter", "area");
  Parameters p = parameters();
  EXPECT_EQ(p.children("bsdf").size(), 1u);
  p.finish();
  EXPECT_EQ(complaint(),
            "4: unused texture 'bitmap' named 'reflectance' in bsdf 'diffuse' (accepted: bsdf); "
            "4: unused emitter 'area' in bsdf 'diffuse' (accepted: bsdf)");
}

// Nodes with one value: right, and what Mitsuba 3.9's RGB variants make of them where they make anything.
TEST_F(ParametersTest, AtMostOneChild) {
  give_child("bsdf", "diffuse");
  give_child("bsdf", "conductor");
  Parameters p = parameters();
  ASSERT_NE(p.child("bsdf"), nullptr);
  EXPECT_EQ(p.child("emitter"), nullptr);
  EXPECT_EQ(complaint(), "4: bsdf 'diffuse' has more than one bsdf (accepted: one bsdf)");
}

TEST_F(ParametersTest, WhatTheReaderComplainedAboutIsNotComplainedAboutAgain) {
  node_.unreadable = {"filename", "fov"};
  Parameters p = parameters();
  EXPECT_EQ(p.read(FileParameter{"filename"}), "");
  EXPECT_EQ(p.read(NumberParameter{"fov", 45, {0, 180}}), 45);
  EXPECT_TRUE(p.has("fov"));
  p.finish();
  EXPECT_EQ(complaint(), "");
}

TEST_F(ParametersTest, PluginsWithoutParametersSaySo) {
  give("x", "float", 1.0);
  Parameters p = parameters();
  p.finish();
  EXPECT_EQ(complaint(), "3: unused parameter 'x' of bsdf 'diffuse' (accepted: no parameters)");
}

TEST_F(ParametersTest, BoundsThatDoNotBelongToTheRange) {
  give<double>("low", "float", 0);
  give<double>("high", "float", 180);
  give<double>("huge", "float", 1e20);
  give<double>("inside", "float", 180);
  Parameters p = parameters();
  EXPECT_EQ(p.read(NumberParameter{"low", 7, {0, kMaxCoordinate, Ends::open_below}}), 7);
  EXPECT_EQ(p.read(NumberParameter{"high", 7, {0, 180, Ends::open}}), 7);
  EXPECT_EQ(p.read(NumberParameter{"huge", 7, {0, kMaxCoordinate, Ends::open_below}}), 7);
  EXPECT_EQ(p.read(NumberParameter{"inside", 7, {0, 180, Ends::open_below}}), 180);
  EXPECT_EQ(complaint(),
            "2: 'low' is 0 (accepted: a number above 0); 2: 'high' is 180 (accepted: a number above 0 and below 180); "
            "2: 'huge' is 1e+20 (accepted: a number above 0 and at most 1e+12)");
}

TEST_F(ParametersTest, BringsIntoRange) {
  give("weight", "float", 1.2);
  give("share", "rgb", Property::Rgb{{-1, -2, -3}});
  give("far", "float", 1e38);
  give("fine", "float", 0.5);
  Parameters p = parameters();
  EXPECT_EQ(p.read(NumberParameter{.name = "weight", .fallback = 0, .range = {0, 1}, .beyond = Beyond::is_clamped}), 1);
  EXPECT_EQ(p.read(NumberParameter{
                .name = "share", .fallback = 0, .range = {0, 1}, .beyond = Beyond::is_clamped, .takes_colors = true}),
            0);
  EXPECT_EQ(p.read(NumberParameter{
                .name = "far", .fallback = 0, .range = {0, 1e13}, .beyond = Beyond::is_clamped_with_a_note}),
            1e13);
  EXPECT_EQ(p.read(NumberParameter{.name = "fine", .fallback = 0, .range = {0, 1}, .beyond = Beyond::is_clamped}), 0.5);
  EXPECT_EQ(p.read(NumberParameter{.name = "none", .fallback = 7, .range = {0, 1}, .beyond = Beyond::is_clamped}), 7);
  ASSERT_EQ(diagnostics_.all().size(), 3u);
  EXPECT_EQ(diagnostics_.all()[0].severity, Diagnostic::Severity::warning);
  EXPECT_EQ(diagnostics_.all()[0].message, "'weight' is 1.2, which is taken for 1");
  EXPECT_EQ(diagnostics_.all()[1].message, "'share' is -2, which is taken for 0");
  EXPECT_EQ(diagnostics_.all()[2].severity, Diagnostic::Severity::note);
}

/// Spectra find one door: who asks for a spectrum gets what the file says, and rgb alone comes of it there.
TEST_F(ParametersTest, ColoursKeepWhatTheFileSays) {
  const SceneColor::Spectrum samples{{400, 0.1}, {700, 0.9}};
  give("grey", "float", 0.25);
  give("rgb", "rgb", Property::Rgb{{0.1, 0.2, 0.3}});
  give("spectrum", "spectrum", Property::Spectrum{samples});
  Parameters p = parameters();
  EXPECT_EQ(std::get<double>(p.read(ColorParameter{.name = "grey"}).said()), 0.25);
  EXPECT_EQ(std::get<glm::dvec3>(p.read(ColorParameter{.name = "rgb"}).said()), glm::dvec3(0.1, 0.2, 0.3));
  const SceneColor surface = p.read(ColorParameter{.name = "spectrum"});
  const SceneColor light = p.read(ColorParameter{.name = "spectrum", .of = ColorOf::light});
  EXPECT_EQ(std::get<SceneColor::Spectrum>(surface.said()), samples);
  EXPECT_GT(light.rgb().x, surface.rgb().x) << "equal energy is reddish as a light";
  EXPECT_TRUE(SceneColor().is_black());
}

TEST_F(ParametersTest, WhatIsRequiredAndMissingIsTold) {
  Parameters p = parameters();
  EXPECT_EQ(p.read(NumberParameter{.name = "weight", .fallback = 0.5, .example = "<float .../>"}), 0.5);
  EXPECT_EQ(p.read(FileParameter{.name = "filename"}), "");
  p.finish();
  EXPECT_EQ(
      complaint(),
      "1: bsdf 'diffuse' needs a parameter 'weight' (accepted: <float .../>); 1: bsdf 'diffuse' needs a parameter "
      "'filename' (accepted: <string name=\"filename\" value=\"...\"/>)");
}

}  // namespace
}  // namespace norrsken
