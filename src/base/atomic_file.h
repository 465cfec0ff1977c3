// A file that appears under its name complete or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

#include "norrsken/image.h"

namespace norrsken {

/// What the system says of an `errno`.
std::string error_text(int error);

/// "cannot write 'PATH': REASON"
IoStatus write_failure(const std::string& path, const std::string& reason);

/// Collects bytes under a temporary name in the folder of `path` and gives them that name in `commit`. A file that
/// is not committed is removed; what was there under the name before stays until the moment of commit. A symbolic
/// link is followed, so that it goes on pointing to the file.
class AtomicFile {
 public:
  AtomicFile() = default;
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Errors: no such folder, no permission, the name is that of something other than a regular file.
  IoStatus create(const std::string& path);

  /// Writes at the current position. After a failure, which `commit` will report, nothing more is written.
  bool write(const void* bytes, std::size_t count);
  bool seek(std::uint64_t position);
  std::uint64_t position() const { return position_; }
  bool failed() const { return error_ != 0; }

  /// Waits until the bytes are on the disk, closes, and renames.
  IoStatus commit();

 private:
  bool check(bool success);
  void discard();

  std::string path_, target_, temporary_;
  std::FILE* file_ = nullptr;
  std::uint64_t position_ = 0;
  int error_ = 0;  ///< errno of the first failure
};

}  // namespace norrsken
