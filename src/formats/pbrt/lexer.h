// The words of pbrt's language.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "formats/pbrt/source.h"
#include "norrsken/diagnostics.h"

namespace norrsken::pbrt {

struct Token {
  enum class Kind { word, string, open, close };  ///< close: "]"
  Kind kind = Kind::word;
  std::string_view text;  ///< as it is written, with quotes
  std::string value;      ///< of a string: without quotes, with its escapes resolved
  Place place;
};

class Lexer {
 public:
  Lexer(const Source& source, Diagnostics& diagnostics)
      : source_(source), text_(source.text().text()), diagnostics_(diagnostics) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  /// The next token, which stays the next one; null at the end. Strings that are malformed are complained about and read
  /// as well as they can be.
  const Token* peek();
  /// The same, and goes on behind it.
  std::optional<Token> take();
  /// Whether a string was malformed: what follows may be anything.
  bool is_broken() const { return broken_; }
  /// Behind the last token that was taken.
  Place end() const { return {&source_, end_, 1}; }

 private:
  void skip_blanks();
  Token read();
  Token read_string(std::size_t start);

  const Source& source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0, end_ = 0;
  std::optional<Token> next_;
  bool broken_ = false;
};

}  // namespace norrsken::pbrt
