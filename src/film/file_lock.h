// The right to write a file, which one process has at a time.
#pragma once

#include <string>

#include "base/regular_file.h"
#include "norrsken/image.h"

namespace norrsken {

/// A lock of the kernel's on the empty file `path`.lock. It goes with the process, however that ends: what a killed one
/// leaves of the file locks nobody out. It does not matter what becomes of the file at `path` meanwhile.
class FileLock {
 public:
  enum class State {
    held,
    busy,        ///< another process, or another one of these, has it
    unsupported  ///< there are no locks here, or the file cannot be made
  };

  /// Never waits.
  explicit FileLock(const std::string& path);
  /// Removes the file, if it is ours.
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  State state() const { return state_; }
  /// Whether the file could be made, which tells whether the folder can be written to. `status` says why not.
  const IoStatus& status() const { return status_; }

 private:
  /// Why there is none, or nothing.
  std::string take();

  std::string name_;
  FileDescriptor file_;
  State state_ = State::unsupported;
  IoStatus status_;
};

/// `path`.lock
std::string lock_of(const std::string& path);

}  // namespace norrsken
