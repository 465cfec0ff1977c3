// What a scene was read from: its own file, includes, meshes, textures and tables.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/file_system.h"

namespace norrsken {

/// Files, and a record of those that were read. Any number of threads may read.
class RecordedFiles : public FileSystem {
 public:
  /// Of the disk.
  RecordedFiles() : RecordedFiles(std::make_unique<FileSystem>()) {}
  explicit RecordedFiles(std::unique_ptr<const FileSystem> files) : files_(std::move(files)) {}

  std::optional<std::string> read(const std::string& path, std::string& error) const override;
  std::uint64_t size(const std::string& path) const override { return files_->size(path); }
  bool exists(const std::string& path) const override { return files_->exists(path); }
  bool is_folder(const std::string& path) const override { return files_->is_folder(path); }
  std::vector<std::string> list(const std::string& folder) const override { return files_->list(folder); }
  bool is_disk() const override { return files_->is_disk(); }

  /// Those on the disk, by their names, each once.
  std::vector<std::string> paths() const;
  /// Of the contents of all that was read, whatever their names and order.
  std::string fingerprint() const;

 private:
  std::unique_ptr<const FileSystem> files_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::uint64_t> checksums_;  ///< by path
};

}  // namespace norrsken
