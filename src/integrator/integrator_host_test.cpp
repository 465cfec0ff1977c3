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
                                                                  integer("samples_per_pass", "16") +
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
  EXPECT_THAT(messages(integer("samples_per_pass", "0")),
              ElementsAre("error: 'samples_per_pass' is 0 [an integer from 1 to 2147483647]"));
  EXPECT_THAT(messages(R"(<float name="samples_per_pass" value="4"/>)"),
              ElementsAre("error: 'samples_per_pass' is a float [integer]"));
  EXPECT_THAT(messages(R"(<string name="hide_emitters" value="yes"/>)"),
              ElementsAre("error: 'hide_emitters' is a string [boolean]"));
  EXPECT_THAT(messages(integer("emitter_samples", "4")),
              ElementsAre("error: unused parameter 'emitter_samples' of integrator 'ptracer' "
                          "[bounces, hide_emitters, max_depth, rr_depth, samples_per_pass]"));
}

TEST(IntegratorHost, RefusesOthers) {
  EXPECT_THAT(compile_integrator(integrator("volpath", "")).messages(),
              ElementsAre("error: integrator 'volpath' is not supported yet [direct, path, ptracer, whitted]"));
  EXPECT_THAT(compile_integrator(integrator("pth", "")).messages(),
              ElementsAre("error: unknown integrator 'pth', did you mean 'path'? [direct, path, ptracer, whitted]"));
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
  EXPECT_THAT(
      c.messages(),
      ElementsAre("error: unknown integrator 'wited', did you mean 'whitted'? [direct, path, ptracer, whitted]"));
  EXPECT_EQ(c.diagnostics.all().at(0).location.line, 0);
}

TEST(IntegratorHost, AReplacedIntegratorsUnknownParametersAreLeftAside) {
  LoadOptions options;
  options.sampler = "independent";
  const Compiled c = compile_elements(
      R"(<sensor type="perspective"><film type="hdrfilm"><rfilter type="box"/></film>
         <sampler type="multijitter"><integer name="sample_count" value="9"/><boolean name="jitter" value="true"/></sampler>
         </sensor>)" +
          kShape + kEmitter,
      {}, options);
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().sampler.kind, SamplerKind::independent);
  EXPECT_EQ(c.tables().sampler.samples_per_pixel, 9);
}

}  // namespace
}  // namespace norrsken::testing
