#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(SamplerHost, BothKindsTakeCountAndSeed) {
  const std::string inside = R"(<integer name="sample_count" value="37"/><integer name="seed" value="11"/></sampler>)";
  const Compiled independent = compile_sampler(R"(<sampler type="independent">)" + inside);
  const Compiled sobol = compile_sampler(R"(<sampler type="sobol">)" + inside);
  ASSERT_THAT(independent.messages(), IsEmpty());
  ASSERT_THAT(sobol.messages(), IsEmpty());
  EXPECT_EQ(independent.tables().sampler.kind, SamplerKind::independent);
  EXPECT_EQ(sobol.tables().sampler.kind, SamplerKind::sobol);
  for (const Compiled* c : {&independent, &sobol}) {
    EXPECT_EQ(c->tables().sampler.samples_per_pixel, 37);
    EXPECT_EQ(c->tables().sampler.seed, 11u);
    EXPECT_EQ(c->info().samples_per_pixel, 37);
  }
}

TEST(SamplerHost, MitsubasStratifiedOnesGetTheSobolPoints) {
  const std::string jitter = R"(<boolean name="jitter" value="false"/>)";
  for (const auto& [type, inside] : {std::pair<std::string, std::string>{"stratified", jitter},
                                     {"multijitter", jitter},
                                     {"orthogonal", jitter + R"(<integer name="strength" value="3"/>)"},
                                     {"ldsampler", ""}}) {
    const Compiled c = compile_sampler("<sampler type=\"" + type + R"("><integer name="sample_count" value="5"/>)" +
                                       R"(<integer name="seed" value="2"/>)" + inside + "</sampler>");
    ASSERT_THAT(c.messages(), IsEmpty());
    EXPECT_EQ(c.tables().sampler.kind, SamplerKind::sobol);
    EXPECT_EQ(c.tables().sampler.samples_per_pixel, 5);
    EXPECT_EQ(c.tables().sampler.seed, 2u);
    EXPECT_EQ(c.info().sampler, type);
  }
  EXPECT_THAT(compile_sampler(R"(<sampler type="ldsampler">)" + jitter + "</sampler>").messages(),
              ElementsAre("error: unused parameter 'jitter' of sampler 'ldsampler' [sample_count, seed]"));
  EXPECT_THAT(
      compile_sampler(R"(<sampler type="orthogonal"><integer name="strength" value="1"/></sampler>)").messages(),
      ElementsAre("error: 'strength' is 1 [an integer from 2 to 1024]"));
  EXPECT_THAT(compile_sampler(R"(<sampler type="stratified"><integer name="jitter" value="1"/></sampler>)").messages(),
              ElementsAre("error: 'jitter' is an integer [boolean]"));
}

TEST(SamplerHost, SobolWithFourSamplesIsTheDefault) {
  const Compiled c = compile_sampler("");
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().sampler.kind, SamplerKind::sobol);
  EXPECT_EQ(c.tables().sampler.samples_per_pixel, 4);
  EXPECT_EQ(c.tables().sampler.seed, 0u);
  EXPECT_EQ(c.info().sampler, "sobol");
}

TEST(SamplerHost, RefusesCountsThatMakeNoImage) {
  for (const char* count : {"0", "-1", "2147483648"}) {
    EXPECT_THAT(compile_sampler(std::string("<sampler type=\"sobol\"><integer name=\"sample_count\" value=\"") + count +
                                "\"/></sampler>")
                    .messages(),
                ElementsAre(std::string("error: 'sample_count' is ") + count + " [an integer from 1 to 2147483647]"));
  }
  EXPECT_THAT(compile_sampler(R"(<sampler type="sobol"><float name="sample_count" value="4"/></sampler>)").messages(),
              ElementsAre("error: 'sample_count' is a float [integer]"));
  EXPECT_THAT(compile_sampler(R"(<sampler type="sobol"><integer name="seed" value="-1"/></sampler>)").messages(),
              ElementsAre("error: 'seed' is -1 [an integer of at least 0]"));
}

TEST(SamplerHost, RefusesOtherSamplersAndParameters) {
  EXPECT_THAT(compile_sampler(R"(<sampler type="sobel"/>)").messages(),
              ElementsAre("error: unknown sampler 'sobel', did you mean 'sobol'? "
                          "[independent, ldsampler, multijitter, orthogonal, sobol, stratified]"));
  EXPECT_THAT(compile_sampler(R"(<sampler type="sobol"><integer name="count" value="1"/></sampler>)").messages(),
              ElementsAre("error: unused parameter 'count' of sampler 'sobol' [sample_count, seed]"));
  EXPECT_THAT(compile_sampler(R"(<sampler type="sobol"/><sampler type="sobol"/>)").messages(),
              ElementsAre("error: sensor 'perspective' has more than one sampler [one sampler]"));
}

}  // namespace
}  // namespace norrsken::testing
