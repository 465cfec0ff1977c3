#include "scene/parameters.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <tuple>

#include "scene/memory_files.h"

namespace norrsken {

std::vector<std::pair<std::string_view, std::string_view>> builtin_files() { return {}; }

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class ParametersTest : public testing::Test {
 protected:
  ParametersTest() {
    node_.kind = "bsdf";
    node_.plugin = "diffuse";
    node_.location = {"room.xml", 1, 1, 5, "<bsdf ...>"};
  }

  template <typename Value>
  void give(std::string name, std::string type, Value value) {
    node_.properties.push_back(property(std::move(name), std::move(type), std::move(value)));
  }
  template <typename Value>
  static Property property(std::string name, std::string type, Value value) {
    Property property;
    property.location = {"dir/room.xml", 2, 3, 1, "  X"};
    property.name_location = {"dir/room.xml", 3, 3, 1, "  N"};
    property.name = std::move(name);
    property.type = std::move(type);
    if constexpr (std::is_same_v<Value, glm::dmat4>) {
      property.value = to_transform(value);
    } else {
      property.value = std::move(value);
    }
    return property;
  }
  void give_child(std::string kind, std::string plugin, std::string name = {}, std::vector<Property> properties = {}) {
    auto child = std::make_shared<Node>();
    child->properties = std::move(properties);
    child->location = {"dir/room.xml", 5, 3, 1, "  C"};
    child->kind = std::move(kind);
    child->plugin = std::move(plugin);
    node_.children.push_back({std::move(name), child, {"dir/room.xml", 4, 3, 1, "  C"}});
  }
  Parameters parameters() { return Parameters(node_, description_, files_, diagnostics_); }

  // The message and what is accepted of the only complaint, or all of them.
  std::string complaint() const {
    std::string text;
    for (const Diagnostic& d : diagnostics_.all()) {
      text += (text.empty() ? "" : "; ") + std::to_string(d.location.line) + ": " + d.message;
      if (!d.accepted.empty()) text += " (accepted: " + d.accepted + ")";
    }
    return text;
  }

  Node node_;
  Description description_;
  MemoryFiles files_;
  Diagnostics diagnostics_;
};

TEST_F(ParametersTest, ReadsEveryType) {
  give("b", "boolean", true);
  give("i", "integer", std::int64_t{7});
  give("f", "float", 2.5);
  give("s", "string", std::string("word"));
  give("c", "rgb", Property::Rgb{{0.1, 0.2, 0.3}});
  give("p", "point", Property::Vector{{1, 2, 3}});
  give("t", "transform", glm::translate(glm::dmat4(1), {1, 2, 3}));
  Parameters p = parameters();
  EXPECT_TRUE(p.boolean("b", false));
  EXPECT_EQ(p.integer("i", 0, 0, 10), 7);
  EXPECT_EQ(p.number("f", 0, 0, 10), 2.5);
  EXPECT_EQ(p.number("i", 0, 0, 10), 7) << "an integer will do as a number";
  EXPECT_EQ(p.text("s", ""), "word");
  EXPECT_EQ(p.choice("s", "other", {"other", "word"}), "word");
  EXPECT_EQ(p.color("c", {}, 0, 1), glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(p.color("f", {}, 0, 5), glm::dvec3(2.5)) << "a float is grey";
  EXPECT_EQ(p.point("p", {}), glm::dvec3(1, 2, 3));
  EXPECT_EQ(p.transform("t")[3], glm::dvec4(1, 2, 3, 1));
  p.finish();
  EXPECT_EQ(complaint(), "");
}

TEST_F(ParametersTest, WhatIsNotGivenIsTheFallback) {
  Parameters p = parameters();
  EXPECT_TRUE(p.boolean("x", true));
  EXPECT_EQ(p.integer("x", 5, 0, 10), 5);
  EXPECT_EQ(p.number("x", 0.5, 0, 10), 0.5);
  EXPECT_EQ(p.text("x", "t"), "t");
  EXPECT_EQ(p.choice("x", "a", {"a", "b"}), "a");
  EXPECT_EQ(p.color("x", {1, 2, 3}, 0, 1), glm::dvec3(1, 2, 3));
  EXPECT_EQ(p.point("x", {1, 2, 3}), glm::dvec3(1, 2, 3));
  EXPECT_EQ(p.transform("x"), glm::dmat4(1));
  EXPECT_FALSE(p.has("x"));
  p.finish();
  EXPECT_EQ(complaint(), "");
}

TEST_F(ParametersTest, WrongTypes) {
  give("fov", "string", std::string("abc"));
  give("spp", "float", 4.0);
  give("on", "rgb", Property::Rgb{});
  Parameters p = parameters();
  EXPECT_EQ(p.number("fov", 45, 0, 180), 45);
  EXPECT_EQ(p.integer("spp", 4, 1, 100), 4);
  EXPECT_FALSE(p.boolean("on", false));
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
  EXPECT_EQ(p.number("fov", 45, 0, 180), 45);
  EXPECT_EQ(p.integer("spp", 4, 1, std::numeric_limits<std::int64_t>::max()), 4);
  EXPECT_EQ(p.number("radius", 1, 0, kInfinity), 1);
  EXPECT_EQ(p.number("huge", 1, -kInfinity, kInfinity), 1);
  EXPECT_EQ(complaint(),
            "2: 'fov' is 270 (accepted: a number from 0 to 180); 2: 'spp' is 0 (accepted: an integer of at least 1); "
            "2: 'radius' is -1 (accepted: a number of at least 0); 2: 'huge' is 1e+300 (accepted: a number of at most "
            "1e+30)");
}

TEST_F(ParametersTest, ChoicesAreListed) {
  give("axis", "string", std::string("hieght"));
  give("mode", "integer", std::int64_t{1});
  Parameters p = parameters();
  EXPECT_EQ(p.choice("axis", "width", {"width", "height"}), "width");
  EXPECT_EQ(p.choice("mode", "a", {"a", "b"}), "a");
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
  EXPECT_EQ(p.color("bright", glm::dvec3(0.1), 0, 1), glm::dvec3(0.1));
  EXPECT_EQ(p.color("negative", glm::dvec3(0.1), 0, 1), glm::dvec3(0.1));
  EXPECT_EQ(p.color("grey", {}, 0, 1), glm::dvec3(0.25));
  EXPECT_NEAR(p.color("grey", {}, 0, 1, true).x, 0.25 * 1.2048, 1e-3) << "equal energy is reddish as a light";
  EXPECT_EQ(p.color("saturated", glm::dvec3(1), 0, 1).x, 0) << "out of gamut: clamped, no complaint";
  EXPECT_NEAR(p.color("flat", {}, 0, 2).x, 1, 1e-9);
  EXPECT_GT(p.color("flat", {}, 0, 2, true).x, 1.1) << "equal energy is reddish as a light";
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
  EXPECT_EQ(p.transform("flat"), glm::dmat4(1));
  EXPECT_EQ(p.transform("tiny")[0][0], 1e-9) << "small is not singular";
  EXPECT_EQ(p.transform("projective"), glm::dmat4(1));
  EXPECT_EQ(p.transform("far"), glm::dmat4(1));
  EXPECT_EQ(p.point("origin", {1, 1, 1}), glm::dvec3(1));
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
  EXPECT_EQ(p.file("a"), "dir/a.obj");
  EXPECT_EQ(p.file("b"), "lib/b.obj");
  EXPECT_EQ(p.file("c"), "");
  EXPECT_EQ(p.file("filename"), "");
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
  EXPECT_EQ(p.file("a"), "lib/a.obj");
  EXPECT_EQ(complaint(), "2: 'a.obj' is 'lib/a.obj' here, and there is 'dir/a.obj' too");
}

TEST_F(ParametersTest, UnusedParametersAreErrors) {
  give("reflectanse", "rgb", Property::Rgb{});
  give("zzz", "float", 1.0);
  Parameters p = parameters();
  p.color("reflectance", {}, 0, 1);
  p.number("alpha", 0, 0, 1);
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
TEST_F(ParametersTest, NodesOfOneValueAreColours) {
  using Samples = std::vector<std::pair<double, double>>;
  const Samples pairs{{400, 0.1}, {500, 0.9}, {600, 0.5}, {700, 0.2}};
  const auto color = [this](std::string plugin, std::vector<Property> properties, bool emission = false) {
    node_.children.clear();
    give_child("spectrum", std::move(plugin), "radiance", std::move(properties));
    Parameters p = parameters();
    const glm::dvec3 result = p.color("radiance", glm::dvec3(-1), 0, 1e6, emission);
    p.finish();
    return result;
  };
  const auto near = [](glm::dvec3 a, glm::dvec3 b, double tolerance = 1e-12) {
    return glm::all(glm::lessThanEqual(glm::abs(a - b), glm::dvec3(tolerance) * b));
  };
  const Property rgb = property("color", "rgb", Property::Rgb{{0.1, 0.2, 0.4}});
  EXPECT_TRUE(near(color("uniform", {property("value", "float", 0.7)}), glm::dvec3(0.7)));
  EXPECT_TRUE(near(color("uniform", {property("value", "float", 0.7)}, true), glm::dvec3(0.7)));
  EXPECT_TRUE(near(color("d65", {}), glm::dvec3(1)));
  EXPECT_TRUE(near(color("d65", {rgb, property("scale", "float", 3.0)}, true), {0.3, 0.6, 1.2}));
  EXPECT_TRUE(near(color("srgb", {rgb}), {0.1, 0.2, 0.4}));
  EXPECT_TRUE(near(color("rawconstant", {property("value", "vector", Property::Vector{{1, 2, 4}})}), {1, 2, 4}));
  EXPECT_TRUE(near(color("rawconstant", {property("value", "float", 0.5)}), glm::dvec3(0.5)));
  const glm::dvec3 reflectance(0.315818, 0.772604, 0.511516), emission(0.419126, 0.7336, 0.451901);
  const std::vector<Property> regular{property("wavelength_min", "float", 400.0),
                                      property("wavelength_max", "float", 700.0),
                                      property("values", "string", std::string("0.1, 0.9, 0.5, 0.2"))};
  const std::vector<Property> irregular{property("wavelengths", "string", std::string("400 500 600 700")),
                                        property("values", "string", std::string("0.1, 0.9, 0.5, 0.2"))};
  const std::vector<Property> spelled_out{property("value", "spectrum", Property::Spectrum{pairs})};
  EXPECT_TRUE(near(color("regular", regular), reflectance, 2e-3));
  EXPECT_TRUE(near(color("regular", regular, true), emission, 2e-3));
  EXPECT_TRUE(near(color("regular", spelled_out, true), emission, 2e-3));
  EXPECT_TRUE(near(color("irregular", irregular), reflectance, 2e-3));
  EXPECT_TRUE(near(color("irregular", spelled_out), reflectance, 2e-3));
  EXPECT_TRUE(near(color("blackbody", {property("temperature", "float", 3000.0)}, true), {733.5, 350, 112.8}, 5e-3));
  EXPECT_EQ(complaint(), "");
}

TEST_F(ParametersTest, NodesOfOneValueAreNumbers) {
  give_child("texture", "rawconstant", "alpha", {property("value", "vector", Property::Vector{{0.2, 0.3, 0.7}})});
  give_child("spectrum", "uniform", "beta", {property("value", "float", 2.0)});
  Parameters p = parameters();
  EXPECT_NEAR(p.number("alpha", 0, 0, 1), 0.4, 1e-12);
  EXPECT_EQ(p.number("beta", 0.5, 0, 1), 0.5);
  p.finish();
  EXPECT_EQ(complaint(), "4: 'beta' is 2 (accepted: a number from 0 to 1)");
}

TEST_F(ParametersTest, NodesOfOneValueAreChecked) {
  const auto text = [](const char* name, const char* value) { return property(name, "string", std::string(value)); };
  const std::vector<std::tuple<std::string, std::vector<Property>, std::string>> cases = {
      {"uniform",
       {},
       "5: spectrum 'uniform' needs a parameter 'value' (accepted: <float name=\"value\" value=\"0.5\"/>)"},
      {"uniform", {property("value", "float", 3.0)}, "4: 'x' is (3, 3, 3) (accepted: components from 0 to 1)"},
      {"uniform",
       {property("value", "float", 0.5), property("scale", "float", 1.0)},
       "3: unused parameter 'scale' of spectrum 'uniform' (accepted: value, wavelength_max, wavelength_min)"},
      {"srgb",
       {},
       "5: spectrum 'srgb' needs a parameter 'color' (accepted: <rgb name=\"color\" value=\"0.5 0.5 0.5\"/>)"},
      {"d65", {text("scale", "2")}, "2: 'scale' is a string (accepted: float)"},
      {"blackbody", {property("temperature", "float", 0.0)}, "2: 'temperature' is 0 (accepted: a number above 0)"},
      {"rawconstant", {text("value", "1")}, "2: 'value' is a string (accepted: rgb, spectrum, float)"},
      {"irregular",
       {text("wavelengths", "400, 500"), text("values", "1, 2, 3")},
       "2: 2 wavelengths and 3 values (accepted: as many values as wavelengths)"},
      {"irregular",
       {text("wavelengths", "400, 400"), text("values", "1, 2")},
       "2: 400 is not above the wavelength before it (accepted: wavelengths in nm, ascending)"},
      {"irregular",
       {text("wavelengths", "400, x"), text("values", "1, 2")},
       "2: 'x' in 'wavelengths' is not a number (accepted: a string of numbers)"},
      {"irregular",
       {property("value", "spectrum", Property::Spectrum{{{0, 0.5}}})},
       "2: 'value' is a single value (accepted: a spectrum of wavelength:value pairs)"},
      {"regular",
       {property("wavelength_min", "float", 500.0), property("wavelength_max", "float", 400.0), text("values", "1")},
       "2: 'wavelength_max' is 400 (accepted: a number above 500); 2: 'values' is one number (accepted: two numbers or "
       "more)"},
      {"regular",
       {property("wavelength_min", "float", 500.0), property("wavelength_max", "float", 600.0), text("values", " ")},
       "2: 'values' is empty (accepted: a string of numbers)"},
  };
  for (const auto& [plugin, properties, expected] : cases) {
    node_.children.clear();
    diagnostics_ = Diagnostics();
    give_child("spectrum", plugin, "x", properties);
    Parameters p = parameters();
    p.color("x", glm::dvec3(0.5), 0, 1);
    p.finish();
    EXPECT_EQ(complaint(), expected);
  }
}

TEST_F(ParametersTest, TexturesAreToldFromNodesOfOneValue) {
  give_child("texture", "bitmap", "reflectance");
  give_child("texture", "rawconstant", "alpha");
  give_child("bsdf", "diffuse", "inside");
  Parameters p = parameters();
  ASSERT_NE(p.texture("reflectance"), nullptr);
  EXPECT_EQ(p.texture("reflectance")->node->plugin, "bitmap");
  EXPECT_EQ(p.texture("alpha"), nullptr);
  EXPECT_EQ(p.texture("inside"), nullptr);
  EXPECT_EQ(p.texture("none"), nullptr);
  p.finish();
  EXPECT_EQ(complaint(),
            "4: unused texture 'rawconstant' named 'alpha' in bsdf 'diffuse' (accepted: the names reflectance); "
            "4: unused bsdf 'diffuse' named 'inside' in bsdf 'diffuse' (accepted: the names reflectance)");
}

TEST_F(ParametersTest, AChildInPlaceOfAValueIsNamedOnce) {
  give_child("texture", "bitmap", "reflectance");
  Parameters p = parameters();
  p.color("reflectance", {}, 0, 1);
  p.finish();
  EXPECT_EQ(complaint(), "4: 'reflectance' is a texture here (accepted: rgb, spectrum, float)");
}

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
  EXPECT_EQ(p.file("filename"), "");
  EXPECT_EQ(p.number("fov", 45, 0, 180), 45);
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
  EXPECT_EQ(p.number("low", 7, 0, kMaxCoordinate, Ends::open_below), 7);
  EXPECT_EQ(p.number("high", 7, 0, 180, Ends::open), 7);
  EXPECT_EQ(p.number("huge", 7, 0, kMaxCoordinate, Ends::open_below), 7);
  EXPECT_EQ(p.number("inside", 7, 0, 180, Ends::open_below), 180);
  EXPECT_EQ(complaint(),
            "2: 'low' is 0 (accepted: a number above 0); 2: 'high' is 180 (accepted: a number above 0 and below 180); "
            "2: 'huge' is 1e+20 (accepted: a number above 0 and at most 1e+12)");
}

}  // namespace
}  // namespace norrsken
