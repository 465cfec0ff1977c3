#include "film/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "base/atomic_file.h"

namespace norrsken {
namespace {

/// Whether `name` still leads to the open file.
bool is_named(const FileDescriptor& file, const std::string& name, struct stat& ours) {
  struct stat there {};
  return fstat(file.get(), &ours) == 0 && stat(name.c_str(), &there) == 0 && ours.st_ino == there.st_ino &&
         ours.st_dev == there.st_dev;
}

}  // namespace

std::string lock_of(const std::string& path) { return path + ".lock"; }

FileLock::FileLock(const std::string& path) : name_(lock_of(path)) {
  if (const std::string complaint = take(); !complaint.empty()) status_ = write_failure(path, complaint);
}

std::string FileLock::take() {
  constexpr const char* kBusy = "another process is writing it";
  for (int attempt = 0; attempt < 100; ++attempt) {
    // For writing, without which there are no exclusive locks on NFS.
    FileDescriptor file(open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666));
    if (!file) {
      const int error = errno;
      struct stat there {};
      // Of a folder that is missing or closed the caller's own name says enough.
      const std::string in_the_way = lstat(name_.c_str(), &there) == 0 ? "'" + name_ + "': " : "";
      return in_the_way + error_text(error);
    }
    const int error = flock(file.get(), LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    // Another process may have removed it between opening and locking: then it locks nobody out.
    struct stat ours {};
    if (!is_named(file, name_, ours)) continue;
    if (!S_ISREG(ours.st_mode) || ours.st_size > 0)
      return "'" + name_ + "' is in the way, which is no lock of this program";
    if (error == EWOULDBLOCK) {
      state_ = State::busy;
      return kBusy;
    }
    if (error == 0) state_ = State::held;
    file_ = std::move(file);
    return {};
  }
  state_ = State::busy;
  return kBusy;
}

FileLock::~FileLock() {
  struct stat ours {};
  if (file_ && is_named(file_, name_, ours)) unlink(name_.c_str());
}

}  // namespace norrsken
