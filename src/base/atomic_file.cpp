#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/text.h"

namespace norrsken {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestPath = 4096;  // bytes shown in full

/// Where a chain of symbolic links ends, whether there is something or not.
fs::path follow_links(fs::path path, std::error_code& code) {
  constexpr int kMaxLinks = 40;  // as Linux has it
  for (int links = 0; fs::is_symlink(path, code); ++links) {
    if (links == kMaxLinks) {
      code = std::make_error_code(std::errc::too_many_symbolic_link_levels);
      return path;
    }
    const fs::path next = fs::read_symlink(path, code);
    if (code) return path;
    path = path.parent_path() / next;  // which is `next` if that is absolute
  }
  code.clear();
  return path;
}

}  // namespace

std::string error_text(int error) { return std::generic_category().message(error); }

IoStatus write_failure(const std::string& path, const std::string& reason) {
  return {"cannot write " + quoted(path, kLongestPath) + ": " + reason};
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::discard() {
  if (file_ != nullptr) std::fclose(file_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
  file_ = nullptr;
  temporary_.clear();
}

IoStatus AtomicFile::create(const std::string& path) {
  discard();
  path_ = path;
  position_ = 0;
  error_ = 0;
  if (path.empty() || path.find('\0') != std::string::npos) return write_failure(path, "not a file name");

  std::error_code code;
  const fs::path target = follow_links(path, code);
  if (code) return write_failure(path, code.message());
  const fs::file_status existing = fs::status(target, code);
  if (existing.type() == fs::file_type::none) return write_failure(path, code.message());
  if (fs::exists(existing)) {
    if (fs::is_directory(existing)) return write_failure(path, "it is a folder");
    if (!fs::is_regular_file(existing)) return write_failure(path, "it is not a regular file");
    if (access(target.c_str(), W_OK) != 0) return write_failure(path, error_text(errno));
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const fs::file_status folder_status = fs::status(folder, code);
  if (!fs::exists(folder_status))
    return write_failure(path, "there is no folder " + quoted(folder.string(), kLongestPath));
  if (!fs::is_directory(folder_status))
    return write_failure(path, quoted(folder.string(), kLongestPath) + " is not a folder");
  target_ = target.string();

  // The name is short, whatever the target's length; the extension stays, for whoever finds it after a power cut.
  static std::atomic<unsigned> counter{0};
  int descriptor = -1;
  for (int attempt = 0; descriptor < 0 && attempt < 1000; ++attempt) {
    const std::string name =
        ".norrsken-" + std::to_string(getpid()) + "-" + std::to_string(counter++) + target.extension().string();
    temporary_ = (folder / name).string();
    descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) break;
  }
  if (descriptor < 0) {
    const int error = errno;
    temporary_.clear();
    return write_failure(path, error_text(error));
  }
  file_ = fdopen(descriptor, "wb");
  if (file_ == nullptr) {
    const int error = errno;
    close(descriptor);
    discard();
    return write_failure(path, error_text(error));
  }
  return {};
}

bool AtomicFile::check(bool success) {
  if (!success && error_ == 0) error_ = errno != 0 ? errno : EIO;
  return success;
}

bool AtomicFile::write(const void* bytes, std::size_t count) {
  if (file_ == nullptr || error_ != 0) return false;
  const bool success = check(std::fwrite(bytes, 1, count, file_) == count);
  if (success) position_ += count;
  return success;
}

bool AtomicFile::seek(std::uint64_t position) {
  if (file_ == nullptr || error_ != 0) return false;
  const bool success = check(fseeko(file_, static_cast<off_t>(position), SEEK_SET) == 0);
  if (success) position_ = position;
  return success;
}

IoStatus AtomicFile::commit() {
  if (file_ == nullptr) return write_failure(path_, "it was not created");
  if (error_ == 0) check(std::fflush(file_) == 0 && fsync(fileno(file_)) == 0);
  check(std::fclose(std::exchange(file_, nullptr)) == 0);
  if (error_ == 0) check(rename(temporary_.c_str(), target_.c_str()) == 0);
  if (error_ == 0) {
    temporary_.clear();
    return {};
  }
  discard();
  return write_failure(path_, error_text(error_));
}

}  // namespace norrsken
