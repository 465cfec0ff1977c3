#include "json.h"

#include <nlohmann/json.hpp>

namespace norrsken::cli {
namespace {

template <class T>
std::string text_of(const T& value) {
  return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Json::Json(double value) : text_(text_of(value)) {}

Json::Json(std::string_view value) : text_(text_of(value)) {}

Json::Json(std::initializer_list<Member> members) : text_("{}") {
  for (const Member& member : members) add(member.name, member.value);
}

void Json::add(std::string_view name, const Json& value) { append(text_of(name) + ":", value); }

void Json::append(const std::string& prefix, const Json& value) {
  const char last = text_.back();
  text_.pop_back();
  if (text_.size() > 1) text_ += ',';
  text_ += prefix + value.text_ + last;
}

}  // namespace norrsken::cli
