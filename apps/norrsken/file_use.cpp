#include "file_use.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "console.h"

namespace norrsken::cli {
namespace {

namespace fs = std::filesystem;

/// A file; where there is none, the folder that it would be in and its name there.
struct Place {
  dev_t device;
  ino_t inode;
  std::string name;

  friend bool operator==(const Place&, const Place&) = default;
};

/// Where a link leads that leads to nothing yet, in the end.
fs::path follow_links(fs::path path) {
  constexpr int kMostLinks = 40;  // as Linux has it
  std::error_code error;
  for (int links = 0; links < kMostLinks && fs::is_symlink(path, error); ++links) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / next;  // which is `next` if that is absolute
  }
  return path;
}

/// Nothing if there is not even a folder.
std::optional<Place> place_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) return Place{status.st_dev, status.st_ino, {}};
  const fs::path end = follow_links(path);
  const std::string folder = end.has_parent_path() ? end.parent_path().string() : ".";
  if (stat(folder.c_str(), &status) != 0) return std::nullopt;
  return Place{status.st_dev, status.st_ino, end.filename().string()};
}

std::string normal(const std::string& path) { return fs::path(path).lexically_normal().string(); }

}  // namespace

std::vector<FileUse> uses_of(const std::vector<std::string>& paths, const std::string& use) {
  std::vector<FileUse> uses;
  uses.reserve(paths.size());
  for (const std::string& path : paths) uses.push_back({path, use});
  return uses;
}

bool is_same_file(const std::string& a, const std::string& b) {
  const std::optional<Place> place = place_of(a);
  return place && place == place_of(b);
}

std::vector<std::string> without_repetitions(const std::vector<std::string>& paths) {
  std::vector<std::string> result;
  for (const std::string& path : paths) {
    const auto is_it = [&](const std::string& other) {
      // Where folders are links, one spelling may be two files.
      return normal(other) == normal(path) && place_of(other) == place_of(path);
    };
    if (std::ranges::none_of(result, is_it)) result.push_back(path);
  }
  return result;
}

ExitStatus check_written_files(const std::vector<std::string>& written, const std::vector<FileUse>& taken) {
  std::vector<std::pair<FileUse, std::optional<Place>>> known;
  const auto know = [&](FileUse use) {
    const std::optional<Place> place = place_of(use.path);
    if (place) known.emplace_back(std::move(use), place);
  };
  for (const FileUse& use : taken) know(use);
  ExitStatus result = ExitStatus::done;
  for (const std::string& path : written) {
    const std::optional<Place> place = place_of(path);
    const auto found = std::ranges::find_if(known, [&](const auto& other) { return place == other.second; });
    if (found == known.end()) {
      know({path, "another file to be written"});
      continue;
    }
    const auto& [other, use] = found->first;
    const std::string alias = normal(other) == normal(path) ? "" : fmt::format("'{}', ", other);
    print_error(fmt::format("cannot write '{}': it is {}{}", path, alias, use));
    result = ExitStatus::usage;
  }
  return result;
}

}  // namespace norrsken::cli
