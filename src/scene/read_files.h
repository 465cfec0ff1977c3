// What a scene was read from: its own file, includes, meshes, textures and tables.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "scene/file_system.h"

namespace norrsken {

/// Files, and a record of those that were read. Any number of threads may read.
class RecordedFiles : public FileSystem {
 public:
  std::optional<std::string> read(const std::string& path, std::string& error) const override;

  /// Those on the disk, by their names, each once.
  std::vector<std::string> paths() const;
  /// Of the contents of all that was read, whatever their names and order.
  std::string fingerprint() const;

 private:
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::uint64_t> checksums_;  ///< by path
};

}  // namespace norrsken
