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

TEST(ErrorText, SaysWhyThereIsNone) {
  EXPECT_EQ(error_text({0.0945, 0.091, 0.098}, 64), "estimated error 9.45 % (9.10 % to 9.80 %)");
  EXPECT_EQ(error_text({}, 1.3), "error not known before every pixel has two samples");
  EXPECT_EQ(error_text({}, 16), "error unknown: no light seen");
  EXPECT_EQ(error_text({0, 0, 0}, 16), "no noise seen") << "not 0.00 %: what is rare may come yet";
}

}  // namespace
}  // namespace norrsken::cli
