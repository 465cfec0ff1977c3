#include "scene/source_text.h"

#include <gtest/gtest.h>

#include <chrono>

namespace norrsken {
namespace {

TEST(SourceText, LinesAndColumnsCountFromOne) {
  const SourceText text("a.xml", "ab\ncd\r\n\nlast");
  EXPECT_EQ(text.location(0).line, 1);
  EXPECT_EQ(text.location(0).column, 1);
  const SourceLocation d = text.location(4, 1);
  EXPECT_EQ(d.file, "a.xml");
  EXPECT_EQ(d.line, 2);
  EXPECT_EQ(d.column, 2);
  EXPECT_EQ(d.excerpt, "cd") << "without the line break, also of two bytes";
  EXPECT_EQ(text.location(7).line, 3);
  EXPECT_EQ(text.location(7).excerpt, "");
  EXPECT_EQ(text.location(8).line, 4);
  EXPECT_EQ(text.location(11).column, 4);
}

TEST(SourceText, CarriageReturnsAloneEndLines) {
  const SourceText text("a.obj", "ab\rcd\r\nef");
  EXPECT_EQ(text.location(1).excerpt, "ab");
  EXPECT_EQ(text.location(4).line, 2);
  EXPECT_EQ(text.location(4).column, 2);
  EXPECT_EQ(text.location(4).excerpt, "cd");
  EXPECT_EQ(text.location(7).line, 3);
}

TEST(SourceText, PlacesAreCutAtTheEndOfTheirLineAndFile) {
  const SourceText text("a.xml", "abc\ndef");
  EXPECT_EQ(text.location(1, 100).length, 2);
  EXPECT_EQ(text.location(3, 1).length, 1) << "the line break itself";
  const SourceLocation end = text.location(1000, 5);
  EXPECT_EQ(end.line, 2);
  EXPECT_EQ(end.column, 4);
  EXPECT_EQ(end.length, 1);
}

TEST(SourceText, TheFileAsAWholeHasNoLine) {
  EXPECT_EQ(SourceText("a.xml", "abc").location().line, 0);
  EXPECT_EQ(SourceText("a.xml", "").location(0).line, 1);
}

TEST(SourceText, ExcerptsOfHugeLinesAreBounded) {
  // Two-byte characters throughout, so that a careless cut would fall inside one.
  std::string line;
  for (int i = 0; i < 100000; ++i) line += "\xC3\xA5";
  const SourceText text("a.xml", line);
  for (const std::size_t offset : {0u, 2u, 100000u, 199998u}) {
    const SourceLocation location = text.location(offset, 2);
    EXPECT_LE(location.excerpt.size(), 161u);
    EXPECT_GE(location.excerpt.size(), 150u);
    EXPECT_EQ(location.excerpt.size() % 2, 0u);
    EXPECT_EQ(location.excerpt_column % 2, 1);
    EXPECT_GE(location.column, location.excerpt_column);
    EXPECT_LT(location.column, location.excerpt_column + static_cast<int>(location.excerpt.size()));
    EXPECT_EQ(location.column, static_cast<int>(offset) + 1);
  }
}

TEST(SourceText, ManyPlacesInOneHugeLineAreCheap) {
  const std::string line(8 << 20, 'x');
  const SourceText text("a.xml", line);
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < 100000; ++i) EXPECT_EQ(text.location(i * 80).line, 1);
  // Looking at the whole line each time would be 8e11 bytes.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

}  // namespace
}  // namespace norrsken
