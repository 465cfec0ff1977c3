// What is said of values that cannot be read.
#include <gtest/gtest.h>

#include "formats/reader_testing.h"

namespace norrsken {
namespace {

TEST(ValueErrors, NotANumber) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="fov" value="abc"/>
</scene>)"),
            R"(room.xml:2:28: error: 'abc' is not a number
    2 |   <float name="fov" value="abc"/>
      |                            ^~~
accepted: a number such as 1.5 or -2e3)");
}

TEST(ValueErrors, EmptyNumber) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="fov" value=""/>
</scene>)"),
            R"(room.xml:2:28: error: '' is not a number
    2 |   <float name="fov" value=""/>
      |                            ^
accepted: a number such as 1.5 or -2e3)");
}

TEST(ValueErrors, NotFinite) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="a" value="nan"/>
  <float name="b" value="-inf"/>
</scene>)"),
            R"(room.xml:2:26: error: 'nan' is not finite
    2 |   <float name="a" value="nan"/>
      |                          ^~~
accepted: a finite number
room.xml:3:26: error: '-inf' is not finite
    3 |   <float name="b" value="-inf"/>
      |                          ^~~~
accepted: a finite number)");
}

TEST(ValueErrors, AbsurdNumber) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <float name="fov" value="1e999"/>
</scene>)"),
            R"(room.xml:2:28: error: '1e999' is too large
    2 |   <float name="fov" value="1e999"/>
      |                            ^~~~~
accepted: a finite number)");
}

TEST(ValueErrors, NotAnInteger) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <integer name="a" value="1.5"/>
  <integer name="b" value="99999999999999999999"/>
</scene>)"),
            R"(room.xml:2:28: error: '1.5' is not an integer
    2 |   <integer name="a" value="1.5"/>
      |                            ^~~
accepted: an integer such as 16
room.xml:3:28: error: '99999999999999999999' is too large
    3 |   <integer name="b" value="99999999999999999999"/>
      |                            ^~~~~~~~~~~~~~~~~~~~
accepted: an integer such as 16)");
}

TEST(ValueErrors, NotABoolean) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <boolean name="on" value="yes"/>
</scene>)"),
            R"(room.xml:2:29: error: 'yes' is not a boolean
    2 |   <boolean name="on" value="yes"/>
      |                             ^~~
accepted: true, false)");
}

TEST(ValueErrors, VectorOfTwo) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <point name="center" value="1, 2"/>
</scene>)"),
            R"(room.xml:2:31: error: '1, 2' has 2 numbers
    2 |   <point name="center" value="1, 2"/>
      |                               ^~~~
accepted: three numbers, or one for all three)");
}

TEST(ValueErrors, OneNumberOfThree) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <vector name="up" value="0, up, 1"/>
</scene>)"),
            R"(room.xml:2:31: error: 'up' is not a number
    2 |   <vector name="up" value="0, up, 1"/>
      |                               ^~
accepted: a number such as 1.5 or -2e3)");
}

TEST(ValueErrors, IncompleteCoordinates) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <point name="center" x="1" y="2"/>
</scene>)"),
            R"(room.xml:2:3: error: <point> needs an attribute 'z'
    2 |   <point name="center" x="1" y="2"/>
      |   ^~~~~~
accepted: either value, or x, y and z)");
}

TEST(ValueErrors, CoordinatesTwice) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <point name="center" value="1 2 3" x="1"/>
</scene>)"),
            R"(room.xml:2:41: error: 'value' and 'x' say the same thing
    2 |   <point name="center" value="1 2 3" x="1"/>
      |                                         ^
accepted: either value, or x, y and z)");
}

TEST(ValueErrors, Rgb) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <rgb name="a" value="1 2"/>
  <rgb name="b" value="#12345"/>
  <rgb name="c" value="red"/>
</scene>)"),
            R"(room.xml:2:24: error: '1 2' has 2 numbers
    2 |   <rgb name="a" value="1 2"/>
      |                        ^~~
accepted: three numbers, or one for all three
room.xml:3:24: error: '#12345' is not a hexadecimal colour
    3 |   <rgb name="b" value="#12345"/>
      |                        ^~~~~~
accepted: #rrggbb with digits 0 to 9 and a to f
room.xml:4:24: error: 'red' is not a number
    4 |   <rgb name="c" value="red"/>
      |                        ^~~
accepted: a number such as 1.5 or -2e3)");
}

TEST(ValueErrors, Spectrum) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <spectrum name="a" value="400:0.1, 500"/>
  <spectrum name="b" value="500:0.1, 400:0.2"/>
  <spectrum name="c" value="400:x"/>
  <spectrum name="d" value="blue"/>
  <spectrum name="e"/>
  <spectrum name="f" value="550:1"/>
</scene>)"),
            R"(room.xml:2:38: error: '500' is not a pair
    2 |   <spectrum name="a" value="400:0.1, 500"/>
      |                                      ^~~
accepted: a number, or wavelength:value pairs such as 400:0.1, 700:0.8
room.xml:3:38: error: '400' is not above the wavelength before it
    3 |   <spectrum name="b" value="500:0.1, 400:0.2"/>
      |                                      ^~~
accepted: wavelengths in nm, ascending
room.xml:4:33: error: 'x' is not a number
    4 |   <spectrum name="c" value="400:x"/>
      |                                 ^
accepted: a number such as 1.5 or -2e3
room.xml:5:29: error: 'blue' is not a number
    5 |   <spectrum name="d" value="blue"/>
      |                             ^~~~
accepted: a number, or wavelength:value pairs such as 400:0.1, 700:0.8
room.xml:6:3: error: <spectrum> needs either 'value' or 'filename'
    6 |   <spectrum name="e"/>
      |   ^~~~~~~~~
accepted: value="0.5", value="400:0.1, 700:0.8", filename="measured.spd"
room.xml:7:29: error: '550:1' is a spectrum at one wavelength
    7 |   <spectrum name="f" value="550:1"/>
      |                             ^~~~~
accepted: a number, or wavelength:value pairs such as 400:0.1, 700:0.8)");
}

TEST(ValueErrors, SpectrumFiles) {
  EXPECT_EQ(complaints_about(TestFiles{{"room.xml", R"(<scene version="3.0.0">
  <spectrum name="a" filename="missing.spd"/>
  <spectrum name="b" filename="wide.spd"/>
  <spectrum name="c" filename="word.spd"/>
  <spectrum name="d" filename="order.spd"/>
  <spectrum name="e" filename="none.spd"/>
  <spectrum name="f" filename="one.spd"/>
</scene>)"},
                                       {"wide.spd", "400 1 2\n"},
                                       {"word.spd", "# measured\n400 1\n500 one\n"},
                                       {"order.spd", "500 1\n400 1\n"},
                                       {"none.spd", "# nothing\n"},
                                       {"one.spd", "550 1\n"}}),
            R"(room.xml:2:32: error: there is no file 'missing.spd'
    2 |   <spectrum name="a" filename="missing.spd"/>
      |                                ^~~~~~~~~~~
accepted: a file in the current folder
wide.spd:1:1: error: 3 numbers on a line (named at room.xml:3:32)
    1 | 400 1 2
      | ^~~~~~~
accepted: a wavelength in nm and a value on each line, # for comments
word.spd:3:5: error: 'one' is not a number (named at room.xml:4:32)
    3 | 500 one
      |     ^~~
accepted: a wavelength in nm and a value on each line, # for comments
order.spd:2:1: error: '400' is not above the wavelength before it (named at room.xml:5:32)
    2 | 400 1
      | ^~~
accepted: wavelengths in nm, ascending
none.spd: error: the file has no spectrum (named at room.xml:6:32)
accepted: a wavelength in nm and a value on each line, # for comments
one.spd: error: the file's spectrum is at one wavelength (named at room.xml:7:32)
accepted: a wavelength in nm and a value on each line, # for comments)");
}

TEST(ValueErrors, TheMarkSurvivesEntitiesCommentsAndQuotes) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <!-- value="1" --><float   name = 'a&amp;b'
	value	=	'1.x' /><integer name="c" value="&#49;x"/>
</scene>)"),
            R"(room.xml:3:11: error: '1.x' is not a number
    3 |     value   =   '1.x' /><integer name="c" value="&#49;x"/>
      |                  ^~~
accepted: a number such as 1.5 or -2e3
room.xml:3:43: error: '1x' (from '&#49;x') is not an integer
    3 |     value   =   '1.x' /><integer name="c" value="&#49;x"/>
      |                                                  ^~~~~~
accepted: an integer such as 16)");
}

TEST(TransformErrors, UnknownStep) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <transform name="to_world">
    <rotatee x="1" angle="90"/>
    text
  </transform>
</scene>)"),
            R"(room.xml:3:5: error: unknown step 'rotatee' in a <transform>, did you mean 'rotate'?
    3 |     <rotatee x="1" angle="90"/>
      |     ^~~~~~~~
accepted: translate, scale, rotate, lookat, look_at, matrix
room.xml:4:5: error: text in <transform>
    4 |     text
      |     ^~~~
accepted: translate, scale, rotate, lookat, look_at, matrix)");
}

TEST(TransformErrors, LookAt) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <transform name="a">
    <lookat origin="1 2 3" target="1 2 3" up="0 0 1"/>
    <lookat origin="0 0 0" target="0 0 1" up="0 0 2"/>
    <lookat origin="0 0 0"/>
  </transform>
</scene>)"),
            R"(room.xml:3:36: error: 'target' is the same point as 'origin'
    3 |     <lookat origin="1 2 3" target="1 2 3" up="0 0 1"/>
      |                                    ^~~~~
accepted: a point to look at, some way off
room.xml:4:47: error: 'up' points along the line of sight
    4 |     <lookat origin="0 0 0" target="0 0 1" up="0 0 2"/>
      |                                               ^~~~~
accepted: a direction that does not
room.xml:5:5: error: <lookat> needs an attribute 'target'
    5 |     <lookat origin="0 0 0"/>
      |     ^~~~~~~
accepted: origin, target, up)");
}

TEST(TransformErrors, Rotate) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <transform name="a">
    <rotate angle="90"/>
    <rotate x="1"/>
    <rotate x="1" angle="right"/>
  </transform>
</scene>)"),
            R"(room.xml:3:5: error: (0, 0, 0) is no axis to rotate about
    3 |     <rotate angle="90"/>
      |     ^~~~~~~
accepted: a direction such as x="1"
room.xml:4:5: error: <rotate> needs an attribute 'angle'
    4 |     <rotate x="1"/>
      |     ^~~~~~~
accepted: angle, value, x, y, z
room.xml:5:26: error: 'right' is not a number
    5 |     <rotate x="1" angle="right"/>
      |                          ^~~~~
accepted: a number such as 1.5 or -2e3)");
}

TEST(TransformErrors, Matrix) {
  EXPECT_EQ(complaints_about(R"(<scene version="3.0.0">
  <transform name="a">
    <matrix value="1 0 0 1"/>
  </transform>
</scene>)"),
            R"(room.xml:3:20: error: a matrix of 4 numbers
    3 |     <matrix value="1 0 0 1"/>
      |                    ^~~~~~~
accepted: 16 numbers (4x4), or 9 (3x3), row after row)");
}

/// The matrix of these steps, row after row, and what was said about them.
std::pair<std::vector<double>, std::string> matrix_of(const std::string& steps, const std::string& version = "3.0.0") {
  Diagnostics diagnostics;
  const auto scene = read_scene("<scene version=\"" + version + R"("><shape type="cube"><transform name="to_world">)" +
                                    steps + "</transform></shape></scene>",
                                {}, diagnostics);
  std::vector<double> elements;
  const glm::dmat4 matrix =
      to_glm(std::get<Property::Transform>(scene.value().scene->children.at(0).node->properties.at(0).value));
  for (int i = 0; i < 16; ++i) elements.push_back(matrix[i % 4][i / 4]);
  return {elements, to_text(diagnostics)};
}

void expect_near(const std::vector<double>& values, const std::vector<double>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-4) << i;
}

TEST(Transform, AxesOfAnyLengthMeanWhatTheyMeanInMitsuba) {
  // As Mitsuba 3.9.1 prints them.
  const auto [about_y, warning] = matrix_of(R"(<rotate y="2" angle="30"/>)");
  expect_near(about_y, {0.8660, 0, 1, 0, 0, 1.4019, 0, 0, -1, 0, 0.8660, 0, 0, 0, 0, 1});
  EXPECT_EQ(
      warning.substr(0, warning.find('\n')),
      "room.xml:1:70: warning: the axis is 2 long, and the step no rotation: it stretches besides, as in Mitsuba 3");
  EXPECT_EQ(warning.substr(warning.rfind('\n')), "\naccepted: the axis value=\"0 1 0\" for a rotation");
  expect_near(matrix_of(R"(<rotate x="1" y="1" angle="30"/>)").first,
              {1, 0.1340, 0.5, 0, 0.1340, 1, -0.5, 0, -0.5, 0.5, 0.8660, 0, 0, 0, 0, 1});
  // What is of unit length but for its decimals is a rotation, and all is in 0.6.
  const auto [rounded, nothing] = matrix_of(R"(<rotate value="0.577 0.577 0.577" angle="120"/>)");
  expect_near(rounded, {0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1});
  EXPECT_EQ(nothing, "");
  const auto [old, note] = matrix_of(R"(<rotate value="5 5 5" angle="120"/>)", "0.6.0");
  expect_near(old, {0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1});
  EXPECT_EQ(note.find("warning"), std::string::npos);
}

TEST(Transform, LastRowsWithFewDecimals) {
  for (const char* last : {"0 0 0 0.999999", "0 0 0 1.000001", "-0.000001 0.000002 0 1"}) {
    const auto [matrix, said] = matrix_of("<matrix value=\"1 0 0 5 0 1 0 6 0 0 1 7 " + std::string(last) + "\"/>");
    EXPECT_EQ(matrix, (std::vector<double>{1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1})) << last;
    EXPECT_EQ(said, "");
  }
  for (const char* last : {"0 0 0 0.5", "0 0 0.001 1"}) {
    const auto matrix = matrix_of("<matrix value=\"1 0 0 5 0 1 0 6 0 0 1 7 " + std::string(last) + "\"/>").first;
    EXPECT_NE(std::vector<double>(matrix.begin() + 12, matrix.end()), (std::vector<double>{0, 0, 0, 1})) << last;
  }
}

}  // namespace
}  // namespace norrsken
