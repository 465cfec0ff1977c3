// Every plugin of every family's list and every one of its parameters: right, missing, of the wrong type, out of range,
// unused. A plugin or a parameter that is not in the table fails the test.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "base/text.h"
#include "compile/compile_testing.h"
#include "norrsken/plugins.h"
#include "scene/base_parameters.h"
#include "tests/end_to_end/format_parameters.h"
#include "tests/end_to_end/plugin_parameters.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string element(const std::string& type, const std::string& name, const std::string& value) {
  if (type == "transform") return fmt::format(R"(<transform name="{}">{}</transform>)", name, value);
  if (type == "checkerboard") return fmt::format(R"(<texture name="{}" type="checkerboard"/>)", name);
  return fmt::format(R"(<{} name="{}" value="{}"/>)", type, name, value);
}
std::string right(const Row& row) { return element(row.type, row.name, row.right); }

const Files& assets() {
  static const Files files = [] {
    Files read;
    for (const char* name : {"card.png", "relief.png", "star.obj", "knot.ply", "gear.serialized", "rings.vol",
                             "sky.exr", "grass.txt", "tendrils.txt"}) {
      std::ostringstream bytes;
      bytes << std::ifstream(std::string(NORRSKEN_TEST_ASSETS "/") + name, std::ios::binary).rdbuf();
      read[name] = bytes.str();
    }
    return read;
  }();
  return files;
}

class EveryPlugin : public ::testing::TestWithParam<Plugin> {
 protected:
  /// What is complained about if these elements are in the plugin, in a scene that is fine without it.
  static std::vector<std::string> errors(const std::string& inside) { return messages(inside, "error: "); }
  static std::vector<std::string> messages(const std::string& inside, std::string_view severity) {
    const Plugin& p = GetParam();
    const std::string kind = p.kind;
    std::string node = fmt::format(R"(<{0} type="{1}"{2}>{3}</{0}>)", kind, p.name,
                                   kind == "texture" ? R"( name="reflectance")" : "", inside);
    const std::string camera = R"(<sensor type="perspective">)";
    std::string scene = kSensor;
    if (kind == "sensor") scene = node;
    if (kind == "film" || kind == "sampler") scene = camera + node + "</sensor>";
    if (kind == "rfilter") scene = camera + R"(<film type="hdrfilm">)" + node + "</film></sensor>";
    scene += kShape + kEmitter;
    if (kind == "integrator" || kind == "emitter") {
      const bool on_a_shape = std::string(p.name).ends_with("area");
      scene += on_a_shape ? R"(<shape type="rectangle">)" + node + "</shape>" : node;
    }
    if (kind == "texture") node = R"(<bsdf type="diffuse">)" + node + "</bsdf>";
    if (kind == "texture" || kind == "bsdf") {
      scene += R"(<shape type="ply"><string name="filename" value="knot.ply"/>)" + node + "</shape>";
    }
    if (kind == "shape") {
      const bool is_group = p.name == std::string("shapegroup");
      if (!is_group) scene += R"(<shape type="shapegroup" id="group"><shape type="sphere"/></shape>)";
      scene += node;
    }
    std::vector<std::string> messages = compile_elements(scene, assets()).messages();
    std::erase_if(messages, [&](const std::string& message) { return !message.starts_with(severity); });
    return messages;
  }
  /// `needed` and the required parameters but this one.
  static std::string context(std::string_view without) {
    std::string elements = GetParam().needed;
    for (const Row& row : GetParam().rows) {
      const auto& required = GetParam().required;
      const bool is_required = std::ranges::find(required, std::string_view(row.name)) != required.end();
      if (is_required && row.name != without) elements += right(row);
    }
    // A slope on one side alone has no meaning.
    if (without == "alpha_u") elements += element("float", "alpha_v", "0.3");
    if (without == "alpha_v") elements += element("float", "alpha_u", "0.3");
    return elements;
  }
};

TEST_P(EveryPlugin, TakesWhatIsRightAndCanDoWithoutIt) {
  EXPECT_THAT(errors(context("")), IsEmpty());
  for (const Row& row : GetParam().rows) {
    SCOPED_TRACE(row.name);
    EXPECT_THAT(errors(context(row.name) + right(row)), IsEmpty());
  }
  for (const char* name : GetParam().required) {
    const auto complaints = errors(context(name));
    ASSERT_THAT(complaints, ::testing::SizeIs(1)) << name;
    EXPECT_THAT(complaints[0], ::testing::HasSubstr(fmt::format("{} '{}' ", GetParam().kind, GetParam().name)));
  }
}

TEST_P(EveryPlugin, RefusesWrongTypes) {
  for (const Row& row : GetParam().rows) {
    SCOPED_TRACE(row.name);
    const std::string type = row.type == std::string("transform") ? "boolean" : "transform";
    const auto complaints = errors(context(row.name) + element(type, row.name, type == "boolean" ? "true" : ""));
    ASSERT_FALSE(complaints.empty());
    EXPECT_THAT(complaints[0], ::testing::StartsWith(fmt::format("error: '{}' is a {} [", row.name, type)));
  }
}

TEST_P(EveryPlugin, RefusesWhatIsOutOfRange) {
  for (const Row& row : GetParam().rows) {
    if (row.wrong[0] == 0) continue;
    SCOPED_TRACE(row.name);
    const auto complaints = errors(context(row.name) + element(row.type, row.name, row.wrong));
    ASSERT_THAT(complaints, ::testing::SizeIs(1));
    EXPECT_THAT(complaints[0], ::testing::HasSubstr(row.type == std::string("transform") ? row.name : row.wrong));
    const std::string end = row.accepted[0] != 0 ? fmt::format("[{}]", row.accepted) : "";
    EXPECT_THAT(complaints[0], ::testing::EndsWith(end));
  }
}

/// The list of what is accepted is that of the table, so the table has every parameter.
TEST_P(EveryPlugin, NamesItsParametersIfOneIsUnused) {
  std::set<std::string> names;
  for (const Row& row : GetParam().rows) names.insert(row.name);
  // Read where the other one of a pair is not given.
  std::string accepted;
  for (const std::string& name : names) accepted += (accepted.empty() ? "" : ", ") + name;
  const auto complaints = errors(context("") + R"(<float name="zzz" value="1"/>)");
  EXPECT_THAT(complaints, ElementsAre(fmt::format("error: unused parameter 'zzz' of {} '{}' [{}]", GetParam().kind,
                                                  GetParam().name, accepted.empty() ? "no parameters" : accepted)));
}

/// Whether a value of the type that a scene file writes may be that of the parameter.
bool takes(const PluginParameter& parameter, std::string_view type) {
  using Type = PluginParameter::Type;
  if (type == "checkerboard") return parameter.may_be_texture;
  switch (parameter.type) {
    case Type::boolean:
      return type == "boolean";
    case Type::integer:
      return type == "integer";
    case Type::number:
      return type == "float";
    case Type::color:
      return type == "rgb" || type == "float";
    case Type::spectrum:
      return type == "spectrum";
    case Type::point:
      return type == "point" || type == "vector";
    case Type::transform:
      return type == "transform";
    case Type::texture:
      return false;
    default:
      return type == "string";
  }
}

/// What plugins() tells is what the readers take: all of it, and nothing else.
TEST_P(EveryPlugin, IsToldWithItsParameters) {
  static const std::vector<PluginInfo> all = plugins();
  const auto told = std::ranges::find_if(
      all, [](const PluginInfo& plugin) { return plugin.kind == GetParam().kind && plugin.name == GetParam().name; });
  ASSERT_NE(told, all.end());
  EXPECT_FALSE(told->text.empty());
  EXPECT_EQ(told->parameters.size(), GetParam().rows.size());
  for (const Row& row : GetParam().rows) {
    const auto parameter = std::ranges::find(told->parameters, row.name, &PluginParameter::name);
    ASSERT_NE(parameter, told->parameters.end()) << row.name;
    EXPECT_TRUE(takes(*parameter, row.type)) << row.name << " " << row.type;
  }
  for (const PluginParameter& parameter : told->parameters) {
    EXPECT_FALSE(parameter.text.empty()) << parameter.name;
    const auto& required = GetParam().required;
    const bool is_required = std::ranges::find(required, std::string_view(parameter.name)) != required.end();
    EXPECT_EQ(parameter.is_required, is_required) << parameter.name;
    EXPECT_TRUE(!parameter.is_required || parameter.fallback.empty()) << parameter.name;
  }
}

TEST(Plugins, TellRangesDefaultsAndUnits) {
  const auto all = plugins();
  const auto find = [&](const char* kind, const char* name, const char* parameter) {
    const auto plugin = std::ranges::find_if(all, [&](const auto& p) { return p.kind == kind && p.name == name; });
    return *std::ranges::find(plugin->parameters, parameter, &PluginParameter::name);
  };
  const PluginParameter fov = find("sensor", "perspective", "fov");
  EXPECT_EQ(fov.type, PluginParameter::Type::number);
  EXPECT_EQ(fov.min, 0.0);
  EXPECT_EQ(fov.max, 180.0);
  EXPECT_FALSE(fov.min_belongs);
  EXPECT_FALSE(fov.max_belongs);
  EXPECT_EQ(fov.unit, "degrees");
  const PluginParameter reflectance = find("bsdf", "diffuse", "reflectance");
  EXPECT_EQ(reflectance.type, PluginParameter::Type::color);
  EXPECT_EQ(reflectance.fallback, "0.5");
  EXPECT_TRUE(reflectance.may_be_texture);
  EXPECT_EQ(reflectance.max, 1.0);
  EXPECT_THAT(find("sensor", "perspective", "fov_axis").choices,
              ElementsAre("x", "y", "diagonal", "smaller", "larger"));
  EXPECT_EQ(find("film", "hdrfilm", "width").fallback, "768");
  EXPECT_EQ(find("shape", "sphere", "center").fallback, "0, 0, 0");
  EXPECT_TRUE(find("shape", "ply", "filename").is_required);
  EXPECT_FALSE(find("sampler", "independent", "seed").max.has_value());
}

std::set<std::string> names_of_format(const Plugin& plugin) {
  std::set<std::string> names;
  for (const FormatPlugin& of_format : kFormat) {
    if (of_format.kind != std::string_view(plugin.kind) || of_format.name != std::string_view(plugin.name)) continue;
    for (const TextPiece& piece : split(of_format.parameters, " ")) names.emplace(piece.text);
  }
  return names;
}

std::string element_of(const BaseParameter& parameter) {
  switch (parameter.type) {
    case BaseParameter::Type::boolean:
      return element("boolean", std::string(parameter.name), "true");
    case BaseParameter::Type::integer:
      return element("integer", std::string(parameter.name), "16");
    case BaseParameter::Type::number:
      return element("float", std::string(parameter.name), "2");
    default:
      return element("transform", std::string(parameter.name), R"(<rotate z="1" angle="90"/>)");
  }
}

/// Every name of the format is one of the table's, or one of the base classes' that have no effect: which is told.
TEST_P(EveryPlugin, TakesWhateverTheFormatDoes) {
  std::set<std::string> rows;
  for (const Row& row : GetParam().rows) rows.insert(row.name);
  for (const std::string& name : names_of_format(GetParam())) {
    SCOPED_TRACE(name);
    if (rows.contains(name)) continue;
    const BaseParameter* base = find_base_parameter(GetParam().kind, GetParam().name, name);
    ASSERT_NE(base, nullptr);
    EXPECT_THAT(errors(context("") + element_of(*base)), IsEmpty());
    EXPECT_THAT(messages(context("") + element_of(*base), "note: "),
                ::testing::Contains(::testing::StartsWith(fmt::format("note: '{}' of ", name))));
    EXPECT_THAT(errors(context("") + element("string", name, "wrong")), ::testing::SizeIs(1));
  }
}

/// A name that the format does not know is somebody's error.
TEST(BaseParameters, AreTheFormats) {
  for (const BaseParameter& row : base_parameters()) {
    if (row.kind == "scene") continue;  // it is no plugin: see ScenesHaveSomeToo
    const auto has = [&](const FormatPlugin& plugin) {
      if (plugin.kind != row.kind || (!row.plugin.empty() && plugin.name != row.plugin)) return false;
      const auto names = split(plugin.parameters, " ");
      return std::ranges::any_of(names, [&](const TextPiece& piece) { return piece.text == row.name; });
    };
    EXPECT_TRUE(std::ranges::any_of(kFormat, has)) << row.kind << " " << row.name;
  }
}

TEST(BaseParameters, ScenesHaveSomeToo) {
  for (const char* name : {"allow_thread_reordering", "embree_use_robust_intersections"}) {
    const auto messages =
        compile_elements(R"(<sensor type="perspective"/><emitter type="constant"/><shape type="sphere"/>)" +
                         element("boolean", name, "true"))
            .messages();
    EXPECT_THAT(messages, ElementsAre(::testing::StartsWith(fmt::format("note: '{}' of a scene has no effect", name))));
  }
}

/// "bsdf diffuse", "bsdf conductor", ...
std::set<std::string> plugins_of_the_lists() {
  std::set<std::string> listed;
#define NORRSKEN_BSDF(kind, Model) listed.insert("bsdf " #kind);
#define NORRSKEN_BSDF_RESOLVED(name, Adapter) listed.insert("bsdf " #name);
#define NORRSKEN_BSDF_ADAPTER(name) listed.insert("bsdf " #name);
#define NORRSKEN_TEXTURE(kind, Model) listed.insert("texture " #kind);
#define NORRSKEN_SHAPE(name) listed.insert("shape " #name);
#define NORRSKEN_EMITTER(name) listed.insert("emitter " #name);
#define NORRSKEN_CAMERA(kind, Model) listed.insert("sensor " #kind);
#define NORRSKEN_FILM(name) listed.insert("film " #name);
#define NORRSKEN_SAMPLER(name) listed.insert("sampler " #name);
#define NORRSKEN_RFILTER(name) listed.insert("rfilter " #name);
#define NORRSKEN_INTEGRATOR(name) listed.insert("integrator " #name);
#include "lists/bsdf.def"
#include "lists/bsdf_adapter.def"
#include "lists/bsdf_resolved.def"
#include "lists/camera.def"
#include "lists/emitter.def"
#include "lists/film.def"
#include "lists/integrator.def"
#include "lists/rfilter.def"
#include "lists/sampler.def"
#include "lists/shape.def"
#include "lists/texture.def"
  return listed;
}

/// Those of the table that a build has.
std::vector<Plugin> tested_plugins() {
  const auto listed = plugins_of_the_lists();
  std::vector<Plugin> tested(std::begin(kPlugins), std::end(kPlugins));
  std::erase_if(tested, [&](const Plugin& p) { return !listed.contains(std::string(p.kind) + " " + p.name); });
  return tested;
}

INSTANTIATE_TEST_SUITE_P(, EveryPlugin, ::testing::ValuesIn(tested_plugins()),
                         [](const auto& test) { return std::string(test.param.kind) + "_" + test.param.name; });

TEST(PluginTable, HasEveryPluginOfTheLists) {
  std::set<std::string> tested;
  for (const Plugin& plugin : tested_plugins()) tested.insert(std::string(plugin.kind) + " " + plugin.name);
  EXPECT_EQ(tested, plugins_of_the_lists());
}

}  // namespace
}  // namespace norrsken::testing
