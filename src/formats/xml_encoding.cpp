#include "formats/xml_encoding.h"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/text.h"
#include "scene/source_text.h"

namespace norrsken {
namespace {

constexpr const char* kAccepted =
    "UTF-8, UTF-16, UTF-32, or what a first line <?xml version=\"1.0\" encoding=\"...\"?> names, such as ISO-8859-1";

// Bytes 0x80 to 0x9f of windows-1252. Source: WHATWG, Encoding Standard.
constexpr char32_t kWindows1252[32] = {0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                       0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0x008D, 0x017D, 0x008F,
                                       0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                       0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178};

unsigned char byte_at(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }

void append_utf8(std::string& text, char32_t c) {
  const auto put = [&text](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | (c >> 6)), put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | (c >> 12)), put(0x80 | ((c >> 6) & 0x3F)), put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | (c >> 18)), put(0x80 | ((c >> 12) & 0x3F)), put(0x80 | ((c >> 6) & 0x3F)), put(0x80 | (c & 0x3F));
  }
}

constexpr std::string_view kWide[] = {"UTF-16", "UTF-32", "UCS", "ISO-10646"};

enum class ByteOrder { big, little };

// Empty if a character is cut off or half of a pair is missing.
std::optional<std::string> utf8_of_utf16(std::string_view bytes, ByteOrder order) {
  if (bytes.size() % 2 != 0) return std::nullopt;
  const auto unit = [&](std::size_t at) -> char32_t {
    const char32_t first = byte_at(bytes, at), second = byte_at(bytes, at + 1);
    return order == ByteOrder::big ? first << 8 | second : second << 8 | first;
  };
  std::string text;
  text.reserve(bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += 2) {
    char32_t c = unit(at);
    if (c >= 0xD800 && c < 0xE000) {
      if (c >= 0xDC00 || at + 2 == bytes.size()) return std::nullopt;
      const char32_t low = unit(at += 2);
      if (low < 0xDC00 || low >= 0xE000) return std::nullopt;
      c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
    }
    append_utf8(text, c);
  }
  return text;
}

// Empty if a character is cut off or is none.
std::optional<std::string> utf8_of_utf32(std::string_view bytes, ByteOrder order) {
  if (bytes.size() % 4 != 0) return std::nullopt;
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 4) {
    char32_t c = 0;
    for (std::size_t i = 0; i < 4; ++i) c = c << 8 | byte_at(bytes, at + (order == ByteOrder::big ? i : 3 - i));
    if (c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) return std::nullopt;
    append_utf8(text, c);
  }
  return text;
}

// Through the C library, which knows some hundred encodings. Empty if it does not know this one, or not these bytes.
std::optional<std::string> utf8_of(std::string_view bytes, const std::string& encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding.c_str());
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  std::string input(bytes), text;
  char* from = input.data();
  std::size_t left = input.size();
  std::array<char, 4096> buffer;
  bool good = true;
  for (bool flushed = false; good && !flushed;) {
    flushed = left == 0;
    char* to = buffer.data();
    std::size_t room = buffer.size();
    const std::size_t status = iconv(converter, flushed ? nullptr : &from, flushed ? nullptr : &left, &to, &room);
    text.append(buffer.data(), buffer.size() - room);
    good = status != static_cast<std::size_t>(-1) || errno == E2BIG;
  }
  iconv_close(converter);
  return good ? std::optional(std::move(text)) : std::nullopt;
}

char32_t in_windows_1252(unsigned char byte) {
  return byte >= 0x80 && byte < 0xA0 ? kWindows1252[byte - 0x80] : char32_t{byte};
}

std::string utf8_of_single_bytes(std::string_view bytes, bool windows_1252) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  for (std::size_t at = 0; at < bytes.size(); ++at)
    append_utf8(text, windows_1252 ? in_windows_1252(byte_at(bytes, at)) : char32_t{byte_at(bytes, at)});
  return text;
}

/// UTF-8 with some bytes of windows-1252 in it, as it comes of pasting into files that nobody looks at as a whole.
std::string with_windows_1252(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size() + bytes.size() / 8);
  while (const auto invalid = find_invalid_utf8(bytes)) {
    text += bytes.substr(0, *invalid);
    append_utf8(text, in_windows_1252(byte_at(bytes, *invalid)));
    bytes.remove_prefix(*invalid + 1);
  }
  return text += bytes;
}

// What <?xml ... encoding="NAME"?> says; empty if it does not.
std::string_view declared_encoding(std::string_view text) {
  if (!text.starts_with("<?xml")) return {};
  const std::string_view declaration = text.substr(0, text.find("?>"));
  std::size_t at = declaration.find("encoding");
  if (declaration.size() == text.size() || at == std::string_view::npos) return {};
  at = declaration.find_first_of("\"'", at);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = declaration.substr(at + 1);
  return rest.substr(0, std::min(rest.find(declaration[at]), rest.size()));
}

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::any_of(names.begin(), names.end(), [name](auto other) { return equal_ignoring_case(name, other); });
}

}  // namespace

bool decode_xml(std::string& contents, const std::string& path, Diagnostics& diagnostics) {
  const std::string_view bytes = contents;
  const SourceText source(path, bytes);
  const auto begins_with = [bytes](std::string_view start) { return bytes.starts_with(start); };
  using namespace std::string_view_literals;
  const auto damaged = [&](const char* encoding) {
    diagnostics.error(source.location(), fmt::format("the file is {}, but damaged or cut off", encoding), kAccepted);
    return false;
  };
  const bool marked_32 = begins_with("\xFF\xFE\0\0"sv) || begins_with("\0\0\xFE\xFF"sv);
  if (marked_32 || begins_with("\0\0\0<"sv) || begins_with("<\0\0\0"sv)) {
    auto text =
        utf8_of_utf32(bytes.substr(marked_32 ? 4 : 0), begins_with("\0"sv) ? ByteOrder::big : ByteOrder::little);
    if (!text) return damaged("UTF-32");
    contents = std::move(*text);
    return true;
  }
  const bool big = begins_with("\xFE\xFF") || begins_with("\0<"sv);
  if (big || begins_with("\xFF\xFE") || begins_with("<\0"sv)) {
    const std::size_t mark = begins_with("<") || begins_with("\0"sv) ? 0 : 2;
    auto text = utf8_of_utf16(bytes.substr(mark), big ? ByteOrder::big : ByteOrder::little);
    if (!text) return damaged("UTF-16");
    contents = std::move(*text);
    return true;
  }
  if (begins_with("\xEF\xBB\xBF")) {
    contents.erase(0, 3);
  } else if (const std::string_view encoding = declared_encoding(bytes); !encoding.empty()) {
    const bool windows = is_one_of(encoding, {"windows-1252", "cp1252", "cp-1252"});
    const bool latin = is_one_of(encoding, {"ISO-8859-1", "ISO8859-1", "ISO_8859-1", "latin1", "latin-1", "l1"});
    // A declared encoding of several bytes a character is a slip: the declaration could not be read in it.
    const bool is_wide = std::ranges::any_of(
        kWide, [&](std::string_view start) { return equal_ignoring_case(encoding.substr(0, start.size()), start); });
    if (windows || latin) {
      contents = utf8_of_single_bytes(bytes, windows);
    } else if (!is_wide) {
      if (auto text = utf8_of(bytes, std::string(encoding))) contents = std::move(*text);
    }
  }
  // Old editors end a file by a byte of their own.
  contents.erase(contents.find_last_not_of("\0\x1A"sv) + 1);
  const auto invalid = find_invalid_utf8(contents);
  if (!invalid) return true;
  // Also where another encoding is declared: most have ASCII in common, and that is read.
  const std::string_view declared = declared_encoding(contents);
  const SourceLocation place = SourceText(path, contents).location(*invalid);
  const std::string message = fmt::format("byte 0x{:02x} is not UTF-8", byte_at(contents, *invalid));
  if (!declared.empty() && !is_one_of(declared, {"UTF-8", "US-ASCII", "ASCII"})) {
    diagnostics.error(place, fmt::format("{}, and the encoding {} is not known", message, quoted(declared)), kAccepted);
    return false;
  }
  diagnostics.warning(place, message + ": such bytes are read as windows-1252", kAccepted);
  contents = with_windows_1252(contents);
  return true;
}

}  // namespace norrsken
