#include "base/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>

#include "base/memory.h"

namespace norrsken {
namespace {

constexpr const char* kTooLarge = "is larger than 4 GiB";
constexpr const char* kNotRegular = "is not a regular file";

std::string system_message(int code) {
  return code == ENOENT ? "no such file" : std::error_code(code, std::generic_category()).message();
}

std::optional<std::string> read_all(const RegularFile& file, std::string& error) {
  // Files of /proc claim to be empty; some have no end. What another program adds to a file meanwhile is not waited for.
  constexpr std::uint64_t kMostUntold = std::uint64_t{1} << 20;
  std::string contents(file.bytes > 0 ? file.bytes : kMostUntold, '\0');
  std::size_t size = 0;
  while (size < contents.size()) {
    const ssize_t count = ::read(file.descriptor.get(), contents.data() + size, contents.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      error = system_message(errno);
      return std::nullopt;
    }
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  if (file.bytes == 0 && size == kMostUntold) {
    error = "claims to be empty, and has a MiB or more";
    return std::nullopt;
  }
  contents.resize(size);
  return contents;
}

}  // namespace

bool FileDescriptor::close() { return number_ < 0 || ::close(release()) == 0; }

RegularFile open_regular_file(const std::string& path) {
  RegularFile file;
  if (path.empty() || path.find('\0') != std::string::npos) {
    file.error = "not a file name";
    return file;
  }
  struct stat status {};
  const auto is_regular = [&](int failed) {
    if (failed != 0) {
      file.error = system_message(errno);
      file.is_missing = errno == ENOENT;
    } else if (!S_ISREG(status.st_mode)) {
      file.error = S_ISDIR(status.st_mode) ? "is a folder" : kNotRegular;
    }
    return file.error.empty();
  };
  // Looked at before it is opened, which is enough to make some devices act, and after, when the name may lead elsewhere.
  if (!is_regular(::stat(path.c_str(), &status))) return file;
  // O_NONBLOCK: opening a pipe that nobody writes to would wait for ever.
  FileDescriptor opened(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (!is_regular(opened ? ::fstat(opened.get(), &status) : -1)) return file;
  file.bytes = static_cast<std::uint64_t>(status.st_size);
  file.descriptor = std::move(opened);
  return file;
}

std::optional<std::string> read_regular_file(const std::string& path, std::string& error, std::uint64_t most_bytes) {
  const RegularFile file = open_regular_file(path);
  error = file.error;
  if (!file.descriptor) return std::nullopt;
  if (file.bytes > kMaxFileBytes) {
    error = kTooLarge;
    return std::nullopt;
  }
  if (file.bytes > most_bytes) {
    error = "does not fit into memory: " + shortage_text("it needs", file.bytes, most_bytes, most_bytes);
    return std::nullopt;
  }
  try {
    return read_all(file, error);
  } catch (const std::bad_alloc&) {
    error = "does not fit into memory";
    return std::nullopt;
  }
}

}  // namespace norrsken
