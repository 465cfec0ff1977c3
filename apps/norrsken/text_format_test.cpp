#include "text_format.h"

#include <gtest/gtest.h>

#include <limits>

namespace norrsken::cli {
namespace {

TEST(FormatDuration, ChangesUnitWhereRoundingDoes) {
  EXPECT_EQ(format_duration(0), "0.00 s");
  EXPECT_EQ(format_duration(0.00171), "1.7 ms");
  EXPECT_EQ(format_duration(0.42), "0.42 s");
  EXPECT_EQ(format_duration(9.994), "9.99 s");
  EXPECT_EQ(format_duration(9.996), "10.0 s");
  EXPECT_EQ(format_duration(59.94), "59.9 s");
  EXPECT_EQ(format_duration(59.96), "1 min 00 s");
  EXPECT_EQ(format_duration(247), "4 min 07 s");
  EXPECT_EQ(format_duration(3599.6), "1 h 00 min");
  EXPECT_EQ(format_duration(7 * 3600 + 200), "7 h 03 min");
  EXPECT_EQ(format_duration(52 * 3600), "2 d 04 h");
}

TEST(FormatDuration, UnknownIsAQuestionMark) {
  EXPECT_EQ(format_duration(-1), "?");
  EXPECT_EQ(format_duration(std::numeric_limits<double>::infinity()), "?");
  EXPECT_EQ(format_duration(std::numeric_limits<double>::quiet_NaN()), "?");
}

TEST(FormatDigits, NoExponent) {
  EXPECT_EQ(format_digits(0.134), "0.13");
  EXPECT_EQ(format_digits(9.996), "10.0");
  EXPECT_EQ(format_digits(1234.4), "1234");
}

TEST(FormatCount, ThreeDigitsAndASuffix) {
  EXPECT_EQ(format_count(0), "0");
  EXPECT_EQ(format_count(999), "999");
  EXPECT_EQ(format_count(999.6), "1.00 k");
  EXPECT_EQ(format_count(12345), "12.3 k");
  EXPECT_EQ(format_count(999999), "1.00 M");
  EXPECT_EQ(format_count(4.31e10), "43.1 G");
  EXPECT_EQ(format_count(5e18), "5000 P");
}

TEST(FormatPercent, SmallSharesKeepTheirDigits) {
  EXPECT_EQ(format_percent(0.0123), "1.23 %");
  EXPECT_EQ(format_percent(1.5), "150 %");
  EXPECT_EQ(format_percent(0.00012), "0.012 %");
  EXPECT_EQ(format_percent(0), "0.00 %");
  EXPECT_EQ(format_percent(-1), "?");
}

TEST(FormatPlural, OneIsSingular) {
  EXPECT_EQ(format_plural(0, "light"), "0 lights");
  EXPECT_EQ(format_plural(1, "sphere"), "1 sphere");
  EXPECT_EQ(format_plural(2, "shadow ray"), "2 shadow rays");
}

TEST(FormatBytes, BinarySuffixes) {
  EXPECT_EQ(format_bytes(1023), "1023 B");
  EXPECT_EQ(format_bytes(1536), "1.5 KiB");
  EXPECT_EQ(format_bytes(1024 * 1024 - 1), "1.0 MiB");
  EXPECT_EQ(format_bytes(12ull << 30), "12 GiB");
}

TEST(ErrorText, SaysWhyThereIsNone) {
  EXPECT_EQ(error_text({0.0945, 0.091, 0.098}, 64), "estimated error 9.45 % (9.10 % to 9.80 %)");
  EXPECT_EQ(error_text({}, 1.3), "error not known before every pixel has two samples");
  EXPECT_EQ(error_text({}, 16), "error unknown: no light seen");
  EXPECT_EQ(error_text({0, 0, 0}, 16), "no noise seen") << "not 0.00 %: what is rare may come yet";
}

}  // namespace
}  // namespace norrsken::cli
