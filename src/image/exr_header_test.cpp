#include "image/exr_header.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>

namespace norrsken {
namespace {

using namespace std::string_literals;

const std::string kStart = "\x76\x2f\x31\x01\x02\0\0\0"s;

std::string attribute(const std::string& size, const std::string& type = "string", const std::string& value = "xyz") {
  return "a\0"s + type + '\0' + size + value;
}

/// Whether a header with this attribute, and a text behind it, fits.
bool fits(const std::string& type, const std::string& value) {
  const std::string size{static_cast<char>(value.size()), 0, 0, 0};
  return exr_block_bytes(kStart + attribute(size, type, value) + attribute("\3\0\0\0"s) + '\0').has_value();
}

TEST(ExrHeader, AttributesAreNoLongerThanTheFile) {
  EXPECT_TRUE(exr_block_bytes(kStart + attribute("\3\0\0\0"s) + '\0'));
  EXPECT_FALSE(exr_block_bytes(kStart + attribute("\4\0\0\0"s)));
  EXPECT_FALSE(exr_block_bytes(kStart + attribute("\0\0\0\x70"s) + '\0'));
  EXPECT_FALSE(exr_block_bytes(kStart + attribute("\xff\xff\xff\xff"s) + '\0'));
  EXPECT_FALSE(exr_block_bytes(kStart + "a"));
  EXPECT_FALSE(exr_block_bytes(kStart)) << "the header does not end";
  EXPECT_FALSE(exr_block_bytes("v/1"));
  // Of a file of several parts the second header counts as well.
  const std::string parts = "\x76\x2f\x31\x01\x02\x10\0\0"s + attribute("\3\0\0\0"s) + '\0';
  EXPECT_TRUE(exr_block_bytes(parts + attribute("\3\0\0\0"s) + "\0\0"s));
  EXPECT_FALSE(exr_block_bytes(parts + attribute("\0\0\0\x70"s) + "\0\0"s));
}

std::string named(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + std::string{static_cast<char>(value.size()), 0, 0, 0} + value;
}
std::string numbers(std::initializer_list<std::int32_t> values) {
  std::string bytes;
  for (const std::int32_t value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  return bytes;
}

TEST(ExrHeader, WhatIsDecodedAtOnceIsWhatAFileCanHold) {
  const std::string half = named("channels", "chlist", "Y\0"s + numbers({1, 0, 1, 1}) + '\0');
  const auto rows = [&](std::int32_t right, char compression, std::size_t behind = 0) {
    return exr_block_bytes(kStart + half + named("compression", "compression", {compression}) +
                           named("dataWindow", "box2i", numbers({-1, 0, right, 0})) + '\0' + std::string(behind, 'x'))
        .has_value();
  };
  // 64 MiB are 32 rows of 1 Mi halves.
  EXPECT_TRUE(rows((1 << 20) - 2, 6));
  EXPECT_EQ(exr_block_bytes(kStart + half + named("compression", "compression", "\3") +
                            named("dataWindow", "box2i", numbers({-1, 0, 98, 0})) + '\0'),
            100u * 16 * 2);
  EXPECT_FALSE(rows((1 << 20) - 1, 6));
  EXPECT_TRUE(rows((1 << 20) - 1, 6, 66000)) << "of which deflate makes more";
  EXPECT_TRUE(rows((1 << 20) - 1, 3)) << "ZIP takes 16 rows";
  EXPECT_FALSE(rows(std::numeric_limits<std::int32_t>::max(), 0));
  const auto tile = [&](std::int32_t size) {
    return exr_block_bytes(kStart + half + named("tiles", "tiledesc", numbers({size, size}) + '\0') + '\0').has_value();
  };
  EXPECT_TRUE(tile(4096));
  EXPECT_FALSE(tile(8192));
  EXPECT_FALSE(tile(-1));
}

TEST(ExrHeader, TypesOfOneSizeHaveThatSize) {
  EXPECT_TRUE(fits("box2i", std::string(16, 'x')));
  EXPECT_FALSE(fits("box2i", std::string(15, 'x')));
  EXPECT_FALSE(fits("box2i", std::string(17, 'x')));
  EXPECT_TRUE(fits("compression", "x"));
  EXPECT_FALSE(fits("compression", ""));
  EXPECT_TRUE(fits("tiledesc", std::string(9, 'x')));
  EXPECT_FALSE(fits("tiledesc", std::string(8, 'x')));
  EXPECT_TRUE(fits("floatvector", std::string(8, 'x')));
  EXPECT_FALSE(fits("floatvector", std::string(7, 'x')));
  EXPECT_FALSE(fits("idmanifest", std::string(8, 'x')));
  EXPECT_TRUE(fits("unheard_of", std::string(7, 'x')));
}

TEST(ExrHeader, ListsEndWhereTheirAttributeEnds) {
  const std::string channel = "R\0"s + std::string(16, 'x');
  EXPECT_TRUE(fits("chlist", channel + channel + '\0'));
  EXPECT_TRUE(fits("chlist", "\0"s));
  EXPECT_FALSE(fits("chlist", channel)) << "read on to what follows";
  EXPECT_FALSE(fits("chlist", channel + '\0' + channel));
  EXPECT_FALSE(fits("chlist", "R\0xxx"s));

  EXPECT_TRUE(fits("preview", "\2\0\0\0\1\0\0\0"s + std::string(8, 'x')));
  EXPECT_FALSE(fits("preview", "\2\0\0\0\2\0\0\0"s + std::string(8, 'x')));
  EXPECT_FALSE(fits("preview", "\0\0\0\x80\0\0\0\x80"s));
  EXPECT_FALSE(fits("preview", "\2\0\0\0"s));

  EXPECT_TRUE(fits("stringvector", "\1\0\0\0a\2\0\0\0bc"s));
  EXPECT_TRUE(fits("stringvector", ""));
  EXPECT_FALSE(fits("stringvector", "\1\0\0\0a\3\0\0\0bc"s));
  EXPECT_FALSE(fits("stringvector", "\xff\xff\xff\xff"s));
}

}  // namespace
}  // namespace norrsken
