// Files to read, by their names: regular ones alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace norrsken {

/// A file descriptor that is closed on every way out.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number = -1) : number_(number) {}
  FileDescriptor(FileDescriptor&& other) noexcept : number_(other.release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~FileDescriptor() { close(); }

  explicit operator bool() const { return number_ >= 0; }
  int get() const { return number_; }
  int release() { return std::exchange(number_, -1); }
  /// False if what was written has not arrived.
  bool close();

 private:
  int number_;
};

struct RegularFile {
  FileDescriptor descriptor;
  std::uint64_t bytes = 0;
  bool is_missing = false;
  std::string error;  ///< empty if the file is open: "no such file", "is a folder", "is not a regular file", ...
};

/// Opens a file for reading. Devices, pipes, sockets and folders are refused, never waited for.
RegularFile open_regular_file(const std::string& path);

/// Of what is read in one piece.
inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t{4} << 30;

/// The whole file, or empty with `error` set. Files above kMaxFileBytes are refused, and those of more than `most_bytes`,
/// which are what there is memory for.
std::optional<std::string> read_regular_file(const std::string& path, std::string& error,
                                             std::uint64_t most_bytes = kMaxFileBytes);

}  // namespace norrsken
