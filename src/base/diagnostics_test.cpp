#include "norrsken/diagnostics.h"

#include <gtest/gtest.h>

namespace norrsken {
namespace {

SourceLocation at(int line, int column, int length, std::string excerpt, int excerpt_column = 1) {
  return {"room.xml", line, column, length, std::move(excerpt), excerpt_column};
}

SourceLocation in(std::string file, int line = 0, int column = 0) {
  SourceLocation location;
  location.file = std::move(file);
  location.line = line;
  location.column = column;
  return location;
}

std::string text_of(SourceLocation location, std::string message = "bad", std::string accepted = {}) {
  return to_text({Diagnostic::Severity::error, std::move(message), std::move(accepted), std::move(location)});
}

TEST(Diagnostics, TheWholeForm) {
  EXPECT_EQ(text_of(at(12, 15, 6, R"(  <bsdf type="difuse"/>)"), "unknown bsdf 'difuse', did you mean 'diffuse'?",
                    "conductor, diffuse, twosided"),
            R"(room.xml:12:15: error: unknown bsdf 'difuse', did you mean 'diffuse'?
   12 |   <bsdf type="difuse"/>
      |               ^~~~~~
accepted: conductor, diffuse, twosided)");
}

TEST(Diagnostics, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(text_of({}), "error: bad");
  EXPECT_EQ(text_of(at(0, 0, 1, "")), "room.xml: error: bad");
  EXPECT_EQ(text_of(at(3, 0, 1, "")), "room.xml:3: error: bad");
  EXPECT_EQ(text_of(at(3, 7, 1, "")), "room.xml:3:7: error: bad");
  EXPECT_EQ(to_text({Diagnostic::Severity::warning, "odd", "", {}}), "warning: odd");
}

TEST(Diagnostics, TabsKeepTheMarkAligned) {
  EXPECT_EQ(text_of(at(1, 4, 2, "\ta\txy")), R"(room.xml:1:4: error: bad
    1 |     a   xy
      |         ^~)");
}

TEST(Diagnostics, ColumnsCountBytesButTheMarkStandsUnderTheCharacter) {
  // U+00E5 is one column wide, U+6F22 two.
  EXPECT_EQ(text_of(at(1, 6, 1, "\xC3\xA5\xE6\xBC\xA2x")),
            "room.xml:1:6: error: bad\n"
            "    1 | \xC3\xA5\xE6\xBC\xA2x\n"
            "      |    ^");
  EXPECT_EQ(text_of(at(1, 3, 3, "\xC3\xA5\xE6\xBC\xA2x")),
            "room.xml:1:3: error: bad\n"
            "    1 | \xC3\xA5\xE6\xBC\xA2x\n"
            "      |  ^~");
}

TEST(Diagnostics, APlaceBehindTheLineIsMarkedThere) {
  EXPECT_EQ(text_of(at(1, 4, 1, "abc")), R"(room.xml:1:4: error: bad
    1 | abc
      |    ^)");
}

TEST(Diagnostics, LongLinesAreShownAroundThePlace) {
  const std::string line = std::string(200, 'a') + "XY" + std::string(200, 'b');
  EXPECT_EQ(text_of(at(1, 201, 2, line)),
            "room.xml:1:201: error: bad\n"
            "    1 | ..." +
                std::string(33, 'a') + "XY" + std::string(65, 'b') +
                "...\n"
                "      |    " +
                std::string(33, ' ') + "^~");
  const std::string early = "XY" + std::string(200, 'b');
  EXPECT_EQ(text_of(at(1, 1, 2, early)),
            "room.xml:1:1: error: bad\n"
            "    1 | XY" +
                std::string(98, 'b') +
                "...\n"
                "      | ^~");
}

TEST(Diagnostics, AnExcerptThatBeginsLaterInTheLineSaysSo) {
  EXPECT_EQ(text_of(at(1, 1003, 1, "abXcd", 1001)), R"(room.xml:1:1003: error: bad
    1 | ...abXcd
      |      ^)");
}

TEST(Diagnostics, TerminalSequencesInFilesAreHarmless) {
  EXPECT_EQ(text_of(at(1, 2, 1, "\x1B[2J"), "found '\x1B[2J'"),
            "room.xml:1:2: error: found '\xEF\xBF\xBD[2J'\n"
            "    1 | \xEF\xBF\xBD[2J\n"
            "      |  ^");
}

TEST(Diagnostics, CountsErrorsNotWarnings) {
  Diagnostics diagnostics;
  diagnostics.warning({}, "odd");
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.error({}, "bad", "good");
  EXPECT_TRUE(diagnostics.has_errors());
  EXPECT_EQ(diagnostics.error_count(), 1);
  ASSERT_EQ(diagnostics.all().size(), 2u);
  EXPECT_EQ(diagnostics.all()[1].accepted, "good");
}

TEST(Diagnostics, KeepsAHundredErrorsAndAHundredWarningsAndCountsTheRest) {
  Diagnostics diagnostics;
  for (int i = 0; i < 1000; ++i) diagnostics.warning(at(i + 1, 1, 1, ""), "odd");
  ASSERT_EQ(diagnostics.all().size(), 101u);
  EXPECT_EQ(to_text(diagnostics.all().back()), "warning: more than 100 warnings, the rest are left out");
  EXPECT_FALSE(diagnostics.has_errors());
  for (int i = 0; i < 1000; ++i) diagnostics.error(at(i + 1, 1, 1, ""), "bad");
  EXPECT_EQ(diagnostics.error_count(), 1000);
  ASSERT_EQ(diagnostics.all().size(), 202u);
  EXPECT_EQ(to_text(diagnostics.all()[101]), "room.xml:1:1: error: bad");
  EXPECT_EQ(to_text(diagnostics.all().back()), "error: more than 100 errors, the rest are left out");
}

TEST(Diagnostics, WhatIsSaidAgainIsKeptOnce) {
  Diagnostics diagnostics;
  for (int i = 0; i < 200; ++i) diagnostics.error(at(1, 2, 1, ""), "bad");
  diagnostics.warning(at(1, 2, 1, ""), "bad");
  diagnostics.error(at(1, 2, 1, ""), "worse");
  diagnostics.error(at(1, 3, 1, ""), "bad");
  diagnostics.error(at(2, 2, 1, ""), "bad");
  diagnostics.error(in("other.xml", 1, 2), "bad");
  EXPECT_EQ(diagnostics.error_count(), 5);
  EXPECT_EQ(diagnostics.all().size(), 6u);
}

TEST(Diagnostics, ANoteIsToldOnceWhereverItStands) {
  Diagnostics diagnostics;
  diagnostics.note(at(1, 2, 1, ""), "no effect");
  diagnostics.note(in("other.xml", 7, 1), "no effect");
  diagnostics.note(at(3, 2, 1, ""), "another");
  diagnostics.warning(at(3, 2, 1, ""), "another");
  EXPECT_FALSE(diagnostics.has_errors());
  ASSERT_EQ(diagnostics.all().size(), 3u);
  EXPECT_EQ(to_text(diagnostics.all()[0]), "room.xml:1:2: note: no effect");
}

TEST(Diagnostics, SortsByFileAndLine) {
  Diagnostics diagnostics;
  diagnostics.error({}, "nowhere");
  diagnostics.error(in("z.xml", 7, 1), "z7");
  diagnostics.error(in("a.xml", 1, 1), "a1");
  diagnostics.error(in("z.xml", 5, 9), "z5.9");
  diagnostics.warning(in("z.xml", 5, 2), "z5.2");
  diagnostics.error(in("z.xml", 5, 9), "z5.9 again");
  diagnostics.error(in("z.xml"), "z");
  diagnostics.sort();
  std::string order;
  for (const Diagnostic& diagnostic : diagnostics.all()) order += diagnostic.message + ", ";
  EXPECT_EQ(order, "z, z5.2, z5.9, z5.9 again, z7, a1, nowhere, ");
}

TEST(Diagnostics, TellsWhereAFileWasNamed) {
  Diagnostics diagnostics;
  diagnostics.named_at("mesh.obj", at(6, 36, 8, ""));
  diagnostics.error(in("mesh.obj"), "no faces", "a face");
  diagnostics.error(in("room.xml"), "bad");
  diagnostics.named_at("mesh.obj", at(9, 36, 8, ""));
  diagnostics.error(in("mesh.obj"), "no faces", "a face");
  ASSERT_EQ(diagnostics.all().size(), 3u);
  EXPECT_EQ(to_text(diagnostics.all()[0]), "mesh.obj: error: no faces (named at room.xml:6:36)\naccepted: a face");
  EXPECT_EQ(to_text(diagnostics.all()[1]), "room.xml: error: bad");
  EXPECT_EQ(to_text(diagnostics.all()[2]), "mesh.obj: error: no faces (named at room.xml:9:36)\naccepted: a face");
}

}  // namespace
}  // namespace norrsken
