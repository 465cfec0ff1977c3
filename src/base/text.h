// Small text helpers that complaints are made of: suggestions, lists, quotations, UTF-8.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace norrsken {

/// Without blanks (space, tab, line breaks) at both ends.
std::string_view trim(std::string_view text);

/// A piece of a text, and where in the text it begins.
struct TextPiece {
  std::string_view text;
  std::size_t offset;
};
/// The pieces between any number of `separators`; none is empty.
std::vector<TextPiece> split(std::string_view text, std::string_view separators);

/// "a shape", "an emitter".
std::string with_article(std::string_view noun);

/// `words` with `separator` between them.
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

/// Whether the two differ at most in the case of ASCII letters.
bool equal_ignoring_case(std::string_view a, std::string_view b);

/// Optimal string alignment distance: insertions, deletions, substitutions and swaps of neighbours, each 1
/// (Damerau 1964). Compares ASCII letters without case.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word nearest to `word` if it is near enough to be a typing error: at most a third of its length away.
/// The first of equals wins.
std::optional<std::string> closest_word(std::string_view word, const std::vector<std::string>& words);

/// ", did you mean 'WORD'?" or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& words);

/// `text`, cut to about `max_bytes` with "..." in the place of what is left out; never cuts a UTF-8 character.
std::string shortened(std::string_view text, std::size_t max_bytes = 60);

/// The same in single quotes.
std::string quoted(std::string_view text, std::size_t max_bytes = 60);

/// The first twenty of `words`, each cut to `max_bytes`: for lists as long as a file makes them.
std::string listed(const std::vector<std::string>& words, std::size_t max_bytes = 60);

/// Bytes of the UTF-8 character that begins at `text[at]`, 0 if it is malformed (RFC 3629: no overlong forms, no
/// surrogates, nothing above U+10FFFF). `at` must be below the size.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// Offset of the first byte that is not UTF-8.
std::optional<std::size_t> find_invalid_utf8(std::string_view text);

/// Columns that the character at `text[at]` of `length` bytes takes on a terminal: 0 for combining marks, 2 for East
/// Asian wide characters and emoji, otherwise 1 (the broad ranges of Unicode's EastAsianWidth.txt).
int display_width(std::string_view text, std::size_t at, std::size_t length);

/// `text` with control characters and malformed UTF-8 replaced by U+FFFD, so that a terminal shows it and does not
/// obey it.
std::string printable(std::string_view text);

}  // namespace norrsken
