#include "formats/pbrt/lexer.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "formats/pbrt/pbrt_testing.h"
#include "scene/memory_files.h"

namespace norrsken::pbrt {
namespace {

std::string tokens_of(const std::string& text, Diagnostics& diagnostics) {
  const Source source("a.pbrt", FileContents{MemoryReservation(0), text});
  Lexer lexer(source, diagnostics);
  std::string tokens;
  while (const auto token = lexer.take()) {
    tokens += tokens.empty() ? "" : "|";
    tokens += token->kind == Token::Kind::string ? "'" + token->value + "'" : std::string(token->text);
  }
  return tokens;
}

std::string tokens_of(const std::string& text) {
  Diagnostics diagnostics;
  std::string tokens = tokens_of(text, diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  return tokens;
}

std::string gzip(const std::string& text) {
  std::string packed(compressBound(text.size()) + 64, '\0');
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

TEST(PbrtLexer, WordsEndAtBlanksQuotesAndBrackets) {
  EXPECT_EQ(tokens_of("Scale 1 -2.5e3\t3\r\nShape\"a b\"[1 2]x#y # end\n#[\n7"),
            "Scale|1|-2.5e3|3|Shape|'a b'|[|1|2|]|x#y|7");
  EXPECT_EQ(tokens_of(""), "");
  EXPECT_EQ(tokens_of("\xEF\xBB\xBF# with a byte order mark\nA"), "A");
}

TEST(PbrtLexer, StringsHaveEscapes) {
  EXPECT_EQ(tokens_of(R"("a\"b\\c\td")"), "'a\"b\\c\td'");
  Diagnostics diagnostics;
  tokens_of("x \"a\\qb\"", diagnostics);
  EXPECT_EQ(to_text(diagnostics),
            "a.pbrt:1:5: error: unknown escape '\\q' in a string\n"
            "    1 | x \"a\\qb\"\n"
            "      |     ^~\n"
            "accepted: \\b, \\f, \\n, \\r, \\t, \\\\, \\', \\\"");
}

TEST(PbrtLexer, AStringEndsInItsLine) {
  Diagnostics diagnostics;
  tokens_of("\"abc\ndef", diagnostics);
  EXPECT_EQ(diagnostics.first_error(), "the string does not end in its line");
}

TEST(PbrtSource, FilesMayBePacked) {
  const std::string text = "WorldBegin\n# something\n";
  std::string error;
  const std::string packed = gzip(text);
  const MemoryFiles files({{"a.gz", packed},
                           {"two.gz", packed + gzip("Shape \"sphere\"")},
                           {"cut.gz", packed.substr(0, 20)},
                           {"bad.gz", packed.substr(0, 11) + "xxxxxxxxxxxxxxxxxxxxx"}});
  EXPECT_EQ(read_unpacked(files, "a.gz", error)->bytes, text);
  EXPECT_EQ(read_unpacked(files, "two.gz", error)->bytes, text + "Shape \"sphere\"");
  EXPECT_FALSE(read_unpacked(files, "cut.gz", error));
  EXPECT_EQ(error, "ends early");
  EXPECT_FALSE(read_unpacked(files, "bad.gz", error));
  EXPECT_EQ(error.substr(0, 10), "is damaged");
}

TEST(PbrtSource, WhatIsUnpackedIsCounted) {
  const MemoryScope scope(std::make_shared<MemoryBudget>(std::uint64_t{1} << 20));
  const MemoryFiles files({{"bomb.gz", gzip(std::string(std::size_t{1} << 24, ' '))}});
  std::string error;
  EXPECT_THROW(read_unpacked(files, "bomb.gz", error), MemoryExceeded);
}

}  // namespace
}  // namespace norrsken::pbrt
