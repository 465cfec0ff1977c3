#include "base/text.h"

#include <gtest/gtest.h>

namespace norrsken {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(Text, TrimRemovesBlanksAtBothEndsOnly) {
  EXPECT_EQ(trim(" \t a b\r\n"), "a b");
  EXPECT_EQ(trim(" \n"), "");
  EXPECT_EQ(trim(""), "");
}

TEST(Text, SplitsAtAnyNumberOfSeparators) {
  const auto pieces = split(", ab  c,", " ,");
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].text, "ab");
  EXPECT_EQ(pieces[0].offset, 2u);
  EXPECT_EQ(pieces[1].text, "c");
  EXPECT_EQ(pieces[1].offset, 6u);
  EXPECT_TRUE(split(" ,", " ,").empty());
}

TEST(Text, CaseIsIgnoredOnRequest) {
  EXPECT_TRUE(equal_ignoring_case("TrUe", "true"));
  EXPECT_FALSE(equal_ignoring_case("true", "tru"));
  EXPECT_FALSE(equal_ignoring_case("tru", "true"));
  EXPECT_FALSE(equal_ignoring_case("trux", "true"));
}

TEST(Text, EditDistanceCountsEachKindOfTypingErrorOnce) {
  EXPECT_EQ(edit_distance("diffuse", "diffuse"), 0u);
  EXPECT_EQ(edit_distance("difuse", "diffuse"), 1u);
  EXPECT_EQ(edit_distance("difffuse", "diffuse"), 1u);
  EXPECT_EQ(edit_distance("diffuze", "diffuse"), 1u);
  EXPECT_EQ(edit_distance("dfifuse", "diffuse"), 1u);
  EXPECT_EQ(edit_distance("Diffuse", "diffuse"), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(Text, SuggestsOnlyWhatCouldBeATypingError) {
  EXPECT_EQ(closest_word("difuse", {"conductor", "diffuse", "twosided"}), "diffuse");
  EXPECT_EQ(closest_word("glass", {"conductor", "diffuse"}), std::nullopt);
  EXPECT_EQ(closest_word("x", {"y"}), std::nullopt);
  EXPECT_EQ(closest_word("maxDepth", {"max_depth"}), "max_depth");
  EXPECT_EQ(did_you_mean("spq", {"spp", "width"}), ", did you mean 'spp'?");
  EXPECT_EQ(did_you_mean("light", {"spp", "width"}), "");
  EXPECT_EQ(closest_word(std::string(200, 'a'), {std::string(200, 'a')}), std::nullopt);
}

TEST(Text, QuotedCutsBetweenCharacters) {
  EXPECT_EQ(quoted("abc", 3), "'abc'");
  EXPECT_EQ(quoted("abcd", 3), "'abc...'");
  EXPECT_EQ(quoted("a\xC3\xA5"
                   "bcd",
                   2),
            "'a...'");  // the cut would fall inside the second character
}

TEST(Text, LongListsAreCut) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a", "bcdef"}, 3), "a, bcd...");
  EXPECT_EQ(listed(std::vector<std::string>(20, "a")), "a" + repeated(", a", 19));
  EXPECT_EQ(listed(std::vector<std::string>(21, "a")), "a" + repeated(", a", 19) + ", ...");
  EXPECT_EQ(listed({std::string(1000, 'x')}), std::string(60, 'x') + "...");
}

TEST(Text, Utf8IsCheckedStrictly) {
  EXPECT_EQ(find_invalid_utf8("plain \xC3\xA5 \xE2\x82\xAC \xF0\x9F\x98\x80"), std::nullopt);
  EXPECT_EQ(find_invalid_utf8("ab\xFF"), 2u);
  EXPECT_EQ(find_invalid_utf8("\xC0\x80"), 0u);          // overlong NUL
  EXPECT_EQ(find_invalid_utf8("\xE0\x80\x80"), 0u);      // overlong
  EXPECT_EQ(find_invalid_utf8("a\xED\xA0\x80"), 1u);     // surrogate
  EXPECT_EQ(find_invalid_utf8("\xF4\x90\x80\x80"), 0u);  // above U+10FFFF
  EXPECT_EQ(find_invalid_utf8("abc\xE2\x82"), 3u);       // cut off
}

TEST(Text, DisplayWidthKnowsWideAndCombiningCharacters) {
  EXPECT_EQ(display_width("a", 0, 1), 1);
  EXPECT_EQ(display_width("\xC3\xA5", 0, 2), 1);
  EXPECT_EQ(display_width("\xE6\xBC\xA2", 0, 3), 2);  // U+6F22
  EXPECT_EQ(display_width("\xCC\x81", 0, 2), 0);      // U+0301
}

TEST(Text, PrintableDisarmsTerminalSequences) {
  EXPECT_EQ(printable("a\x1B[31mb"), "a\xEF\xBF\xBD[31mb");
  EXPECT_EQ(printable("a\xC2\x9B"
                      "b"),
            "a\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(printable("a\xFF"
                      "b\n"),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD");
  EXPECT_EQ(printable("\xC3\xA5"), "\xC3\xA5");
}

TEST(Text, JoinPutsSeparatorsBetween) {
  EXPECT_EQ(join({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(join({"a"}, " -> "), "a");
  EXPECT_EQ(join({}), "");
}

}  // namespace
}  // namespace norrsken
