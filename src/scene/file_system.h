// Where scene files and what they name are read from: the disk, or the scenes built into the program.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/memory.h"

namespace norrsken {

/// Read-only access to files by path. A path that begins with `builtin:` means a file compiled into the program.
class FileSystem {
 public:
  virtual ~FileSystem() = default;
  /// The whole file, or empty with `error` set ("no such file", "is a folder", "is not a regular file", ...).
  /// Devices, pipes and folders are refused, never waited for; so are files above 4 GiB.
  virtual std::optional<std::string> read(const std::string& path, std::string& error) const;
  /// Bytes of the file; 0 if there is none, or if it does not say.
  virtual std::uint64_t size(const std::string& path) const;
  /// Whether there is a file or a folder of that name.
  virtual bool exists(const std::string& path) const;
  virtual bool is_folder(const std::string& path) const;
  /// Whether its paths are those of the disk.
  virtual bool is_disk() const { return true; }
  /// Names of what is in a folder, sorted; of very many the first that come.
  virtual std::vector<std::string> list(const std::string& folder) const;
};

/// Whether the path means a file compiled into the program.
bool is_builtin(std::string_view path);

/// A file, and its part of the memory budget.
struct FileContents {
  MemoryReservation memory;
  std::string bytes;
};

/// `files.read(path, error)` with the bytes reserved before they are read. May throw MemoryExceeded.
std::optional<FileContents> read_counted(const FileSystem& files, const std::string& path, std::string& error);

/// The folder part of a path with its last slash: "scenes/", "builtin:room/", "builtin:"; empty for the current one.
std::string folder_of(const std::string& path);

/// Without "." and "..", so that two spellings of one path compare equal; links are not followed.
std::string normal_path(const std::string& path);

/// `name` looked up in each of `folders`; empty if nowhere. `other`, if it is asked for, becomes another file of that
/// name which comes later.
std::string resolve_file(const FileSystem& files, const std::string& name, const std::vector<std::string>& folders,
                         std::string* other = nullptr);

/// What `resolve_file` would have found, for a complaint: "a file in dir/, lib"; of built-in files, which there are.
std::string accepted_files(const std::string& name, const std::vector<std::string>& folders);

/// Files compiled in: (path below scenes/, contents).
std::vector<std::pair<std::string_view, std::string_view>> builtin_files();

}  // namespace norrsken
