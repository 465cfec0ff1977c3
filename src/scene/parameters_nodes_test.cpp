// Parameters that are nodes: of one value, textures, and what is neither.
#include "scene/parameters_testing.h"

#include <glm/vector_relational.hpp>

namespace norrsken {
namespace {

TEST_F(ParametersTest, NodesOfOneValueAreColours) {
  using Samples = std::vector<std::pair<double, double>>;
  const Samples pairs{{400, 0.1}, {500, 0.9}, {600, 0.5}, {700, 0.2}};
  const auto color = [this](std::string plugin, std::vector<Property> properties, bool emission = false) {
    node_.children.clear();
    give_child("spectrum", std::move(plugin), "radiance", std::move(properties));
    Parameters p = parameters();
    const glm::dvec3 result = p.read(ColorParameter{.name = "radiance",
                                                    .fallback = -1,
                                                    .range = {0, 1e6},
                                                    .of = emission ? ColorOf::light : ColorOf::surface})
                                  .rgb();
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
  EXPECT_TRUE(near(color("rgb", {property("value", "rgb", Property::Rgb{{0.1, 0.2, 0.4}})}), {0.1, 0.2, 0.4}));
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
  EXPECT_NEAR(p.read(NumberParameter{"alpha", 0, {0, 1}}), 0.4, 1e-12);
  EXPECT_EQ(p.read(NumberParameter{"beta", 0.5, {0, 1}}), 0.5);
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
    p.read(ColorParameter{.name = "x", .fallback = 0.5, .range = {0, 1}}).rgb();
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
  p.read(ColorParameter{.name = "reflectance", .fallback = 0, .range = {0, 1}}).rgb();
  p.finish();
  EXPECT_EQ(complaint(), "4: 'reflectance' is a texture here (accepted: rgb, spectrum, float)");
}

}  // namespace
}  // namespace norrsken
