// Files that exist in memory only.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "scene/file_system.h"

namespace norrsken {

/// Path to contents. Knows no disk and no built-in files.
class MemoryFiles : public FileSystem {
 public:
  explicit MemoryFiles(std::map<std::string, std::string> files = {}) {
    for (auto& [path, contents] : files) add(path, std::move(contents));
  }

  void add(const std::string& path, std::string contents) { files_[normal_path(path)] = std::move(contents); }

  std::optional<std::string> read(const std::string& path, std::string& error) const override {
    if (const auto found = files_.find(normal_path(path)); found != files_.end()) return found->second;
    error = exists(path) ? "is a folder" : "no such file";
    return std::nullopt;
  }

  bool is_disk() const override { return false; }

  std::uint64_t size(const std::string& path) const override {
    const auto found = files_.find(normal_path(path));
    return found != files_.end() ? found->second.size() : 0;
  }

  bool exists(const std::string& path) const override { return files_.contains(normal_path(path)) || is_folder(path); }

  bool is_folder(const std::string& path) const override {
    std::string folder = normal_path(path);
    if (!folder.ends_with('/')) folder += '/';
    const auto inside = files_.lower_bound(folder);
    return inside != files_.end() && inside->first.starts_with(folder);
  }

  std::vector<std::string> list(const std::string& folder) const override {
    std::string start = folder.empty() ? "" : normal_path(folder);
    if (!start.empty() && !start.ends_with('/')) start += '/';
    std::vector<std::string> names;
    for (const auto& [path, contents] : files_) {
      if (!path.starts_with(start)) continue;
      const std::string name = path.substr(start.size(), path.find('/', start.size()) - start.size());
      if (names.empty() || names.back() != name) names.push_back(name);
    }
    return names;
  }

 private:
  std::map<std::string, std::string> files_;
};

}  // namespace norrsken
