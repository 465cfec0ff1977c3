#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string integrator(const std::string& type, const std::string& inside) {
  return "<integrator type=\"" + type + "\">" + inside + "</integrator>";
}
std::string integer(const std::string& name, const std::string& value) {
  return "<integer name=\"" + name + "\" value=\"" + value + "\"/>";
}

TEST(IntegratorHost, TakeTheirParameters) {
  for (const std::string type : {"path", "whitted"}) {
    const Compiled c = compile_integrator(integrator(type, integer("max_depth", "7") + integer("rr_depth", "3") +
                                                               integer("emitter_samples", "20") +
                                                               R"(<boolean name="hide_emitters" value="true"/>)"));
    ASSERT_THAT(c.messages(), IsEmpty());
    const IntegratorSettings& settings = c.tables().integrator;
    EXPECT_EQ(settings.max_depth, 7);
    EXPECT_EQ(settings.rr_depth, 3);
    EXPECT_EQ(settings.emitter_samples, 20);
    EXPECT_TRUE(settings.hide_emitters);
    EXPECT_EQ(settings.diffuse_bounces, type == "path");
    EXPECT_EQ(c.info().integrator, type);
    EXPECT_EQ(c.info().max_depth, 7);
  }
}

TEST(IntegratorHost, DefaultsAreMitsubas) {
  for (const Compiled& c : {compile_integrator(""), compile_integrator(integrator("path", ""))}) {
    const IntegratorSettings& settings = c.tables().integrator;
    EXPECT_EQ(c.info().integrator, "path");
    EXPECT_EQ(settings.max_depth, -1);
    EXPECT_EQ(settings.rr_depth, 5);
    EXPECT_EQ(settings.emitter_samples, 1);
    EXPECT_TRUE(settings.diffuse_bounces);
    EXPECT_FALSE(settings.hide_emitters);
  }
}

TEST(IntegratorHost, DirectEndsAtDepthTwo) {
  EXPECT_EQ(compile_integrator(integrator("direct", "")).tables().integrator.max_depth, 2);
  EXPECT_EQ(compile_integrator(integrator("direct", integer("max_depth", "9"))).tables().integrator.max_depth, 2);
  EXPECT_EQ(compile_integrator(integrator("direct", integer("max_depth", "1"))).tables().integrator.max_depth, 1);
  EXPECT_EQ(compile_integrator(integrator("direct", integer("bounces", "0"))).tables().integrator.max_depth, 1);
}

TEST(IntegratorHost, DirectTakesNumbersOfSamples) {
  const auto compile = [](const std::string& inside) { return compile_integrator(integrator("direct", inside)); };
  const auto samples = [&](const std::string& inside) {
    const IntegratorSettings settings = compile(inside).tables().integrator;
    return std::pair(settings.emitter_samples, settings.bsdf_samples);
  };
  EXPECT_EQ(samples(""), std::pair(1, 1));
  EXPECT_EQ(samples(integer("shading_samples", "3")), std::pair(3, 3));
  EXPECT_EQ(samples(integer("emitter_samples", "0") + integer("bsdf_samples", "4")), std::pair(0, 4));
  EXPECT_EQ(samples(integer("bsdf_samples", "0")), std::pair(1, 0));
  EXPECT_THAT(compile(integer("emitter_samples", "0") + integer("bsdf_samples", "0")).messages(),
              ElementsAre("error: 'emitter_samples' and 'bsdf_samples' are both 0 [at least one of them above 0]"));
  EXPECT_THAT(compile(integer("shading_samples", "2") + integer("bsdf_samples", "1")).messages(),
              ElementsAre("error: 'shading_samples' is given besides 'emitter_samples' or 'bsdf_samples' "
                          "[shading_samples alone, or the other two]"));
  EXPECT_THAT(compile(integer("bsdf_samples", "100001")).messages(),
              ElementsAre("error: 'bsdf_samples' is 100001 [an integer from 0 to 100000]"));
  EXPECT_THAT(compile(integer("samples", "1")).messages(),
              ElementsAre("error: unused parameter 'samples' of integrator 'direct' [bounces, bsdf_samples, "
                          "emitter_samples, hide_emitters, max_depth, rr_depth, shading_samples]"));
}

std::vector<std::string> feature_names(const Compiled& c) {
  std::vector<std::string> names;
  for (const FeatureLayer& layer : c.scene.value().layers.features) names.push_back(layer.name);
  return names;
}

TEST(IntegratorHost, MomentIsTheIntegratorInIt) {
  const Compiled c = compile_integrator(integrator("moment", integrator("direct", integer("max_depth", "1"))));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().integrator.max_depth, 1);
  EXPECT_EQ(c.info().integrator, "moment");
  EXPECT_THAT(c.scene->layers.moments, ElementsAre("_arg_0"));
  EXPECT_THAT(
      compile_integrator(integrator("moment", R"(<integrator type="path" name="image"/>)")).scene->layers.moments,
      ElementsAre("image"));
  EXPECT_THAT(compile_integrator(integrator("moment", "")).messages(),
              ElementsAre("error: integrator 'moment' has no integrator in it [<integrator type=\"path\"/> in it]"));
  EXPECT_THAT(compile_integrator(integrator("moment", integrator("path", "") + integrator("path", ""))).messages(),
              ElementsAre("error: integrator 'moment' has more than one integrator [one integrator]"));
  EXPECT_THAT(compile_integrator(integrator("moment", integrator("moment", integrator("path", "")))).messages(),
              ElementsAre("error: integrator 'moment' has an integrator with layers in it "
                          "[direct, path, whitted or depth in it]"));
  EXPECT_THAT(compile_integrator(integrator("moment", integrator("path", integer("depth", "2")))).messages(),
              ElementsAre("error: unused parameter 'depth' of integrator 'path' "
                          "[bounces, emitter_samples, hide_emitters, max_depth, rr_depth]"));
}

std::string aovs(const std::string& value) { return "<string name=\"aovs\" value=\"" + value + "\"/>"; }

TEST(IntegratorHost, AovNamesLayersAsMitsubaDoes) {
  const Compiled c = compile_integrator(integrator(
      "aov", aovs("a:albedo, dd.y:depth,p:position,t:uv,g:geo_normal,n:sh_normal,pu:dp_du,pv:dp_dv,i:prim_index,"
                  "s:shape_index") +
                 R"(<integrator type="path" name="image"><integer name="max_depth" value="3"/></integrator>)"));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(feature_names(c),
              ElementsAre("a.R", "a.G", "a.B", "dd.y.T", "p.X", "p.Y", "p.Z", "t.U", "t.V", "g.X", "g.Y", "g.Z", "n.X",
                          "n.Y", "n.Z", "pu.X", "pu.Y", "pu.Z", "pv.X", "pv.Y", "pv.Z", "i.I", "s.I"));
  EXPECT_THAT(c.scene->layers.image_copies, ElementsAre("image"));
  EXPECT_EQ(c.tables().integrator.max_depth, 3);
}

TEST(IntegratorHost, AovAloneShowsNothing) {
  EXPECT_EQ(compile_integrator(integrator("aov", aovs("n:sh_normal"))).tables().integrator.max_depth, 0);
}

TEST(IntegratorHost, AovTakesAMoment) {
  const Compiled c = compile_integrator(integrator(
      "aov", aovs("n:depth") + "<integrator type=\"moment\" name=\"m\">" + integrator("path", "") + "</integrator>"));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_THAT(c.scene->layers.moments, ElementsAre("m._arg_0"));
}

TEST(IntegratorHost, AovRefusesWhatItDoesNotKnow) {
  const std::string known =
      " [albedo, depth, position, uv, geo_normal, sh_normal, dp_du, dp_dv, prim_index, shape_index]";
  const auto messages = [](const std::string& inside) {
    return compile_integrator(integrator("aov", inside)).messages();
  };
  EXPECT_THAT(messages(aovs("n:sh_norml")),
              ElementsAre("error: unknown aov 'sh_norml', did you mean 'sh_normal'?" + known));
  EXPECT_THAT(messages(aovs("x:duv_dx")), ElementsAre("error: aov 'duv_dx' is not supported yet" + known));
  EXPECT_THAT(messages(aovs("depth")),
              ElementsAre("error: 'aovs' has 'depth' in it [pairs such as position:position, normal:sh_normal]"));
  EXPECT_THAT(messages(aovs("n:position,n:sh_normal")),
              ElementsAre("error: 'aovs' has two layers 'n.X' [a name of its own for each]"));
  EXPECT_THAT(messages(""), ElementsAre("error: integrator 'aov' needs a parameter 'aovs' "
                                        "[<string name=\"aovs\" value=\"NAME:TYPE,...\"/>]"));
  EXPECT_THAT(messages(integer("aovs", "2")), ElementsAre("error: 'aovs' is an integer [string]",
                                                          "error: integrator 'aov' names no layers "
                                                          "[<string name=\"aovs\" value=\"NAME:TYPE,...\"/>]"));
}

TEST(IntegratorHost, DepthTakesNothing) {
  EXPECT_TRUE(compile_integrator(integrator("depth", "")).tables().integrator.distance);
  EXPECT_THAT(compile_integrator(integrator("depth", integer("max_depth", "2"))).messages(),
              ElementsAre("error: unused parameter 'max_depth' of integrator 'depth' [no parameters]"));
}

TEST(IntegratorHost, NestsOnlySoDeep) {
  std::string nested = integrator("path", "");
  for (int i = 0; i < 12; ++i) nested = integrator("aov", aovs("n" + std::to_string(i) + ":depth") + nested);
  EXPECT_THAT(compile_integrator(nested).messages(),
              ElementsAre("error: integrators are nested more than 8 deep [up to 8 inside each other]"));
}

TEST(IntegratorHost, BouncesAreDepthLessOne) {
  EXPECT_EQ(compile_integrator(integrator("path", integer("bounces", "3"))).tables().integrator.max_depth, 4);
  EXPECT_EQ(compile_integrator(integrator("path", integer("bounces", "0"))).tables().integrator.max_depth, 1);
  EXPECT_EQ(compile_integrator(integrator("path", integer("bounces", "2147483646"))).tables().integrator.max_depth,
            2147483647);
  EXPECT_THAT(compile_integrator(integrator("path", integer("bounces", "3") + integer("max_depth", "4"))).messages(),
              ElementsAre("error: both 'bounces' and 'max_depth' are given [one of them]"));
}

TEST(IntegratorHost, RefuseWhatIsOutOfRange) {
  const auto messages = [](const char* name, const char* value) {
    return compile_integrator(integrator("path", integer(name, value))).messages();
  };
  EXPECT_THAT(messages("max_depth", "-2"), ElementsAre("error: 'max_depth' is -2 [an integer from -1 to 2147483647]"));
  EXPECT_THAT(messages("bounces", "-1"), ElementsAre("error: 'bounces' is -1 [an integer from 0 to 2147483646]"));
  EXPECT_THAT(messages("rr_depth", "0"), ElementsAre("error: 'rr_depth' is 0 [an integer from 1 to 2147483647]"));
  EXPECT_THAT(messages("emitter_samples", "0"),
              ElementsAre("error: 'emitter_samples' is 0 [an integer from 1 to 100000]"));
  EXPECT_THAT(messages("emitter_samples", "100001"),
              ElementsAre("error: 'emitter_samples' is 100001 [an integer from 1 to 100000]"));
  EXPECT_THAT(messages("depth", "4"), ElementsAre("error: unused parameter 'depth' of integrator 'path' "
                                                  "[bounces, emitter_samples, hide_emitters, max_depth, rr_depth]"));
  EXPECT_THAT(compile_integrator(integrator("path", R"(<float name="max_depth" value="4"/>)")).messages(),
              ElementsAre("error: 'max_depth' is a float [integer]"));
}

TEST(Ptracer, TakesItsParameters) {
  const Compiled c = compile_integrator(integrator("ptracer", integer("max_depth", "7") + integer("rr_depth", "3") +
                                                                  R"(<boolean name="hide_emitters" value="true"/>)"));
  ASSERT_THAT(c.messages(), IsEmpty());
  const IntegratorSettings& settings = c.tables().integrator;
  EXPECT_TRUE(settings.from_lights);
  EXPECT_EQ(settings.max_depth, 7);
  EXPECT_EQ(settings.rr_depth, 3);
  EXPECT_TRUE(settings.hide_emitters);
}

TEST(Ptracer, DefaultsAreMitsubas) {
  const Compiled c = compile_integrator(integrator("ptracer", ""));
  ASSERT_THAT(c.messages(), IsEmpty());
  const IntegratorSettings& settings = c.tables().integrator;
  EXPECT_TRUE(settings.from_lights);
  EXPECT_EQ(settings.max_depth, -1);
  EXPECT_EQ(settings.rr_depth, 5);
  EXPECT_FALSE(settings.hide_emitters);
  EXPECT_FALSE(compile_integrator(integrator("path", "")).tables().integrator.from_lights);
}

TEST(Ptracer, RefusesWhatIsOutOfRangeAndOtherParameters) {
  const auto messages = [](const std::string& parameter) {
    return compile_integrator(integrator("ptracer", parameter)).messages();
  };
  EXPECT_THAT(messages(integer("max_depth", "-2")),
              ElementsAre("error: 'max_depth' is -2 [an integer from -1 to 2147483647]"));
  EXPECT_THAT(messages(integer("rr_depth", "0")),
              ElementsAre("error: 'rr_depth' is 0 [an integer from 1 to 2147483647]"));
  EXPECT_THAT(messages(integer("samples_per_pass", "16")),
              ElementsAre("note: 'samples_per_pass' of an integrator has no effect here"));
  EXPECT_THAT(messages(R"(<float name="samples_per_pass" value="4"/>)"),
              ElementsAre("error: 'samples_per_pass' is a float [integer]"));
  EXPECT_THAT(messages(R"(<string name="hide_emitters" value="yes"/>)"),
              ElementsAre("error: 'hide_emitters' is a string [boolean]"));
  EXPECT_THAT(messages(integer("emitter_samples", "4")),
              ElementsAre("error: unused parameter 'emitter_samples' of integrator 'ptracer' "
                          "[bounces, hide_emitters, max_depth, rr_depth]"));
}

TEST(VolumeIntegrators, FollowPathsThroughMedia) {
  for (const std::string name : {"volpath", "volpathmis"}) {
    const Compiled c = compile_integrator(integrator(name, integer("max_depth", "7") + integer("rr_depth", "3") +
                                                               R"(<boolean name="hide_emitters" value="true"/>)"));
    EXPECT_THAT(c.messages(), IsEmpty());
    EXPECT_EQ(c.tables().integrator.max_depth, 7);
    EXPECT_EQ(c.tables().integrator.rr_depth, 3);
    EXPECT_TRUE(c.tables().integrator.hide_emitters);
    EXPECT_TRUE(c.tables().integrator.media);
  }
}

TEST(IntegratorHost, RefusesOthers) {
  EXPECT_THAT(compile_integrator(integrator("prb", "")).messages(),
              ElementsAre("error: integrator 'prb' is for differentiable rendering, which this program does not do "
                          "[aov, depth, direct, moment, path, ptracer, "
                          "volpath, volpathmis, whitted]"));
  EXPECT_THAT(compile_integrator(integrator("pth", "")).messages(),
              ElementsAre("error: unknown integrator 'pth', did you mean 'path'? [aov, depth, direct, moment, path, "
                          "ptracer, volpath, volpathmis, whitted]"));
  EXPECT_THAT(compile_integrator(integrator("path", "") + integrator("path", "")).messages(),
              ElementsAre("error: scene has more than one integrator [one integrator]"));
}

TEST(IntegratorHost, TheCommandLinesReplacementKeepsTheParameters) {
  LoadOptions options;
  options.integrator = "whitted";
  const Compiled c = compile_integrator(integrator("path", integer("max_depth", "6")), options);
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.info().integrator, "whitted");
  EXPECT_EQ(c.tables().integrator.max_depth, 6);
  EXPECT_FALSE(c.tables().integrator.diffuse_bounces);
}

TEST(IntegratorHost, TheCommandLinesReplacementMustExist) {
  LoadOptions options;
  options.integrator = "wited";
  const Compiled c = compile_integrator(integrator("path", ""), options);
  EXPECT_THAT(c.messages(), ElementsAre("error: unknown integrator 'wited', did you mean 'whitted'? [aov, depth, "
                                        "direct, moment, path, ptracer, volpath, volpathmis, whitted]"));
  EXPECT_EQ(c.diagnostics.all().at(0).location.line, 0);
}

TEST(IntegratorHost, AReplacedIntegratorsUnknownParametersAreLeftAside) {
  LoadOptions options;
  options.sampler = "independent";
  const Compiled c = compile_elements(
      R"(<sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film>
         <sampler type="orthogonal"><integer name="sample_count" value="9"/><boolean name="jitter" value="true"/></sampler>
         </sensor>)" +
          kShape + kEmitter,
      {}, options);
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().sampler.kind, SamplerKind::independent);
  EXPECT_EQ(c.tables().sampler.samples_per_pixel, 9);
}

}  // namespace
}  // namespace norrsken::testing
