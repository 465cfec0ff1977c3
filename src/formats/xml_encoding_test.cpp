// Scenes in other encodings than UTF-8.
#include "formats/xml_encoding.h"

#include <gtest/gtest.h>

#include "formats/reader_testing.h"

namespace norrsken {
namespace {

enum class Order { big, little };

// The text as UTF-16, without a mark; it may hold characters beyond the first 65536.
std::string utf16(const std::u16string& text, Order order) {
  std::string bytes;
  for (const char16_t unit : text) {
    const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFF);
    bytes += order == Order::big ? high : low;
    bytes += order == Order::big ? low : high;
  }
  return bytes;
}

std::string decoded(std::string bytes) {
  Diagnostics diagnostics;
  if (!decode_xml(bytes, "room.xml", diagnostics)) return "error: " + diagnostics.all().at(0).message;
  EXPECT_EQ(to_text(diagnostics), "");
  return bytes;
}

// An element in an encoding as it is declared.
std::string with(const std::string& encoding, const std::string& text) {
  return "<?xml version=\"1.0\" encoding=\"" + encoding + "\"?><a b='" + text + "'/>";
}

const std::string kMarkBig = "\xFE\xFF", kMarkLittle = "\xFF\xFE";

TEST(XmlEncoding, Utf16WithAndWithoutAMark) {
  const std::u16string text = u"<?xml version='1.0'?><a b='\u00e9\u20ac\U0001F600'/>";
  const std::string expected = "<?xml version='1.0'?><a b='\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80'/>";
  EXPECT_EQ(decoded(utf16(text, Order::big)), expected);
  EXPECT_EQ(decoded(utf16(text, Order::little)), expected);
  EXPECT_EQ(decoded(kMarkBig + utf16(text, Order::big)), expected);
  EXPECT_EQ(decoded(kMarkLittle + utf16(text, Order::little)), expected);
}

TEST(XmlEncoding, BrokenUtf16) {
  const std::string damaged = "error: the file is UTF-16, but damaged or cut off";
  EXPECT_EQ(decoded(kMarkLittle + "<"), damaged);
  for (const std::u16string text : {u"<\xD800", u"<\xD800x", u"<\xDC00\xD800"})
    EXPECT_EQ(decoded(kMarkBig + utf16(text, Order::big)), damaged);
}

TEST(XmlEncoding, SingleBytesAsTheyAreDeclared) {
  for (const char* name : {"ISO-8859-1", "iso-8859-1", "latin1"})
    EXPECT_EQ(decoded(with(name, "caf\xE9 \xA4")), with(name, "caf\xC3\xA9 \xC2\xA4"));
  EXPECT_EQ(decoded(with("windows-1252", "\x80\x93\xFF")), with("windows-1252", "\xE2\x82\xAC\xE2\x80\x9C\xC3\xBF"));
  EXPECT_EQ(decoded("<?xml version='1.0' encoding = 'Latin1' ?>\xE9"),
            "<?xml version='1.0' encoding = 'Latin1' ?>\xC3\xA9");
  // Declared as one thing, saved as another: what is UTF-8 is read.
  EXPECT_EQ(decoded(with("utf-16", "\xC3\xA9")), with("utf-16", "\xC3\xA9"));
  EXPECT_EQ(decoded(with("Shift_JIS", "abc")), with("Shift_JIS", "abc"));
  EXPECT_EQ(decoded("\xEF\xBB\xBF" + with("ISO-8859-1", "\xC3\xA9")), with("ISO-8859-1", "\xC3\xA9"))
      << "the mark wins";
}

TEST(XmlEncoding, TheCLibraryKnowsMany) {
  EXPECT_EQ(decoded(with("ISO-8859-15", "\xA4")), with("ISO-8859-15", "\xE2\x82\xAC"));
  EXPECT_EQ(decoded(with("Shift_JIS", "\x83\x65\x83\x58")), with("Shift_JIS", "\xE3\x83\x86\xE3\x82\xB9"));
  EXPECT_EQ(decoded(with("GBK", "\xD6\xD0")), with("GBK", "\xE4\xB8\xAD"));
  EXPECT_EQ(decoded(with("ISO-8859-15", std::string(10000, '\xE9'))).size(), with("ISO-8859-15", "").size() + 20000);
  // Half of a character.
  EXPECT_EQ(decoded(with("Shift_JIS", "\x83")).substr(0, 29), "error: byte 0x83 is not UTF-8");
}

TEST(XmlEncoding, Utf32) {
  const auto utf32 = [](std::u32string_view text, Order order) {
    std::string bytes;
    for (const char32_t c : text) {
      for (int i = 0; i < 4; ++i) bytes += static_cast<char>(c >> 8 * (order == Order::big ? 3 - i : i) & 255u);
    }
    return bytes;
  };
  for (const Order order : {Order::big, Order::little}) {
    EXPECT_EQ(decoded(utf32(U"\xFEFF<a b='\xE9\x1F600'/>", order)), "<a b='\xC3\xA9\xF0\x9F\x98\x80'/>");
    EXPECT_EQ(decoded(utf32(U"<a/>", order)), "<a/>");
    EXPECT_EQ(decoded(utf32(U"<a/>", order) + "x"), "error: the file is UTF-32, but damaged or cut off");
    EXPECT_EQ(decoded(utf32(U"<a\x110000", order)), "error: the file is UTF-32, but damaged or cut off");
  }
}

TEST(XmlEncoding, OthersAreRefusedAtTheirFirstByte) {
  EXPECT_EQ(
      complaints_about("<?xml version=\"1.0\" encoding=\"Klingon\"?>\n<scene version=\"3.0.0\" a=\"\x83\x65\"/>"),
      "room.xml:2:27: error: byte 0x83 is not UTF-8, and the encoding 'Klingon' is not known\n"
      "    2 | <scene version=\"3.0.0\" a=\"\xEF\xBF\xBD"
      "e\"/>\n"
      "      |                           ^\n"
      "accepted: UTF-8, UTF-16, UTF-32, or what a first line <?xml version=\"1.0\" encoding=\"...\"?> names, such as "
      "ISO-8859-1");
  EXPECT_EQ(decoded("<?xml encoding='ISO-8859-1'"), "<?xml encoding='ISO-8859-1'");
}

TEST(XmlEncoding, StrayBytesAreWindows1252) {
  Diagnostics diagnostics;
  std::string text = "<!-- caf\xE9 \x80 caf\xC3\xA9 -->\n<a/>";
  EXPECT_TRUE(decode_xml(text, "room.xml", diagnostics));
  EXPECT_EQ(text, "<!-- caf\xC3\xA9 \xE2\x82\xAC caf\xC3\xA9 -->\n<a/>");
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].message, "byte 0xe9 is not UTF-8: such bytes are read as windows-1252");
  EXPECT_EQ(diagnostics.all()[0].severity, Diagnostic::Severity::warning);
}

TEST(XmlEncoding, BytesThatEndAFileAreNoText) {
  EXPECT_EQ(decoded(std::string("<a/>\n\x1A\0\0", 8)), "<a/>\n");
  EXPECT_EQ(decoded(""), "");
}

TEST(XmlEncoding, PlacesAreThoseOfTheText) {
  const std::u16string text = u"<scene version=\"3.0.0\">\n  <string name=\"\u00e9\" value=\"\"/><bsfd/>\n</scene>";
  const std::string expected =
      "room.xml:2:31: error: unknown element 'bsfd', did you mean 'bsdf'?\n"
      "    2 |   <string name=\"\xC3\xA9\" value=\"\"/><bsfd/>\n"
      "      |                              ^~~~~\n";
  for (const Order order : {Order::big, Order::little})
    EXPECT_EQ(complaints_about(utf16(text, order)).substr(0, expected.size()), expected);
}

TEST(XmlEncoding, AWholeSceneInUtf16) {
  Diagnostics diagnostics;
  const auto scene = read_scene(utf16(u"<scene version=\"3.0.0\"><shape type=\"obj\"><string name=\"filename\" "
                                      u"value=\"\u00e9.obj\"/></shape></scene>",
                                      Order::little),
                                {}, diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  EXPECT_EQ(std::get<std::string>(scene->scene->children.at(0).node->properties.at(0).value), "\xC3\xA9.obj");
}

}  // namespace
}  // namespace norrsken
