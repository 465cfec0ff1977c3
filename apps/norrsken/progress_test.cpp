#include "progress.h"

#include <gtest/gtest.h>

namespace norrsken::cli {
namespace {

RenderProgress half_way() {
  return {.samples_done = 3'225'600,
          .samples_total = 7'680'000,
          .elapsed_seconds = 12.1,
          .samples_per_second = 17.2e6,
          .fraction = 0.42,
          .seconds_left = 16.7,
          .error = {0.0183, 0.0175, 0.0191}};
}

TEST(ProgressLine, TellsEverythingWithin79Columns) {
  const std::string line = progress_line("", half_way(), 79);
  EXPECT_EQ(line, " 42 %  3.23 M/7.68 M samples  12 s, 17 s left  17.2 Msamples/s  error 1.83 %");
}

TEST(ProgressLine, LeavesOutTheLeastImportantFirst) {
  EXPECT_EQ(progress_line("", half_way(), 60), " 42 %  12 s, 17 s left  17.2 Msamples/s  error 1.83 %");
  EXPECT_EQ(progress_line("", half_way(), 40), " 42 %  12 s, 17 s left  error 1.83 %");
  EXPECT_EQ(progress_line("", half_way(), 25), " 42 %  error 1.83 %");
  EXPECT_EQ(progress_line("", half_way(), 5), " 42 %");
  EXPECT_EQ(progress_line("figure 9: ", half_way(), 6), "figure");
  EXPECT_EQ(progress_line("", half_way(), 0), "");
}

TEST(ProgressLine, SaysHundredPercentOnlyWhenDone) {
  EXPECT_TRUE(progress_line("", {.fraction = 0.9999999}, 80).starts_with(" 99 %"));
  EXPECT_TRUE(progress_line("", {.fraction = 1}, 80).starts_with("100 %"));
}

TEST(ProgressLine, LeavesOutWhatIsUnknown) {
  EXPECT_EQ(progress_line("x: ", {.samples_done = 0, .samples_total = 10, .elapsed_seconds = 0.2}, 80),
            "x:   0 %  0/10 samples  0.2 s");
}

}  // namespace
}  // namespace norrsken::cli
