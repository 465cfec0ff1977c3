#include "formats/curves.h"

#include <gtest/gtest.h>

#include "formats/reader_testing.h"

namespace norrsken {
namespace {

using Points = Array<std::array<float, 4>>;
using Segments = Array<std::uint32_t>;

CurveData read(const std::string& text, CurveBasis basis = CurveBasis::linear) {
  Diagnostics diagnostics;
  auto curves = read_curves(text, basis, "a.txt", diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  return curves.value_or(CurveData{});
}

std::string complaints(const std::string& text, CurveBasis basis = CurveBasis::linear) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_curves(text, basis, "a.txt", diagnostics).has_value());
  return to_text(diagnostics);
}

TEST(Curves, ControlPointsALine) {
  const CurveData curves = read("0 1 2 0.5\n-1e0 .5 +3 0\n4 5 6 1");
  EXPECT_EQ(curves.points, (Points{{0, 1, 2, 0.5f}, {-1, 0.5f, 3, 0}, {4, 5, 6, 1}}));
  EXPECT_EQ(curves.segments, (Segments{0, 1}));
  EXPECT_EQ(curves.curves, 1u);
}

TEST(Curves, EmptyLinesStandBetweenThem) {
  const CurveData curves = read("\n\r\n0 0 0 1\r\n0\t0  1 1 \r\n \t\n\n1 0 0 1\n1 0 1 1\n1 0 2 1\n\n\n");
  EXPECT_EQ(curves.points.size(), 5u);
  EXPECT_EQ(curves.segments, (Segments{0, 2, 3}));
  EXPECT_EQ(curves.curves, 2u);
}

TEST(Curves, CarriageReturnsAloneEndLinesAndAByteOrderMarkIsSkipped) {
  const CurveData curves = read(
      "\xEF\xBB\xBF"
      "0 0 0 1\r0 0 1 1\r\r1 0 0 1\r1 0 1 1\r");
  EXPECT_EQ(curves.points.size(), 4u);
  EXPECT_EQ(curves.segments, (Segments{0, 2}));
}

TEST(Curves, SegmentsOfBsplinesDependOnFourPoints) {
  const std::string line = "0 0 0 1\n";
  const CurveData curves =
      read(line + line + line + line + line + "\n" + line + line + line + line, CurveBasis::bspline);
  EXPECT_EQ(curves.points.size(), 9u);
  EXPECT_EQ(curves.segments, (Segments{0, 1, 5}));
}

TEST(Curves, RadiiOfBsplinesMayBeNegativeWhereTheCurveHasNone) {
  // (0.1 + 4 * 0 - 0.1) / 6 = 0 at the end.
  EXPECT_EQ(read("0 0 0 .2\n1 0 0 .1\n2 0 0 0\n3 0 0 -.1\n", CurveBasis::bspline).segments.size(), 1u);
  EXPECT_EQ(complaints("0 0 0 .2\n1 0 0 .1\n2 0 0 0\n3 0 0 -.13\n", CurveBasis::bspline),
            "a.txt:4:7: error: the curve's radius falls to -0.005 in the segment that ends here\n"
            "    4 | 3 0 0 -.13\n"
            "      |       ^~~~\n"
            "accepted: radii of control points that keep the curve's at 0 or above");
  // Positive at both ends, negative between them.
  EXPECT_NE(complaints("0 0 0 1\n1 0 0 -.2\n2 0 0 -.2\n3 0 0 1\n", CurveBasis::bspline).find("falls to -0.15"),
            std::string::npos);
}

TEST(Curves, WhatFollowsFourNumbersIsLeftOut) {
  Diagnostics diagnostics;
  const auto curves = read_curves("0 0 0 1 7 red\n0 0 1 1 8\n", CurveBasis::linear, "a.txt", diagnostics);
  ASSERT_TRUE(curves.has_value());
  EXPECT_EQ(curves->points, (Points{{0, 0, 0, 1}, {0, 0, 1, 1}}));
  EXPECT_EQ(to_text(diagnostics),
            "a.txt:1:9: warning: a control point of more than 4 numbers\n"
            "    1 | 0 0 0 1 7 red\n"
            "      |         ^\n"
            "accepted: x, y, z and the radius; the rest is left out");
}

TEST(Curves, RefusesLinesThatAreNone) {
  EXPECT_EQ(complaints("0 0 0 1\n  0 0 1\n"),
            "a.txt:2:3: error: a control point of 3 numbers\n"
            "    2 |   0 0 1\n"
            "      |   ^\n"
            "accepted: 4 numbers: x, y, z and the radius");
  EXPECT_EQ(complaints("# hair\n0 0 0 1\n0 0 1 1\n"),
            "a.txt:1:1: error: '#' is not a number\n"
            "    1 | # hair\n"
            "      | ^\n"
            "accepted: a number such as 1.5 or -2e3");
  EXPECT_EQ(complaints("0 nan 0 1\n0 0 -1e13 1\n"),
            "a.txt:1:3: error: 'nan' is not finite\n"
            "    1 | 0 nan 0 1\n"
            "      |   ^~~\n"
            "accepted: a number from -1e+12 to 1e+12\n"
            "a.txt:2:5: error: '-1e13' is too large\n"
            "    2 | 0 0 -1e13 1\n"
            "      |     ^~~~~\n"
            "accepted: a number from -1e+12 to 1e+12");
  EXPECT_EQ(complaints("0 0 0 1\n0 0 1 -2\n"),
            "a.txt:2:7: error: the radius -2 is negative\n"
            "    2 | 0 0 1 -2\n"
            "      |       ^~\n"
            "accepted: a radius of at least 0");
}

TEST(Curves, RefusesCurvesThatAreTooShort) {
  EXPECT_EQ(complaints("0 0 0 1\n0 0 1 1\n\n5 0 0 1\n"),
            "a.txt:4:1: error: a curve of 1 control point\n"
            "    4 | 5 0 0 1\n"
            "      | ^\n"
            "accepted: at least 2 control points");
  EXPECT_EQ(complaints("0 0 0 1\n0 0 1 1\n0 0 2 1\n", CurveBasis::bspline),
            "a.txt:1:1: error: a curve of 3 control points\n"
            "    1 | 0 0 0 1\n"
            "      | ^\n"
            "accepted: at least 4 control points");
}

TEST(Curves, RefusesFilesWithoutAny) {
  for (const char* text : {"", "\n \n\t\r\n"}) {
    EXPECT_EQ(complaints(text),
              "a.txt: error: the file has no control points\n"
              "accepted: lines of 4 numbers: x, y, z and the radius");
  }
}

TEST(Curves, ComplainsOnlySoOften) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "x\n";
  const std::string all = complaints(text);
  EXPECT_EQ(all.find("a.txt:21:"), std::string::npos);
  EXPECT_NE(all.find("and more errors in this file"), std::string::npos);
}

}  // namespace
}  // namespace norrsken
