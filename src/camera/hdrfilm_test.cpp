#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compile/builder.h"
#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
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

TEST(Hdrfilm, RefusesSizesThatDoNotFitIntoMemory) {
  const auto messages = [](const std::string& sampler, const std::string& integrator) {
    LoadOptions options;
    options.memory = std::make_shared<MemoryBudget>(std::uint64_t{1} << 30);
    return compile_elements(integrator + "<sensor type=\"perspective\"><film type=\"hdrfilm\">" + kBox +
                                size("4096", "4096") + "</film><sampler type=\"" + sampler + "\"/></sensor>" + kShape +
                                kEmitter,
                            {}, options)
        .messages();
  };
  // Two doubles for three channels of two images, and a count; ten floats and what writing takes.
  EXPECT_THAT(messages("sobol", ""),
              ElementsAre("error: a film of 4096 x 4096 pixels with its image needs 2.61 GiB, and 1.00 GiB of 1.00 GiB "
                          "are left [up to 6429591 pixels, as by a smaller --size, or a larger --max-memory]"));
  EXPECT_THAT(messages("independent", ""), ElementsAre(HasSubstr("needs 2.61 GiB")));
  EXPECT_THAT(messages("sobol", "<integrator type=\"ptracer\"/>"), ElementsAre(HasSubstr("needs 5.61 GiB")));
}

std::string integer(const std::string& name, int value) {
  return "<integer name=\"" + name + "\" value=\"" + std::to_string(value) + "\"/>";
}
std::string text(const std::string& name, const std::string& value) {
  return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}
std::string boolean(const std::string& name, bool value) {
  return "<boolean name=\"" + name + "\" value=\"" + (value ? "true" : "false") + "\"/>";
}

TEST(Hdrfilm, RendersACropWindow) {
  const std::string crop = integer("crop_offset_x", 30) + integer("crop_offset_y", 20) + integer("crop_width", 100) +
                           integer("crop_height", 50);
  const Compiled c = compile_film(kBox + size("320", "200") + crop);
  ASSERT_THAT(c.messages(), IsEmpty());
  const FilmSettings& film = c.tables().film;
  EXPECT_EQ(film.width, 100);
  EXPECT_EQ(film.height, 50);
  EXPECT_EQ(film.crop_x, 30);
  EXPECT_EQ(film.crop_y, 20);
  EXPECT_EQ(film.full_width, 320);
  EXPECT_EQ(film.full_height, 200);
  EXPECT_EQ(c.info().width, 100);
  // The camera looks at the whole film.
  const CameraRecord whole = compile_film(kBox + size("320", "200")).tables().camera;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(c.tables().camera.base[i], whole.base[i]);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(c.tables().camera.du[i], whole.du[i]);
}

TEST(Hdrfilm, CropsToTheFilmsEndUnlessTold) {
  const FilmSettings film = compile_film(kBox + size("320", "200") + integer("crop_offset_x", 300)).tables().film;
  EXPECT_EQ(film.width, 20);
  EXPECT_EQ(film.height, 200);
}

TEST(Hdrfilm, RefusesCropsBeyondTheFilm) {
  EXPECT_THAT(compile_film(kBox + size("320", "200") + integer("crop_offset_x", 320)).messages(),
              ElementsAre("error: 'crop_offset_x' is 320 [an integer from 0 to 319]"));
  EXPECT_THAT(
      compile_film(kBox + size("320", "200") + integer("crop_offset_y", 190) + integer("crop_height", 11)).messages(),
      ElementsAre("error: 'crop_height' is 11 [an integer from 1 to 10]"));
  EXPECT_THAT(compile_film(kBox + text("crop_width", "all")).messages(),
              ElementsAre("error: 'crop_width' is a string [integer]"));
}

TEST(Hdrfilm, ACropWindowFollowsTheCommandLinesSize) {
  LoadOptions options;
  options.width = 640;
  const Compiled c = compile_elements(R"(<sensor type="perspective"><film type="hdrfilm">)" + kBox +
                                          size("320", "200") + integer("crop_offset_x", 30) +
                                          integer("crop_width", 100) + "</film></sensor>" + kShape + kEmitter,
                                      {}, options);
  const FilmSettings& film = c.tables().film;
  EXPECT_EQ(film.full_width, 640);
  EXPECT_EQ(film.crop_x, 60);
  EXPECT_EQ(film.width, 200);
  EXPECT_EQ(film.height, 200);
}

TEST(Hdrfilm, SamplesTheBorderOrNot) {
  EXPECT_FALSE(compile_film(kBox).tables().film.sample_border);
  EXPECT_TRUE(compile_film(kBox + boolean("sample_border", true)).tables().film.sample_border);
  EXPECT_TRUE(compile_film(kBox + boolean("high_quality_edges", true)).tables().film.sample_border);
  EXPECT_THAT(compile_film(kBox + boolean("high_quality_edges", true) + boolean("sample_border", false)).messages(),
              ElementsAre("error: 'high_quality_edges' says the contrary of 'sample_border' [one of them]"));
}

TEST(Hdrfilm, TakesEveryFilter) {
  EXPECT_THAT(compile_film(R"(<rfilter type="bix"/>)").messages(),
              ElementsAre("error: unknown rfilter 'bix', did you mean 'box'? "
                          "[box, catmullrom, gaussian, lanczos, mitchell, tent]"));
  EXPECT_THAT(compile_film(R"(<rfilter type="box"><float name="radius" value="2"/></rfilter>)").messages(),
              ElementsAre("error: unused parameter 'radius' of rfilter 'box' [no parameters]"));
}

TEST(Hdrfilm, TakesTheFormatsThatAreWritten) {
  const Compiled standard = compile_film(kBox);
  EXPECT_EQ(standard.tables().film.pixel_format, PixelFormat::rgb);
  EXPECT_FALSE(standard.tables().film.half_precision);
  const Compiled c = compile_film(kBox + text("file_format", "OpenEXR") + text("pixel_format", "luminance_alpha") +
                                  text("component_format", "float16") + boolean("banner", false));
  ASSERT_THAT(c.messages(), IsEmpty());
  EXPECT_EQ(c.tables().film.pixel_format, PixelFormat::luminance_alpha);
  EXPECT_TRUE(c.tables().film.half_precision);
  const Compiled of_words = compile_film(kBox + text("component_format", "UInt32"));
  EXPECT_THAT(of_words.messages(),
              ElementsAre("note: 'component_format' is float32 here, for uint32 holds no radiance"));
  EXPECT_FALSE(of_words.tables().film.half_precision);
  EXPECT_THAT(
      compile_film(kBox + text("component_format", "float64")).messages(),
      ElementsAre("error: 'component_format' is 'float64', did you mean 'float32'? [float32, float16, uint32]"));
  EXPECT_THAT(compile_film(kBox + text("pixel_format", "bgr")).messages(),
              ElementsAre("error: 'pixel_format' is 'bgr' [rgb, rgba, xyz, xyza, luminance, "
                          "luminance_alpha]"));
  for (const char* format : {"pfm", "RGBE"}) {
    EXPECT_THAT(compile_film(kBox + text("file_format", format)).messages(),
                ElementsAre("note: 'file_format' has no effect here (instead: -o FILE.exr, FILE.png or FILE.jpg)"));
  }
  EXPECT_THAT(compile_film(kBox + text("file_format", "png")).messages(),
              ElementsAre("error: 'file_format' is 'png' [openexr, exr, rgbe, pfm]"));
}

TEST(Hdrfilm, RefusesOtherFilmsAndParameters) {
  EXPECT_THAT(compile_sensor(R"(<sensor type="perspective"><film type="specfilm"/></sensor>)").messages(),
              ElementsAre("error: film 'specfilm' is not supported yet [hdrfilm]"));
  EXPECT_THAT(compile_film(kBox + R"(<integer name="widht" value="5"/>)").messages(),
              ElementsAre("error: unused parameter 'widht' of film 'hdrfilm', did you mean 'width'? "
                          "[banner, component_format, crop_height, crop_offset_x, crop_offset_y, crop_width, "
                          "file_format, height, high_quality_edges, pixel_format, sample_border, width]"));
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
