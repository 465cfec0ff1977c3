#include "figures/figures_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <pugixml.hpp>

#include "figures/svg_plot.h"

namespace norrsken::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

Plot two_series() {
  return {.title = "Error <against> \"samples\" & time",
          .x_label = "samples",
          .y_label = "error",
          .series = {{.name = "a < b", .css_class = "literal", .points = {{1, 50, "first"}, {150, 3, "last & least"}}},
                     {.name = "other", .css_class = "one-ray", .square_marker = true, .points = {{10, 9, ""}}}}};
}

TEST(LogTicks, OneTwoFiveWithinTheBounds) {
  EXPECT_THAT(log_ticks(1, 10), testing::Pointwise(testing::DoubleEq(), {1.0, 2.0, 5.0, 10.0}));
  EXPECT_THAT(log_ticks(0.03, 0.4), testing::Pointwise(testing::DoubleNear(1e-12), {0.05, 0.1, 0.2}));
}

TEST(SvgPlot, IsWellFormedAndDrawsEveryPoint) {
  pugi::xml_document document;
  const auto result = document.load_string(svg_log_log_plot(two_series()).c_str());
  ASSERT_TRUE(result) << result.description();
  const pugi::xml_node svg = document.child("svg");
  EXPECT_STREQ(svg.child_value("title"), "Error <against> \"samples\" & time");
  EXPECT_EQ(svg.select_nodes("circle").size(), 2 + 1u);  // and one in the legend
  EXPECT_EQ(svg.select_nodes("rect").size(), 1 + 1u);
  EXPECT_EQ(svg.select_nodes("text[@class='point']").size(), 2u);
}

TEST(SvgPlot, GreaterIsToTheRightAndHigherUp) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg_log_log_plot(two_series()).c_str()));
  const auto circles = document.select_nodes("//circle");
  const pugi::xml_node first = circles[0].node(), last = circles[1].node();
  EXPECT_LT(first.attribute("cx").as_double(), last.attribute("cx").as_double());  // 1 and 150 samples
  EXPECT_LT(first.attribute("cy").as_double(), last.attribute("cy").as_double());  // errors 50 and 3
  for (const auto& circle : circles) {
    EXPECT_GE(circle.node().attribute("cx").as_double(), 0);
    EXPECT_LE(circle.node().attribute("cx").as_double(), 640);
  }
}

TEST(SvgPlot, SurvivesWhatHasNoLogarithm) {
  Plot plot = two_series();
  plot.series[0].points = {{0, 1, "zero"}, {1, -1, "negative"}, {std::nan(""), 1, "nan"}};
  plot.series[1].points.clear();
  const std::string svg = svg_log_log_plot(plot);
  EXPECT_TRUE(pugi::xml_document().load_string(svg.c_str()));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(EscapeHtml, TheFiveReservedCharacters) {
  EXPECT_EQ(escape_html("<a href=\"x\">'&'</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
}

FigureResult figure(int number, int spp, int shadow_rays, double seconds, double rel_mse) {
  FigureResult result = {.name = "Figure " + std::to_string(number),
                         .caption = "caption",
                         .stem = "figure_" + std::to_string(number),
                         .light = "area",
                         .integrator = "path",
                         .sampler = "independent",
                         .spp = spp,
                         .shadow_rays = shadow_rays,
                         .reference = "reference"};
  result.statistics.seconds = seconds;
  result.statistics.samples = 1000;
  result.comparison.mse = 0.04;
  result.comparison.rel_mse = rel_mse;
  result.comparison.mean_b = 0.5;
  return result;
}

FiguresReport small_report() {
  FiguresReport report;
  report.command = "norrsken figures -o 'a & b'";
  report.machine = "Processor <X>";
  report.width = report.height = 200;
  report.figures = {figure(7, 5, 5, 1, 0.1), figure(10, 5, 5, 1, 0.11), figure(13, 150, 150, 420, 0.0016)};
  report.one_ray = {figure(0, 5, 1, 0.5, 0.2), figure(0, 300, 1, 6, 0.0016)};
  report.equal = 1;
  return report;
}

TEST(FigureResult, ErrorsByTheirDefinitions) {
  const FigureResult result = figure(1, 1, 1, 2, 0.0016);
  EXPECT_DOUBLE_EQ(result.relative_error(), 0.04);
  EXPECT_DOUBLE_EQ(result.relative_rmse(), 0.4);
  EXPECT_DOUBLE_EQ(result.samples_per_second(), 500);
}

TEST(FiguresPage, RefersToNothingButItsOwnImages) {
  const std::string html = figures_page(small_report());
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, HasSubstr("src=\"figure_13.png\""));
  EXPECT_THAT(html, HasSubstr("Processor &lt;X&gt;"));
  EXPECT_THAT(html, HasSubstr("-o &#39;a &amp; b&#39;"));
}

TEST(FiguresPage, SaysHowItsSettingsDifferFromTheReports) {
  FiguresReport report = small_report();
  EXPECT_THAT(figures_page(report),
              HasSubstr("at the report's settings but for the size, which is 800 × 800 there: 200 "
                        "× 200 pixels, 3 bounces, independent sampling"));
  report.figures.front().sampler = "sobol";
  EXPECT_THAT(figures_page(report), HasSubstr(" there and the sampling, which is independent there: 200 "));
  report.figures.front().sampler = "independent";
  report.width = report.height = 800;
  EXPECT_THAT(figures_page(report), HasSubstr("at the report's own settings: 800 × 800 pixels"));
}

TEST(FiguresPage, TellsTheRatiosOfEqualError) {
  const std::string html = figures_page(small_report());
  EXPECT_THAT(html, HasSubstr("2 times as many samples"));
  EXPECT_THAT(html, HasSubstr("70 times as fast"));
  FiguresReport same = small_report();
  same.one_ray[1].spp = 150;
  EXPECT_THAT(figures_page(same), HasSubstr(": as many samples"));
  FiguresReport without = small_report();
  without.equal.reset();
  EXPECT_THAT(figures_page(without), Not(HasSubstr("times as fast")));
}

}  // namespace
}  // namespace norrsken::cli
