#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "compile/builder.h"
#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string kBox = R"(<rfilter type="box"/>)";

std::string size(const std::string& width, const std::string& height) {
  return R"(<integer name="width" value=")" + width + R"("/><integer name="height" value=")" + height + "\"/>";
}

TEST(Hdrfilm, HasASize) {
  const Compiled c = compile_film(kBox + size("320", "200"));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().film.width, 320);
  EXPECT_EQ(c.tables().film.height, 200);
  EXPECT_EQ(c.info().width, 320);
  EXPECT_EQ(c.info().height, 200);
}

TEST(Hdrfilm, IsOfMitsubasSizeUnlessTold) {
  for (const Compiled& c : {compile_film(kBox), compile_sensor(R"(<sensor type="perspective"/>)")}) {
    EXPECT_EQ(c.tables().film.width, 768);
    EXPECT_EQ(c.tables().film.height, 576);
  }
}

TEST(Hdrfilm, RefusesSizesThatNoMachineHolds) {
  EXPECT_THAT(compile_film(kBox + size("10000000", "1")).messages(),
              ElementsAre("error: 'width' is 10000000 [an integer from 1 to 65536]"));
  EXPECT_THAT(compile_film(kBox + size("1", "0")).messages(),
              ElementsAre("error: 'height' is 0 [an integer from 1 to 65536]"));
  EXPECT_THAT(compile_film(kBox + size("65536", "65536")).messages(),
              ElementsAre("error: a film of 65536 x 65536 has 4294967296 pixels [up to 268435456 pixels]"));
  EXPECT_THAT(compile_film(kBox + size("16384", "4096")).messages(), IsEmpty());
}

TEST(Hdrfilm, RefusesSizesThatThisMachineDoesNotHold) {
  // 25 GiB.
  const auto memory = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGE_SIZE);
  const std::vector<std::string> messages = compile_film(kBox + size("65536", "4096")).messages();
  if (memory >= std::uint64_t{25} << 30) {
    EXPECT_THAT(messages, IsEmpty());
  } else {
    EXPECT_THAT(messages, ElementsAre("error: " + film_memory_message(65536, 4096, memory) + " [up to " +
                                      std::to_string(memory / 100) + " pixels]"));
  }
  EXPECT_EQ(film_memory_message(65536, 4096, std::uint64_t{3} << 29),
            "a film of 65536 x 4096 pixels needs 25.0 GiB, this machine has 1.5 GiB");
}

TEST(Hdrfilm, WarnsThatBoxStandsInForAMissingFilter) {
  const Compiled c = compile_film("");
  EXPECT_TRUE(c.scene);
  EXPECT_THAT(c.messages(), ElementsAre("warning: no rfilter given: 'box' is used, because Mitsuba's default, "
                                        "'gaussian', is not supported yet [<rfilter type=\"box\"/>]"));
}

TEST(Hdrfilm, TakesTheBoxFilterOnly) {
  EXPECT_THAT(compile_film(R"(<rfilter type="gaussian"/>)").messages(),
              ElementsAre("error: rfilter 'gaussian' is not supported yet [box]"));
  EXPECT_THAT(compile_film(R"(<rfilter type="bix"/>)").messages(),
              ElementsAre("error: unknown rfilter 'bix', did you mean 'box'? [box]"));
  EXPECT_THAT(compile_film(R"(<rfilter type="box"><float name="radius" value="2"/></rfilter>)").messages(),
              ElementsAre("error: unused parameter 'radius' of rfilter 'box' [no parameters]"));
}

TEST(Hdrfilm, TakesTheFormatsThatAreWritten) {
  EXPECT_THAT(compile_film(kBox + R"(<string name="file_format" value="openexr"/>)" +
                           R"(<string name="pixel_format" value="rgb"/>)" +
                           R"(<string name="component_format" value="float32"/>)")
                  .messages(),
              IsEmpty());
  EXPECT_THAT(compile_film(kBox + R"(<string name="component_format" value="float16"/>)").messages(),
              ElementsAre("warning: component_format 'float16' is not supported yet: float32 is written [float32]"));
  EXPECT_THAT(compile_film(kBox + R"(<string name="pixel_format" value="rgba"/>)").messages(),
              ElementsAre("warning: pixel_format 'rgba' is not supported yet: rgb is written [rgb]"));
  EXPECT_THAT(compile_film(kBox + R"(<string name="pixel_format" value="luminance"/>)").messages(),
              ElementsAre("error: pixel_format 'luminance' is not supported yet [rgb]"));
  EXPECT_THAT(compile_film(kBox + R"(<string name="file_format" value="pfm"/>)").messages(),
              ElementsAre("error: file_format 'pfm' is not supported yet [openexr]"));
}

TEST(Hdrfilm, RefusesOtherFilmsAndParameters) {
  EXPECT_THAT(compile_sensor(R"(<sensor type="perspective"><film type="specfilm"/></sensor>)").messages(),
              ElementsAre("error: film 'specfilm' is not supported yet [hdrfilm]"));
  EXPECT_THAT(compile_film(kBox + R"(<integer name="widht" value="5"/>)").messages(),
              ElementsAre("error: unused parameter 'widht' of film 'hdrfilm', did you mean 'width'? "
                          "[component_format, file_format, height, pixel_format, width]"));
}

TEST(Hdrfilm, TheCommandLinesSizeWins) {
  LoadOptions options;
  options.width = 100;
  const Compiled c = compile_elements(kSensor + kShape + kEmitter, {}, options);
  EXPECT_EQ(c.tables().film.width, 100);
  EXPECT_EQ(c.tables().film.height, 576);
  options.width = 0;
  options.height = 65537;
  EXPECT_THAT(
      compile_elements(kSensor + kShape + kEmitter, {}, options).messages(),
      ElementsAre("error: width 0 is out of range [1 to 65536]", "error: height 65537 is out of range [1 to 65536]"));
}

}  // namespace
}  // namespace norrsken::testing
