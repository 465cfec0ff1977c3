#include "base/file_signature.h"

#include <gtest/gtest.h>

namespace norrsken {
namespace {

using namespace std::string_view_literals;

std::string_view what(std::string_view contents) {
  const FileSignature* signature = file_signature(contents);
  return signature == nullptr ? "" : signature->what;
}

TEST(FileSignature, IsTheBeginningOfTheFile) {
  EXPECT_EQ(what("GIF89a"), "a GIF image");
  EXPECT_EQ(what("\0\0\1\0\1\0"sv), "an icon (ICO)");
  EXPECT_EQ(what("x GIF89a"), "");
  EXPECT_EQ(what("GIF"), "");
  EXPECT_EQ(what(""), "");
  EXPECT_EQ(file_signature("\x89PNG\r\n")->kind, FileKind::read_image);
}

TEST(FileSignature, OfContainersIsWhatTheyContain) {
  EXPECT_EQ(what("RIFF\x10\0\0\0WEBPVP8 "sv), "a WebP image");
  EXPECT_EQ(what("RIFF\x10\0\0\0WAVEfmt "sv), "");
  EXPECT_EQ(what("RIFF"), "");
  EXPECT_EQ(what("\0\0\0\x18"
                 "ftypheic"sv),
            "a HEIF or AVIF image");
  EXPECT_EQ(what("\0\0"sv), "");
  EXPECT_EQ(what("<!--ftyp WEBP"), "") << "a text may have the words";
}

}  // namespace
}  // namespace norrsken
