#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "base/numbers.h"
#include "base/text.h"
#include "formats/pbrt/parameters.h"

namespace norrsken::pbrt {
namespace {

enum class Values { numbers, integers, booleans, strings, numbers_or_string };

struct Type {
  std::string_view name;
  Values values;
  std::size_t per_item;  ///< numbers of one value
  std::string_view today = {};
};
constexpr Type kTypes[] = {
    {"bool", Values::booleans, 1},
    {"integer", Values::integers, 1},
    {"float", Values::numbers, 1},
    {"point2", Values::numbers, 2},
    {"vector2", Values::numbers, 2},
    {"point3", Values::numbers, 3},
    {"vector3", Values::numbers, 3},
    {"normal", Values::numbers, 3},
    {"string", Values::strings, 1},
    {"texture", Values::strings, 1},
    {"rgb", Values::numbers, 3},
    {"blackbody", Values::numbers, 1},
    {"spectrum", Values::numbers_or_string, 2},
    // Of version 3.
    {"point", Values::numbers, 3, "point3"},
    {"vector", Values::numbers, 3, "vector3"},
    {"color", Values::numbers, 3, "rgb"},
};

class ParameterReader {
 public:
  ParameterReader(Lexer& lexer, Diagnostics& diagnostics) : lexer_(lexer), diagnostics_(diagnostics) {}

  /// Null after a complaint; the values are read over in any case.
  std::shared_ptr<const Parameter> read() {
    const Token declaration = *lexer_.take();
    auto parameter = std::allocate_shared<Parameter>(CountedAllocator<Parameter>());
    parameter->place = declaration.place;
    const Type* type = declare(declaration, *parameter);
    const Token* next = lexer_.peek();
    parameter->value = next ? next->place : lexer_.end();
    if (next && next->kind == Token::Kind::open) {
      lexer_.take();
      for (next = lexer_.peek(); next && is_value(*next); next = lexer_.peek()) read_value(type, *parameter);
      if (!next || next->kind != Token::Kind::close) {
        fail(next ? next->place : lexer_.end(), fmt::format("the list of {} does not end", quoted(declaration.value)),
             "]");
      } else {
        lexer_.take();
      }
    } else if (next && is_value(*next)) {
      read_value(type, *parameter);
    } else {
      fail(parameter->value, fmt::format("{} has no value", quoted(declaration.value)), "a value, or a list in [ ]");
    }
    if (!type || !good_) return nullptr;
    const bool is_text = !parameter->strings.empty();
    if (is_text ? type->values == Values::numbers_or_string && parameter->strings.size() > 1
                : parameter->numbers.size() % type->per_item != 0) {
      fail(parameter->value,
           fmt::format("{} has {} values", quoted(declaration.value),
                       parameter->numbers.size() + parameter->strings.size()),
           is_text ? "a name, or pairs of numbers" : fmt::format("{} numbers for each", type->per_item));
      return nullptr;
    }
    return parameter;
  }

 private:
  void fail(const Place& place, std::string message, std::string accepted) {
    good_ = false;
    diagnostics_.error(place.location(), std::move(message), std::move(accepted));
  }

  static bool is_value(const Token& token) {
    return token.kind == Token::Kind::word || token.kind == Token::Kind::string;
  }

  /// Reads "type name". Null after a complaint.
  const Type* declare(const Token& declaration, Parameter& parameter) {
    const std::vector<TextPiece> words = split(declaration.value, " \t");
    if (words.size() != 2) {
      fail(declaration.place, fmt::format("{} declares no parameter", quoted(declaration.value)),
           R"(a type and a name, as in "float radius")");
      return nullptr;
    }
    parameter.name = words[1].text;
    const auto* type = std::ranges::find(kTypes, words[0].text, &Type::name);
    if (type == std::end(kTypes)) {
      std::vector<std::string> known;
      for (const Type& each : kTypes) {
        if (each.today.empty()) known.emplace_back(each.name);
      }
      fail(declaration.place,
           fmt::format("unknown type {} of a parameter{}", quoted(words[0].text), did_you_mean(words[0].text, known)),
           join(known));
      return nullptr;
    }
    parameter.type = type->today.empty() ? type->name : type->today;
    if (!type->today.empty())
      diagnostics_.note(
          declaration.place.location(),
          fmt::format("parameters of type '{}', of pbrt's version 3, are read as '{}'", type->name, type->today));
    return type;
  }

  void read_value(const Type* type, Parameter& parameter) {
    const Token token = *lexer_.take();
    if (!type || !good_) return;
    const bool is_string = token.kind == Token::Kind::string;
    const auto refuse = [&](std::string_view accepted) {
      fail(token.place,
           fmt::format("{} is no value of '{} {}'",
                       token.text.size() > 60 ? shortened(token.text) : std::string(token.text), type->name,
                       parameter.name),
           std::string(accepted));
    };
    switch (type->values) {
      case Values::strings:
        if (!is_string) return refuse("a string in quotes");
        parameter.strings.push_back(token.value);
        return;
      case Values::booleans: {
        const std::string_view word = is_string ? std::string_view(token.value) : token.text;
        if (word != "true" && word != "false") return refuse("true or false, without quotes");
        if (is_string)
          diagnostics_.note(token.place.location(), "booleans in quotes, of pbrt's version 3, are read without them");
        parameter.numbers.push_back(word == "true" ? 1 : 0);
        return;
      }
      case Values::numbers_or_string:
        if (is_string) {
          parameter.strings.push_back(token.value);
          return;
        }
        break;
      case Values::integers: {
        std::int64_t value = 0;
        if (is_string || parse_integer(token.text, value) != NumberStatus::ok ||
            value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::int32_t>::max())
          return refuse("a whole number of 32 bits");
        parameter.numbers.push_back(static_cast<double>(value));
        return;
      }
      case Values::numbers:
        break;
    }
    double value = 0;
    if (is_string || parse_number(token.text, value) != NumberStatus::ok) return refuse("a number");
    parameter.numbers.push_back(value);
  }

  Lexer& lexer_;
  Diagnostics& diagnostics_;
  bool good_ = true;
};

}  // namespace

SharedParameters read_parameters(Lexer& lexer, Diagnostics& diagnostics) {
  SharedParameters parameters;
  for (const Token* next = lexer.peek(); next && next->kind == Token::Kind::string && !lexer.is_broken();
       next = lexer.peek()) {
    if (auto parameter = ParameterReader(lexer, diagnostics).read()) parameters.push_back(std::move(parameter));
  }
  return parameters;
}

}  // namespace norrsken::pbrt
