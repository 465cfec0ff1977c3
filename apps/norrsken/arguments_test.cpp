#include "arguments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

namespace norrsken::cli {
namespace {

using testing::HasSubstr;
using testing::Pair;

TEST(ParseDefinition, SplitsAtTheFirstEqualsSign) {
  EXPECT_THAT(parse_definition("light=point"), Pair("light", "point"));
  EXPECT_THAT(parse_definition("a=b=c"), Pair("a", "b=c"));
  EXPECT_THAT(parse_definition("a="), Pair("a", ""));
  EXPECT_THAT(parse_definition("a"), Pair("", ""));
  EXPECT_THAT(parse_definition("=a"), Pair("", "a"));
}

TEST(ParseSize, TakesTwoPositiveWholeNumbersAndNothingElse) {
  EXPECT_THAT(parse_size("800x600"), Pair(800, 600));
  EXPECT_THAT(parse_size("1X2"), Pair(1, 2));
  for (const char* wrong :
       {"", "x", "800", "800x", "x600", "0x1", "1x0", "-1x1", "1x2x3", "1x2 ", "8e2x1", "99999999999x1"})
    EXPECT_THAT(parse_size(wrong), Pair(0, 0)) << wrong;
}

TEST(ParseShare, TakesAFractionOrPercent) {
  EXPECT_EQ(parse_share("1%"), 0.01);
  EXPECT_EQ(parse_share("0.005"), 0.005);
  for (const char* wrong : {"", "%", "0", "0%", "100%", "1", "-1%", "nan", "1%%", "1 percent"})
    EXPECT_EQ(parse_share(wrong), std::nullopt) << wrong;
}

TEST(ParseDuration, TakesANumberWithItsUnit) {
  EXPECT_EQ(parse_duration("90s"), 90.0);
  EXPECT_EQ(parse_duration("1.5m"), 90.0);
  EXPECT_EQ(parse_duration("2h"), 7200.0);
  for (const char* wrong : {"", "s", "90", "0s", "-1s", "1d", "1 m", "1ms", "infs", "nans", "1e30h"})
    EXPECT_EQ(parse_duration(wrong), std::nullopt) << wrong;
}

TEST(ParseSamples, TakesARangeThatIsNotEmpty) {
  EXPECT_EQ(parse_samples("16:64"), (SampleRange{16, 64}));
  EXPECT_EQ(parse_samples("0:2147483647"), (SampleRange{0, 2147483647}));
  for (const char* wrong : {"", ":", "16", "16:", ":64", "64:16", "4:4", "-1:4", "1:2:3", "1.5:4", "0:2147483648"})
    EXPECT_EQ(parse_samples(wrong), std::nullopt) << wrong;
}

TEST(WholeNumber, NamesWhatWasFoundAndWhatIsAccepted) {
  const Check check = whole_number(1, 100);
  EXPECT_EQ(check(std::string("1")), "");
  EXPECT_EQ(check(std::string("100")), "");
  EXPECT_EQ(check(std::string("0")), "found '0', accepted is a whole number from 1 to 100");
  for (const char* wrong : {"101", "-1", "", "1.5", "4k", "1e1", " 1", "99999999999999999999"})
    EXPECT_NE(check(std::string(wrong)), "") << wrong;
}

TEST(SeedNumber, TakesAll64Bits) {
  EXPECT_EQ(seed_number()(std::string("18446744073709551615")), "");
  EXPECT_NE(seed_number()(std::string("18446744073709551616")), "");
  EXPECT_NE(seed_number()(std::string("-1")), "");
}

TEST(RealNumber, IsFiniteAndWithinBounds) {
  const Check check = real_number(-64, 64);
  for (const char* right : {"-1.5", "+2", "0", "1e1", ".5"}) EXPECT_EQ(check(std::string(right)), "") << right;
  for (const char* wrong : {"nan", "inf", "65", "", "1,5", "two"}) EXPECT_NE(check(std::string(wrong)), "") << wrong;
}

TEST(OneOf, SuggestsTheNearestWord) {
  const Check check = one_of({"srgb", "filmic"});
  EXPECT_EQ(check(std::string("filmic")), "");
  EXPECT_EQ(check(std::string("filmc")), "unknown value 'filmc', did you mean 'filmic'? accepted: srgb, filmic");
  EXPECT_EQ(check(std::string("aces")), "unknown value 'aces'; accepted: srgb, filmic");
}

/// A command line as `norrsken render` takes it.
struct SceneLine {
  SceneArguments scene;
  MachineArguments machine;
  ToneArguments tone;

  /// What is wrong with it, if anything.
  std::string parse(const std::string& line) {
    Command command = {.name = "render"};
    scene.add_to(command);
    machine.add_to(command);
    tone.add_to(command);
    const Program program = {.name = "norrsken", .commands = {command}};
    std::istringstream words(line);
    return parse_command_line(program, {std::istream_iterator<std::string>(words), {}}).complaint;
  }
};

TEST(SceneArguments, DefinitionsJoinedAndApartInOrder) {
  SceneLine line;
  EXPECT_EQ(line.parse("render -Da=1 room.xml -D b=2 -Da=3 --size 20x10 --sampler independent --sensor left --spp 8"),
            "");
  const LoadOptions options = line.scene.load_options();
  EXPECT_EQ(line.scene.scene, "room.xml");
  EXPECT_THAT(options.parameters, testing::ElementsAre(Pair("a", "1"), Pair("b", "2"), Pair("a", "3")));
  EXPECT_EQ(options.width, 20);
  EXPECT_EQ(options.height, 10);
  EXPECT_EQ(options.sampler, "independent");
  EXPECT_EQ(options.sensor, "left");
  EXPECT_EQ(options.samples_per_pixel, 8);
  EXPECT_FALSE(options.integrator);
}

TEST(ToneArguments, NegativeExposureIsAValueNotAnOption) {
  SceneLine line;
  EXPECT_EQ(line.parse("render room.xml --exposure -1.5 --tone filmic --threads 3 --isa avx2"), "");
  EXPECT_EQ(line.tone.tone_mapping().exposure, -1.5f);
  EXPECT_EQ(line.tone.tone_mapping().curve, ToneMapping::Curve::filmic);
  RenderOptions options;
  line.machine.apply_to(options);
  EXPECT_EQ(options.threads, 3);
  EXPECT_EQ(options.isa, "avx2");
  EXPECT_EQ(options.accelerator, "auto");
}

std::string complaint(const std::string& text) { return SceneLine().parse(text); }

TEST(ParseCommandLine, AComplaintNamesTheOptionAndASuggestion) {
  EXPECT_EQ(complaint("render a.xml --thread 3"), "unknown option '--thread', did you mean '--threads'?");
  EXPECT_EQ(complaint("render a.xml --zzz=3"), "unknown option '--zzz'");
  EXPECT_EQ(complaint("render a.xml b.xml"), "unexpected argument 'b.xml'");
  EXPECT_EQ(complaint("render a.xml --threads"), "option '--threads' needs a value");
  EXPECT_THAT(complaint("render a.xml -Dfoo"), HasSubstr("found 'foo', accepted is NAME=VALUE"));
  EXPECT_THAT(complaint("render"), HasSubstr("SCENE"));
  EXPECT_EQ(complaint("--spp=4 render a.xml"), "'--spp' belongs after the command: norrsken render --spp");
  EXPECT_EQ(complaint("-W"), "unknown option '-W'");
}

}  // namespace
}  // namespace norrsken::cli
