// Every plugin of every family's list and every one of its parameters: right, missing, of the wrong type, out of range, not
// finite, unused. The values follow from what plugins() tells of the parameter, by rules; plugin_values.h has the few that
// do not.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "base/text.h"
#include "compile/compile_testing.h"
#include "norrsken/plugins.h"
#include "scene/base_parameters.h"
#include "tests/end_to_end/format_parameters.h"
#include "tests/end_to_end/plugin_rules.h"

namespace norrsken {

void PrintTo(const PluginInfo& plugin, std::ostream* out) { *out << plugin.kind << " " << plugin.name; }

namespace testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::vector<PluginInfo>& all_plugins() {
  static const std::vector<PluginInfo> all = plugins();
  return all;
}

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

class EveryPlugin : public ::testing::TestWithParam<PluginInfo> {
 protected:
  /// What is complained about if these elements are in the plugin, in a scene that is fine without it.
  static std::vector<std::string> errors(const std::string& inside) { return messages(inside, "error: "); }
  static std::vector<std::string> messages(const std::string& inside, std::string_view severity) {
    const PluginInfo& p = GetParam();
    const std::string& kind = p.kind;
    const std::string name = kind == "texture"  ? R"( name="reflectance")"
                             : kind == "volume" ? R"( name="sigma_t")"
                             : kind == "medium" ? R"( name="interior")"
                                                : "";
    std::string node = fmt::format(R"(<{0} type="{1}"{2}>{3}</{0}>)", kind, p.name, name, inside);
    const std::string camera = R"(<sensor type="perspective">)";
    std::string scene = kSensor;
    if (kind == "sensor") scene = p.name == "irradiancemeter" ? "<shape type=\"disk\">" + node + "</shape>" : node;
    if (kind == "film" || kind == "sampler") scene = camera + node + "</sensor>";
    if (kind == "rfilter") scene = camera + R"(<film type="hdrfilm">)" + node + "</film></sensor>";
    scene += kShape + kEmitter;
    if (kind == "integrator" || kind == "emitter") {
      const bool on_a_shape = p.name.ends_with("area");
      scene += on_a_shape ? R"(<shape type="rectangle">)" + node + "</shape>" : node;
    }
    if (kind == "volume" || kind == "phase")
      node = R"(<medium type="heterogeneous" name="interior">)" + node + "</medium>";
    if (kind == "medium" || kind == "phase" || kind == "volume") {
      scene += R"(<integrator type="volpath"/><shape type="sphere"><bsdf type="null"/>)" + node + "</shape>";
    }
    if (kind == "texture") node = R"(<bsdf type="diffuse">)" + node + "</bsdf>";
    if (kind == "texture" || kind == "bsdf") {
      scene += R"(<shape type="ply"><string name="filename" value="knot.ply"/>)" + node + "</shape>";
    }
    if (kind == "shape") {
      const bool is_group = p.name == "shapegroup";
      if (!is_group) scene += R"(<shape type="shapegroup" id="group"><shape type="sphere"/></shape>)";
      scene += node;
    }
    std::vector<std::string> messages = compile_elements(scene, assets()).messages();
    std::erase_if(messages, [&](const std::string& message) { return !message.starts_with(severity); });
    return messages;
  }
  static std::string right(const PluginParameter& parameter) { return right_element(GetParam().name, parameter); }
  /// What is needed and the required parameters but this one.
  static std::string context(std::string_view without) {
    std::string elements;
    for (const Needed& needed : kNeeded) {
      if (needed.kind == GetParam().kind && needed.plugin == GetParam().name) elements = needed.elements;
    }
    for (const PluginParameter& parameter : GetParam().parameters) {
      if (parameter.is_required && parameter.name != without) elements += right(parameter);
      // A slope on one side alone has no meaning.
      const bool is_other_slope = (without == "alpha_u" && parameter.name == "alpha_v") ||
                                  (without == "alpha_v" && parameter.name == "alpha_u");
      // Nor has one of these without the other.
      const bool is_other_half =
          GetParam().name == "radiancemeter" && ((without == "origin" && parameter.name == "direction") ||
                                                 (without == "direction" && parameter.name == "origin"));
      if (is_other_slope || is_other_half) elements += right(parameter);
    }
    return elements;
  }
};

TEST_P(EveryPlugin, TakesWhatIsRightAndCanDoWithoutIt) {
  EXPECT_THAT(errors(context("")), IsEmpty());
  for (const PluginParameter& parameter : GetParam().parameters) {
    SCOPED_TRACE(parameter.name);
    EXPECT_THAT(errors(context(parameter.name) + right(parameter)), IsEmpty());
    if (parameter.may_be_texture && GetParam().kind == "bsdf") {
      EXPECT_THAT(errors(context(parameter.name) + element("texture", parameter.name, "")), IsEmpty());
    }
    if (!parameter.is_required) continue;
    const auto complaints = errors(context(parameter.name));
    ASSERT_THAT(complaints, ::testing::SizeIs(1));
    EXPECT_THAT(complaints[0], ::testing::HasSubstr(fmt::format("{} '{}' needs a parameter '{}'", GetParam().kind,
                                                                GetParam().name, parameter.name)));
  }
}

TEST_P(EveryPlugin, RefusesWrongTypes) {
  for (const PluginParameter& parameter : GetParam().parameters) {
    SCOPED_TRACE(parameter.name);
    const std::string type = parameter.type == Type::transform ? "boolean" : "transform";
    const auto complaints =
        errors(context(parameter.name) + element(type, parameter.name, type == "boolean" ? "true" : ""));
    ASSERT_FALSE(complaints.empty());
    EXPECT_THAT(complaints[0], ::testing::StartsWith(fmt::format("error: '{}' is a {} [", parameter.name, type)));
  }
}

/// Or brings it into the range, and says so.
TEST_P(EveryPlugin, RefusesWhatIsOutOfRange) {
  for (const PluginParameter& parameter : GetParam().parameters) {
    for (const auto& [value, named, accepted, is_clamped] : wrong_values(GetParam().name, parameter)) {
      SCOPED_TRACE(parameter.name + " " + value);
      const std::string inside = context(parameter.name) + element(tag_of(parameter.type), parameter.name, value);
      const auto complaints = messages(inside, "");
      const std::string end = accepted.empty() ? "" : fmt::format("[{}]", accepted);
      const auto is_it = [&](const std::string& message) {
        return message.find(named) != std::string::npos && message.ends_with(end) &&
               (is_clamped ? message.find("taken for") != std::string::npos : message.starts_with("error: "));
      };
      EXPECT_EQ(std::ranges::count_if(complaints, is_it), 1) << ::testing::PrintToString(complaints) << end;
      EXPECT_EQ(errors(inside).size(), is_clamped ? 0u : 1u);
    }
  }
}

TEST_P(EveryPlugin, RefusesWhatIsNotFinite) {
  for (const PluginParameter& parameter : GetParam().parameters) {
    if (parameter.type != Type::number && parameter.type != Type::color && parameter.type != Type::point) continue;
    for (const std::string number : {"nan", "inf", "1e999"}) {
      SCOPED_TRACE(parameter.name + " " + number);
      const std::string value = parameter.type == Type::number ? number : "0.5, " + number + ", 0.5";
      const auto complaints = errors(context(parameter.name) + element(tag_of(parameter.type), parameter.name, value));
      ASSERT_FALSE(complaints.empty());
      EXPECT_THAT(complaints[0], ::testing::HasSubstr(number));
    }
  }
}

/// What is asked for is what is told.
TEST_P(EveryPlugin, NamesItsParametersIfOneIsUnused) {
  std::set<std::string> names;
  for (const PluginParameter& parameter : GetParam().parameters) names.insert(parameter.name);
  const auto complaints = errors(context("") + R"(<float name="zzz" value="1"/>)");
  EXPECT_THAT(complaints,
              ElementsAre(fmt::format("error: unused parameter 'zzz' of {} '{}' [{}]", GetParam().kind, GetParam().name,
                                      names.empty() ? "no parameters" : fmt::format("{}", fmt::join(names, ", ")))));
}

TEST_P(EveryPlugin, IsTold) {
  EXPECT_FALSE(GetParam().text.empty());
  for (const PluginParameter& parameter : GetParam().parameters) {
    EXPECT_TRUE(!parameter.is_required || parameter.fallback.empty()) << parameter.name;
    if (parameter.in_place_of.empty()) continue;
    EXPECT_TRUE(std::ranges::any_of(GetParam().parameters, [&](const PluginParameter& other) {
      return other.name == parameter.in_place_of;
    })) << parameter.name;
  }
}

TEST(Plugins, TellRangesDefaultsAndUnits) {
  const auto& all = all_plugins();
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
  EXPECT_EQ(fov.in_place_of, "focal_length");
  EXPECT_TRUE(fov.fallback.empty());
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

std::set<std::string> names_of_format(const PluginInfo& plugin) {
  std::set<std::string> names;
  for (const FormatPlugin& of_format : kFormat) {
    if (of_format.kind != plugin.kind || of_format.name != plugin.name) continue;
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

/// Every name of the format is one that the plugin has, or one of the base classes' that have no effect: which is told.
TEST_P(EveryPlugin, TakesWhateverTheFormatDoes) {
  std::set<std::string> rows;
  for (const PluginParameter& parameter : GetParam().parameters) rows.insert(parameter.name);
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
#define NORRSKEN_METER(kind, Model) listed.insert("sensor " #kind);
#define NORRSKEN_SENSOR_ADAPTER(kind) listed.insert("sensor " #kind);
#define NORRSKEN_FILM(name) listed.insert("film " #name);
#define NORRSKEN_SAMPLER(name) listed.insert("sampler " #name);
#define NORRSKEN_RFILTER(name) listed.insert("rfilter " #name);
#define NORRSKEN_INTEGRATOR(name) listed.insert("integrator " #name);
#define NORRSKEN_MEDIUM(name) listed.insert("medium " #name);
#define NORRSKEN_PHASE(kind, Model) listed.insert("phase " #kind);
#define NORRSKEN_PHASE_ADAPTER(name) listed.insert("phase " #name);
#define NORRSKEN_VOLUME(name) listed.insert("volume " #name);
#include "lists/bsdf.def"
#include "lists/bsdf_adapter.def"
#include "lists/bsdf_resolved.def"
#include "lists/camera.def"
#include "lists/emitter.def"
#include "lists/film.def"
#include "lists/integrator.def"
#include "lists/medium.def"
#include "lists/meter.def"
#include "lists/phase.def"
#include "lists/phase_adapter.def"
#include "lists/rfilter.def"
#include "lists/sampler.def"
#include "lists/sensor_adapter.def"
#include "lists/shape.def"
#include "lists/texture.def"
#include "lists/volume.def"
  return listed;
}

INSTANTIATE_TEST_SUITE_P(, EveryPlugin, ::testing::ValuesIn(plugins()),
                         [](const auto& test) { return test.param.kind + "_" + test.param.name; });

TEST(Plugins, AreThoseOfTheLists) {
  std::set<std::string> told;
  for (const PluginInfo& plugin : all_plugins()) told.insert(plugin.kind + " " + plugin.name);
  EXPECT_EQ(told, plugins_of_the_lists());
}

}  // namespace
}  // namespace testing
}  // namespace norrsken
