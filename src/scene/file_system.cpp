#include "scene/file_system.h"

#include <fmt/format.h>

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/regular_file.h"
#include "base/text.h"

namespace norrsken {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

std::string builtin_key(const std::string& path) {
  return std::filesystem::path(path.substr(kBuiltin.size())).lexically_normal().generic_string();
}

std::optional<std::string> read_builtin(const std::string& path, std::string& error) {
  const std::string key = builtin_key(path);
  for (const auto& [name, contents] : builtin_files()) {
    if (name == key) return std::string(contents);
  }
  error = "no such built-in file";
  return std::nullopt;
}

}  // namespace

bool is_builtin(std::string_view path) { return path.starts_with(kBuiltin); }

std::optional<std::string> FileSystem::read(const std::string& path, std::string& error) const {
  if (is_builtin(path)) return read_builtin(path, error);
  return read_regular_file(path, error);
}

std::uint64_t FileSystem::size(const std::string& path) const {
  if (is_builtin(path)) return 0;  // part of the program
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) ? static_cast<std::uint64_t>(status.st_size) : 0;
}

bool FileSystem::exists(const std::string& path) const {
  if (!is_builtin(path)) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
  }
  const std::string key = builtin_key(path);
  const auto named = [&key](const auto& file) { return file.first == key; };
  const auto files = builtin_files();
  return std::any_of(files.begin(), files.end(), named) || is_folder(path);
}

bool FileSystem::is_folder(const std::string& path) const {
  if (!is_builtin(path)) {
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored);
  }
  std::string key = builtin_key(path);
  if (key == "." || key.empty()) return true;
  if (!key.ends_with('/')) key += '/';
  const auto inside = [&key](const auto& file) { return file.first.starts_with(key); };
  const auto files = builtin_files();
  return std::any_of(files.begin(), files.end(), inside);
}

std::vector<std::string> FileSystem::list(const std::string& folder) const {
  constexpr std::size_t kMost = 100000;
  std::vector<std::string> names;
  if (is_builtin(folder)) return names;  // `accepted_files` has them all
  std::error_code error;
  std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, error), end;
  for (; !error && entry != end && names.size() < kMost; entry.increment(error))
    names.push_back(entry->path().filename().string());
  std::ranges::sort(names);
  return names;
}

std::optional<FileContents> read_counted(const FileSystem& files, const std::string& path, std::string& error) {
  // Larger ones are refused by what they are.
  FileContents contents{MemoryReservation(std::min<std::uint64_t>(files.size(path), kMaxFileBytes)), {}};
  auto bytes = files.read(path, error);
  if (!bytes) return std::nullopt;
  contents.bytes = std::move(*bytes);
  // Files of /proc have more than they say.
  if (contents.bytes.size() > contents.memory.bytes())
    contents.memory.grow(contents.bytes.size() - contents.memory.bytes());
  return contents;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash != std::string::npos) return path.substr(0, slash + 1);
  return is_builtin(path) ? std::string(kBuiltin) : std::string();
}

std::string normal_path(const std::string& path) {
  if (is_builtin(path)) return std::string(kBuiltin) + builtin_key(path);
  return std::filesystem::path(path).lexically_normal().string();
}

std::string resolve_file(const FileSystem& files, const std::string& name, const std::vector<std::string>& folders,
                         std::string* other) {
  if (name.empty() || name.find('\0') != std::string::npos) return {};
  if (name.front() == '/' || is_builtin(name)) return files.exists(name) ? name : std::string();
  std::string found;
  for (const std::string& folder : folders) {
    const bool open = folder.empty() || folder.back() == '/' || folder == kBuiltin;
    const std::string path = folder + (open ? "" : "/") + name;
    if (!files.exists(path)) continue;
    if (found.empty()) {
      found = path;
      if (!other) break;
    } else if (normal_path(path) != normal_path(found)) {
      *other = path;
      break;
    }
  }
  return found;
}

std::string accepted_files(const std::string& name, const std::vector<std::string>& all_folders) {
  constexpr std::size_t kMaxPathBytes = 200;
  const auto builtin_below = [](const std::string& folder, std::size_t strip) {
    std::vector<std::string> found;
    for (const auto& [path, contents] : builtin_files()) {
      const std::string full = std::string(kBuiltin).append(path);
      if (full.starts_with(folder)) found.push_back(full.substr(strip));
    }
    return listed(found, kMaxPathBytes);
  };
  if (is_builtin(name)) return builtin_below(std::string(kBuiltin), 0);
  if (name.starts_with('/')) return "the path of an existing file";
  std::vector<std::string> folders;
  for (const std::string& folder : all_folders) {
    if (std::find(folders.begin(), folders.end(), folder) == folders.end()) folders.push_back(folder);
  }
  std::string builtin;
  for (std::string& folder : folders) {
    if (is_builtin(folder) && builtin.empty()) builtin = builtin_below(folder, folder.size());
    if (folder.empty()) folder = "the current folder";
  }
  return "a file in " + listed(folders, kMaxPathBytes) + (builtin.empty() ? "" : " (" + builtin + ")");
}

}  // namespace norrsken
