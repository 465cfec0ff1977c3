#include "base/numbers.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace norrsken {
namespace {

NumberStatus status_of(std::string_view text) {
  double value = 0;
  return parse_number(text, value);
}

double value_of(std::string_view text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(parse_number(text, value), NumberStatus::ok) << text;
  return value;
}

TEST(Numbers, ReadsDecimalForms) {
  EXPECT_EQ(value_of("1"), 1.0);
  EXPECT_EQ(value_of("+1.5"), 1.5);
  EXPECT_EQ(value_of("-.25"), -0.25);
  EXPECT_EQ(value_of("2."), 2.0);
  EXPECT_EQ(value_of("-1.5e3"), -1500.0);
  EXPECT_EQ(value_of("1E-2"), 0.01);
}

TEST(Numbers, RefusesWhatIsNotOneNumber) {
  for (const char* text :
       {"", " ", "abc", "1 ", " 1", "1.5x", "0x10", "1,5", "--1", "+-1", "+", "-", ".", "1e", "1.2.3"})
    EXPECT_EQ(status_of(text), NumberStatus::malformed) << text;
}

TEST(Numbers, TellsNotFiniteFromOverflowFromUnderflow) {
  for (const char* text : {"nan", "NaN", "-nan", "inf", "-inf", "infinity"})
    EXPECT_EQ(status_of(text), NumberStatus::not_finite) << text;
  EXPECT_EQ(status_of("1e999"), NumberStatus::overflow);
  EXPECT_EQ(status_of("-1e999"), NumberStatus::overflow);
  EXPECT_EQ(status_of("1" + std::string(400, '0')), NumberStatus::overflow);
  EXPECT_EQ(value_of("1e-999"), 0.0);
  EXPECT_EQ(value_of("0." + std::string(400, '0') + "1"), 0.0);
  float single = 1;
  EXPECT_EQ(parse_number("1e39", single), NumberStatus::overflow);
  EXPECT_EQ(single, 1.0f) << "a failed read leaves the value alone";
}

TEST(Numbers, Integers) {
  std::int64_t value = 7;
  EXPECT_EQ(parse_integer("-12", value), NumberStatus::ok);
  EXPECT_EQ(value, -12);
  EXPECT_EQ(parse_integer("+9223372036854775807", value), NumberStatus::ok);
  EXPECT_EQ(value, std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(parse_integer("9223372036854775808", value), NumberStatus::overflow);
  for (const char* text : {"", "1.5", "1e3", "x", "1 ", "0x1"})
    EXPECT_EQ(parse_integer(text, value), NumberStatus::malformed) << text;
}

}  // namespace
}  // namespace norrsken
