#include "formats/mitsuba_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.h"

namespace norrsken {
namespace {

// Defaults can be made of defaults: ten lines that double each other ten times are a thousandfold.
constexpr std::size_t kMaxValueBytes = std::size_t{64} << 10;
constexpr std::size_t kMaxTotalBytes = std::size_t{64} << 20;

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

SceneParameters::SceneParameters(const Values& overrides, Values preferred, Diagnostics& diagnostics)
    : preferred_(std::move(preferred)), diagnostics_(diagnostics) {
  for (const auto& [name, value] : overrides) {
    bool created = false;
    Entry& entry = entries_[entry_of(name, created)];
    entry.value = value;
    entry.set_by = "-D" + name + "=" + value;
    entry.overridden = true;
  }
}

bool SceneParameters::is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_name_character);
}

std::size_t SceneParameters::entry_of(const std::string& name, bool& created) {
  const auto [place, is_new] = index_.try_emplace(name, entries_.size());
  if (is_new) entries_.push_back({name, {}});
  created = is_new;
  return place->second;
}

void SceneParameters::mark_defined(std::size_t index) {
  if (!entries_[index].defined) order_.push_back(index);
  entries_[index].defined = true;
}

void SceneParameters::define(const std::string& name, const std::string& value, std::string_view raw) {
  bool created = false;
  const std::size_t index = entry_of(name, created);
  if (created) {
    const auto preferred = std::ranges::find(preferred_, name, &Values::value_type::first);
    const bool is_preferred = preferred != preferred_.end();
    entries_[index].value = is_preferred ? preferred->second : value;
    entries_[index].set_by = is_preferred ? "-D" + name + "=" + preferred->second : set_by(raw);
  }
  mark_defined(index);
}

std::string SceneParameters::set_by(std::string_view raw) const {
  for (std::size_t dollar = raw.find('$'); dollar != std::string_view::npos; dollar = raw.find('$', dollar + 1)) {
    const std::string_view rest = raw.substr(dollar + 1);
    const auto end = std::find_if_not(rest.begin(), rest.end(), is_name_character);
    const auto entry = index_.find(std::string(rest.begin(), end));
    if (entry != index_.end() && !entries_[entry->second].set_by.empty()) return entries_[entry->second].set_by;
  }
  return {};
}

bool SceneParameters::fill_in(std::string& text, const SourceLocation& location) {
  std::size_t dollar = text.find('$');
  if (dollar == std::string::npos) return true;
  std::string result;
  std::size_t at = 0;
  for (; dollar != std::string::npos; dollar = text.find('$', at)) {
    result.append(text, at, dollar - at);
    at = dollar + 1;
    while (at < text.size() && is_name_character(text[at])) ++at;
    const std::string name = text.substr(dollar + 1, at - dollar - 1);
    if (name.empty()) {
      diagnostics_.error(location, "'$' without the name of a parameter", "$ and letters, digits or _");
      return false;
    }
    const auto found = index_.find(name);
    if (found == index_.end()) {
      std::vector<std::string> defined;
      for (const Entry& known : entries_) defined.push_back("$" + known.name);
      diagnostics_.error(location,
                         fmt::format("undefined parameter {}{}", quoted("$" + name), did_you_mean("$" + name, defined)),
                         defined.empty() ? "a <default> before its use, or -D" + name + "=..." : listed(defined));
      return false;
    }
    mark_defined(found->second);
    Entry& entry = entries_[found->second];
    entry.used = true;
    result += entry.value;
    filled_in_bytes_ += entry.value.size();
    if (result.size() > kMaxValueBytes || filled_in_bytes_ > kMaxTotalBytes) {
      diagnostics_.error(location, "the parameters make this value too long",
                         fmt::format("up to {} KiB, and {} MiB in all", kMaxValueBytes >> 10, kMaxTotalBytes >> 20));
      return false;
    }
  }
  text = result.append(text, at);
  return true;
}

void SceneParameters::finish() const {
  std::vector<std::string> used;
  for (const Entry& entry : entries_) {
    if (entry.used) used.push_back(entry.name);
  }
  for (const Entry& entry : entries_) {
    if (!entry.overridden || entry.used) continue;
    diagnostics_.error({},
                       fmt::format("-D{}: the scene does not use a parameter {}{}", entry.name,
                                   quoted("$" + entry.name), did_you_mean(entry.name, used)),
                       used.empty() ? "no -D: the scene has no parameters" : listed(used));
  }
}

std::vector<std::pair<std::string, std::string>> SceneParameters::values() const {
  std::vector<std::pair<std::string, std::string>> result;
  for (const std::size_t index : order_) {
    if (entries_[index].used) result.emplace_back(entries_[index].name, entries_[index].value);
  }
  return result;
}

}  // namespace norrsken
