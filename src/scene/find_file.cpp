#include "scene/find_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>

#include "base/text.h"

namespace norrsken {
namespace {

std::string joined(const std::string& folder, std::string_view name) {
  const bool open = folder.empty() || folder.back() == '/' || folder == "builtin:";
  return (folder + (open ? "" : "/")).append(name);
}

// `name` below `folder` with its letters in other cases; empty if there is none.
std::string in_other_case(const FileSystem& files, const std::string& folder, std::string_view name) {
  std::string found = name.starts_with('/') ? "/" : "";
  for (const TextPiece& part : split(name, "/")) {
    std::string_view written = part.text;
    const std::vector<std::string> entries = files.list(name.starts_with('/') ? found : joined(folder, found));
    if (written != "." && written != "..") {
      const auto entry = std::ranges::find_if(
          entries, [&part](const std::string& other) { return equal_ignoring_case(other, part.text); });
      if (entry == entries.end()) return {};
      written = *entry;
    }
    found = joined(found, written);
  }
  return found;
}

// What is there in place of a file that is not, as a scene would write it.
std::optional<std::string> nearest(const FileSystem& files, const std::string& name,
                                   const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    if (std::string found = in_other_case(files, folder, name); !found.empty()) return found;
  }
  // The path is of another machine, or the name has another ending.
  const std::string last = name.substr(name.rfind('/') + 1);
  for (const std::string& folder : folders) {
    if (last != name && !last.empty() && files.exists(joined(folder, last))) return last;
  }
  const auto stem = [](const std::string& file) { return file.substr(0, file.rfind('.')); };
  const std::string inside = name.starts_with('/') ? std::string() : folder_of(name);
  for (const std::string& folder : folders) {
    const std::vector<std::string> entries = files.list(joined(folder, inside));
    std::vector<std::string> stems;
    std::ranges::transform(entries, std::back_inserter(stems), stem);
    if (const auto closest = closest_word(stem(last), stems))
      return inside + entries[static_cast<std::size_t>(std::ranges::find(stems, *closest) - stems.begin())];
  }
  return std::nullopt;
}

}  // namespace

std::string find_file(const FileSystem& files, const std::string& name, const std::vector<std::string>& folders,
                      const SourceLocation& named_at, const std::string& origin, Diagnostics& diagnostics) {
  std::string other;
  std::string path = resolve_file(files, name, folders, &other);
  std::string with_slashes = name;
  std::ranges::replace(with_slashes, '\\', '/');
  if (path.empty() && with_slashes != name) {
    path = resolve_file(files, with_slashes, folders, &other);
    if (!path.empty()) diagnostics.note(named_at, "backslashes in paths are read as slashes", "slashes");
  }
  if (!other.empty())
    diagnostics.warning(named_at, fmt::format("{} is {} here, and there is {} too", quoted(name, 200),
                                              quoted(path, 200), quoted(other, 200)));
  if (!path.empty()) return path;
  const bool is_guessed = !is_builtin(name) && !name.empty() && name.find('\0') == std::string::npos;
  const auto near = is_guessed ? nearest(files, with_slashes, folders) : std::nullopt;
  diagnostics.error(named_at,
                    fmt::format("there is no file {}{}{}", quoted(name, 200), origin,
                                near ? fmt::format(", but there is {}", quoted(*near, 200)) : std::string()),
                    accepted_files(name, folders));
  return {};
}

}  // namespace norrsken
