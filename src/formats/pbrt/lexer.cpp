#include "formats/pbrt/lexer.h"

#include <utility>

#include "base/text.h"

namespace norrsken::pbrt {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kEndOfWord = " \t\r\n\"[]";
constexpr std::string_view kEscapes = "bfnrt\\'\"", kEscaped = "\b\f\n\r\t\\'\"";

}  // namespace

void Lexer::skip_blanks() {
  for (;;) {
    at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
    if (at_ == text_.size() || text_[at_] != '#') return;
    at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
  }
}

const Token* Lexer::peek() {
  if (!next_) {
    skip_blanks();
    if (at_ == text_.size()) return nullptr;
    next_ = read();
  }
  return &*next_;
}

std::optional<Token> Lexer::take() {
  if (!peek()) return std::nullopt;
  end_ = next_->place.offset + next_->place.length;
  return std::exchange(next_, std::nullopt);
}

Token Lexer::read() {
  const std::size_t start = at_;
  const char first = text_[start];
  if (first == '"') return read_string(start);
  Token token;
  if (first == '[' || first == ']') {
    token.kind = first == '[' ? Token::Kind::open : Token::Kind::close;
    at_ = start + 1;
  } else {
    at_ = std::min(text_.find_first_of(kEndOfWord, start), text_.size());
  }
  token.text = text_.substr(start, at_ - start);
  token.place = {&source_, start, at_ - start};
  return token;
}

Token Lexer::read_string(std::size_t start) {
  Token token;
  token.kind = Token::Kind::string;
  std::size_t at = start + 1;
  for (;; ++at) {
    if (at == text_.size() || text_[at] == '\n' || text_[at] == '\r') {
      if (!std::exchange(broken_, true))
        diagnostics_.error(Place{&source_, start, at - start}.location(), "the string does not end in its line",
                           "a string between two quotes, a line break in it written as \\n");
      break;
    }
    if (text_[at] == '"') {
      ++at;
      break;
    }
    if (text_[at] != '\\') {
      token.value += text_[at];
      continue;
    }
    const std::size_t escape = at + 1 < text_.size() ? kEscapes.find(text_[at + 1]) : std::string_view::npos;
    if (escape == std::string_view::npos) {
      diagnostics_.error(Place{&source_, at, 2}.location(),
                         "unknown escape " + quoted(text_.substr(at, 2)) + " in a string",
                         R"(\b, \f, \n, \r, \t, \\, \', \")");
      continue;
    }
    token.value += kEscaped[escape];
    ++at;
  }
  at_ = at;
  token.text = text_.substr(start, at - start);
  token.place = {&source_, start, at - start};
  return token;
}

}  // namespace norrsken::pbrt
