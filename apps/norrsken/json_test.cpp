#include "json.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <vector>

namespace norrsken::cli {
namespace {

TEST(Json, ValuesOfEveryKind) {
  EXPECT_EQ(Json().text(), "null");
  EXPECT_EQ(Json(true).text(), "true");
  EXPECT_EQ(Json(-3).text(), "-3");
  EXPECT_EQ(Json(std::numeric_limits<std::uint64_t>::max()).text(), "18446744073709551615");
  EXPECT_EQ(Json(0.5).text(), "0.5");
  EXPECT_EQ(Json(2.0).text(), "2.0");
  EXPECT_EQ(Json(0.25f).text(), "0.25");
  EXPECT_EQ(Json(std::numeric_limits<double>::quiet_NaN()).text(), "null");
  EXPECT_EQ(Json(std::optional<int>()).text(), "null");
  EXPECT_EQ(Json(std::optional<int>(4)).text(), "4");
}

TEST(Json, TextIsEscapedAndWhatIsNotUtf8Replaced) {
  EXPECT_EQ(Json("a\"b\\c\n\x01").text(), R"("a\"b\\c\n\u0001")");
  EXPECT_EQ(Json(std::string("\xc3\xa9\xff")).text(), "\"\xc3\xa9\xef\xbf\xbd\"");
}

TEST(Json, ArraysAndObjectsKeepTheirOrder) {
  const double bounds[2] = {1, 2};
  EXPECT_EQ(Json(bounds).text(), "[1.0,2.0]");
  EXPECT_EQ(Json(std::vector<std::string>()).text(), "[]");
  EXPECT_EQ(Json(std::vector<std::string>{"b", "a"}).text(), R"(["b","a"])");
  Json array = std::array<int, 0>();
  array.add({{"x", 1}});
  array.add({{"x", 2}});
  EXPECT_EQ(array.text(), R"([{"x":1},{"x":2}])");
  Json object = {{"name", "a"}, {"inner", {{"n", nullptr}}}};
  object.add("more", 1);
  EXPECT_EQ(object.text(), R"({"name":"a","inner":{"n":null},"more":1})");
  EXPECT_EQ(Json::object(std::map<std::string, std::string>{{"k", "v"}}).text(), R"({"k":"v"})");
  EXPECT_EQ(Json::object(std::map<std::string, std::string>()).text(), "{}");
}

}  // namespace
}  // namespace norrsken::cli
