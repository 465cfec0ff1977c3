// Why a file is not well-formed XML, in words: a scan over the tags that keeps the stack of open elements.
#include <fmt/format.h>

#include <optional>

#include "base/text.h"
#include "formats/xml_document.h"

namespace norrsken {
namespace {

constexpr std::size_t kNone = std::string_view::npos;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool is_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == ':' ||
         c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
}

class Scan {
 public:
  Scan(const SourceText& source, Diagnostics& diagnostics)
      : source_(source), text_(source.text()), diagnostics_(diagnostics) {}

  // Whether something was found to complain about.
  bool run() {
    while (!complained_ && (at_ = text_.find('<', at_)) != kNone) {
      const std::string_view rest = text_.substr(at_);
      if (rest.starts_with("<!--")) {
        skip("-->", "the comment is never closed", 4);
      } else if (rest.starts_with("<![CDATA[")) {
        skip("]]>", "the CDATA section is never closed", 9);
      } else if (rest.starts_with("<?")) {
        skip("?>", "the processing instruction is never closed", 2);
      } else if (rest.starts_with("<!")) {
        skip(">", "the declaration is never closed", 2);
      } else if (rest.starts_with("</")) {
        closing_tag();
      } else {
        opening_tag();
      }
    }
    if (!complained_ && !open_.empty()) {
      const Open& innermost = open_.back();
      complain(innermost.offset, 1 + innermost.name.size(), fmt::format("<{}> is never closed", innermost.name),
               fmt::format("</{}>", innermost.name));
    }
    return complained_;
  }

 private:
  struct Open {
    std::string_view name;
    std::size_t offset;
  };

  void complain(std::size_t offset, std::size_t length, std::string message, std::string accepted) {
    complained_ = true;
    diagnostics_.error(source_.location(offset, length), std::move(message), std::move(accepted));
  }

  void skip(std::string_view end, std::string_view message, std::size_t opening) {
    const std::size_t found = text_.find(end, at_ + opening);
    if (found == kNone) return complain(at_, opening, std::string(message), std::string(end));
    at_ = found + end.size();
  }

  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }

  char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  std::string_view name() {
    const std::size_t first = at_;
    while (at_ < text_.size() && is_name(text_[at_])) ++at_;
    return text_.substr(first, at_ - first);
  }

  void closing_tag() {
    const std::size_t start = at_;
    at_ += 2;
    const std::string_view closed = name();
    const std::size_t length = at_ - start;
    skip_blanks();
    if (here() != '>')
      return complain(start, length, fmt::format("</{} has no '>'", closed), fmt::format("</{}>", closed));
    ++at_;
    if (open_.empty()) return complain(start, length + 1, fmt::format("</{}> closes nothing", closed), {});
    if (open_.back().name != closed) {
      const Open& innermost = open_.back();
      return complain(start, length + 1,
                      fmt::format("</{}> where <{}> of line {} is open", closed, innermost.name,
                                  source_.location(innermost.offset).line),
                      fmt::format("</{}>", innermost.name));
    }
    open_.pop_back();
  }

  void opening_tag() {
    const std::size_t start = at_++;
    const std::string_view opened = name();
    if (opened.empty()) return complain(start, 1, "'<' without a name", "&lt; for the character itself");
    for (;;) {
      const std::size_t before = at_;
      skip_blanks();
      if (here() == '>') {
        ++at_;
        open_.push_back({opened, start});
        return;
      }
      if (here() == '/' && at_ + 1 < text_.size() && text_[at_ + 1] == '>') {
        at_ += 2;
        return;
      }
      if (here() == '\0' || here() == '<')
        return complain(start, 1 + opened.size(), fmt::format("the tag <{} has no '>'", opened), "'>' or '/>'");
      if (!is_name(here()))
        return complain(at_, 1, fmt::format("unexpected {} in the tag <{}>", quoted(text_.substr(at_, 1)), opened),
                        "name=\"value\", '>' or '/>'");
      if (before == at_) return complain(at_, 1, "no blank between two attributes", "a blank");
      if (!attribute()) return;
    }
  }

  bool attribute() {
    const std::size_t start = at_;
    const std::string_view attribute = name();
    skip_blanks();
    if (here() != '=') {
      complain(start, attribute.size(), fmt::format("attribute '{}' has no value", attribute),
               fmt::format("{}=\"...\"", attribute));
      return false;
    }
    ++at_;
    skip_blanks();
    const char quote = here();
    if (quote != '"' && quote != '\'') {
      complain(start, attribute.size(), fmt::format("the value of attribute '{}' has no quotes", attribute),
               fmt::format("{}=\"...\"", attribute));
      return false;
    }
    const std::size_t opening = at_++;
    at_ = text_.find(quote, at_);
    // XML has no '<' in values: behind a forgotten quote the next tag is swallowed.
    const std::size_t next_tag = text_.find('<', opening);
    if (at_ == kNone || next_tag < at_) {
      complain(opening, 1, fmt::format("the value of attribute '{}' has no closing quote", attribute),
               fmt::format("a closing {}", quote));
      return false;
    }
    ++at_;
    return true;
  }

  const SourceText& source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::size_t at_ = 0;
  std::vector<Open> open_;
  bool complained_ = false;
};

}  // namespace

bool explain_malformed_xml(const SourceText& source, Diagnostics& diagnostics) {
  return Scan(source, diagnostics).run();
}

}  // namespace norrsken
