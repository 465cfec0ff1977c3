#include "film/section_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/atomic_file.h"
#include "base/checksum.h"
#include "base/regular_file.h"
#include "film/file_lock.h"

namespace norrsken {
namespace {

static_assert(std::endian::native == std::endian::little, "big-endian machines need to swap the heads' numbers");

constexpr std::array<char, 8> kMagic = {'\x89', 'N', 'o', 'r', 'r', 's', 'k', '\n'};

struct FileHead {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = 0, sections = 0;
  std::uint64_t bytes = 0, checksum = 0;
};
static_assert(sizeof(FileHead) == 32);

struct SectionHead {
  std::array<char, 16> name{};
  std::uint64_t bytes = 0, content_checksum = 0, checksum = 0;
};
static_assert(sizeof(SectionHead) == 40);

template <class Head>
std::span<const std::byte> bytes_of(const Head& head) {
  return std::as_bytes(std::span(&head, 1));
}

/// Of everything but the checksum itself, which comes last; `seed` is that of the head before.
template <class Head>
std::uint64_t checksum_of(const Head& head, std::uint64_t seed) {
  return checksum(bytes_of(head).first(sizeof head - sizeof head.checksum), seed);
}

std::string temporary_of(const std::string& path) { return path + ".tmp"; }

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

bool write_all(int file, std::span<const std::byte> bytes) {
  // Linux writes at most 2 GiB at once.
  constexpr std::size_t kAtOnce = std::size_t{1} << 26;
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), std::min(bytes.size(), kAtOnce));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      if (written == 0) errno = ENOSPC;
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

bool write_contents(int file, std::uint32_t version, std::span<const Section> sections) {
  FileHead head;
  head.version = version;
  head.sections = static_cast<std::uint32_t>(sections.size());
  head.bytes = sizeof head;
  for (const Section& section : sections) head.bytes += sizeof(SectionHead) + section.content.size();
  head.checksum = checksum_of(head, 0);
  if (!write_all(file, bytes_of(head))) return false;
  std::uint64_t before = head.checksum;
  for (const Section& section : sections) {
    SectionHead section_head;
    std::copy_n(section.name.begin(), std::min(section.name.size(), section_head.name.size() - 1),
                section_head.name.begin());
    section_head.bytes = section.content.size();
    section_head.content_checksum = checksum(section.content);
    section_head.checksum = before = checksum_of(section_head, before);
    if (!write_all(file, bytes_of(section_head)) || !write_all(file, section.content)) return false;
  }
  return true;
}

/// Whether something stands there that no checkpoint can have left: it is somebody's, and not written over.
bool is_somebodys(const std::string& path) {
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return false;
  if (!S_ISREG(status.st_mode)) return true;
  const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  std::array<char, kMagic.size()> begin{};
  const ssize_t bytes = file ? read(file.get(), begin.data(), begin.size()) : -1;
  if (bytes < 0) return true;
  // A power cut may have left zeros, or fewer bytes.
  const std::array<char, kMagic.size()> zeros{};
  const auto size = static_cast<std::size_t>(bytes);
  return !std::equal(begin.begin(), begin.begin() + size, kMagic.begin()) &&
         !std::equal(begin.begin(), begin.begin() + size, zeros.begin());
}

IoStatus check_way(const std::string& path) {
  for (const std::string& name : {temporary_of(path), older_generation_of(path)})
    if (is_somebodys(name)) return write_failure(path, "'" + name + "' is in the way, which is no checkpoint");
  return {};
}

/// Says in `errno` why not.
int open_temporary(const std::string& path) {
  // What a killed writing has left is written over.
  const int file =
      open(temporary_of(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  struct stat status {};
  if (file < 0 || (fstat(file, &status) == 0 && S_ISREG(status.st_mode))) return file;
  close(file);
  errno = EEXIST;
  return -1;
}

IoStatus check_target(const std::string& path) {
  if (path.empty() || path.find('\0') != std::string::npos) return write_failure(path, "not a file name");
  struct stat status {};
  if (lstat(path.c_str(), &status) != 0) return {};
  if (S_ISDIR(status.st_mode)) return write_failure(path, "it is a folder");
  if (!S_ISREG(status.st_mode)) return write_failure(path, "it is not a regular file");
  return {};
}

bool sync_folder(const std::string& path) {
  const FileDescriptor folder(open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() < 0) return false;
  // Some file systems cannot, and say so.
  return fsync(folder.get()) == 0 || errno == EINVAL;
}

/// The name never goes without a whole file behind it: what has it gets a second name first.
bool take_name(const std::string& path, OlderGeneration older) {
  const std::string old = older_generation_of(path);
  if (older == OlderGeneration::keep && access(path.c_str(), F_OK) == 0) {
    if (unlink(old.c_str()) != 0 && errno != ENOENT) return false;
    // File systems without links: for a moment the older generation is the only one.
    if (link(path.c_str(), old.c_str()) != 0 && rename(path.c_str(), old.c_str()) != 0) return false;
  }
  return rename(temporary_of(path).c_str(), path.c_str()) == 0;
}

}  // namespace

std::string older_generation_of(const std::string& path) { return path + ".1"; }

IoStatus write_sections(const std::string& path, std::uint32_t version, std::span<const Section> sections,
                        OlderGeneration older) {
  if (IoStatus status = check_target(path); !status) return status;
  if (IoStatus status = check_way(path); !status) return status;
  FileDescriptor file(open_temporary(path));
  if (!file) return write_failure(path, error_text(errno));
  const bool written = write_contents(file.get(), version, sections) && fsync(file.get()) == 0;
  if (written && take_name(path, older) && file.close() && sync_folder(path)) return {};
  const int error = errno;
  unlink(temporary_of(path).c_str());
  return write_failure(path, error_text(error));
}

IoStatus check_sections_writable(const std::string& path) {
  if (IoStatus status = check_target(path); !status) return status;
  if (IoStatus status = check_way(path); !status) return status;
  return FileLock(path).status();
}

SectionFileIdentity identity_of(const std::string& path, std::uint32_t version) {
  const SectionReader reader(path, version);
  return {reader.state(), reader.heads_checksum()};
}

std::vector<std::string> files_of_sections(const std::string& path) {
  return {path, older_generation_of(path), temporary_of(path), lock_of(path)};
}

SectionReader::SectionReader(const std::string& path, std::uint32_t version) {
  RegularFile file = open_regular_file(path);
  if (!file.descriptor) {
    const bool other_kind = file.error.starts_with("is ");
    fail(file.is_missing ? State::missing : State::unreadable, (other_kind ? "" : "cannot be read: ") + file.error);
    return;
  }
  file_bytes_ = file.bytes;
  file_.reset(fdopen(file.descriptor.get(), "rb"));
  if (file_ == nullptr) {
    fail(State::unreadable, "cannot be read: " + error_text(errno));
    return;
  }
  file.descriptor.release();
  read_heads(version);
}

bool SectionReader::fail(State state, std::string complaint) {
  if (state_ == State::readable) {
    state_ = state;
    complaint_ = std::move(complaint);
  }
  return false;
}

bool SectionReader::read_heads(std::uint32_t version) {
  FileHead head;
  const std::size_t count = std::fread(&head, 1, sizeof head, file_.get());
  if (count < sizeof head.magic || head.magic != kMagic)
    return fail(State::foreign, "does not begin as checkpoints do");
  if (count < sizeof head || head.checksum != checksum_of(head, 0)) {
    return fail(State::damaged, "is damaged in its head");
  }
  if (head.version != version) {
    return fail(State::other_version, "has format " + std::to_string(head.version) + ", this program reads format " +
                                          std::to_string(version));
  }
  if (head.bytes != file_bytes_) {
    return fail(State::damaged, "has " + std::to_string(file_bytes_) + " of " + std::to_string(head.bytes) + " bytes");
  }
  std::uint64_t before = head.checksum, at = sizeof head;
  for (std::uint32_t i = 0; i < head.sections; ++i) {
    SectionHead section;
    if (fseeko(file_.get(), static_cast<off_t>(at), SEEK_SET) != 0 ||
        std::fread(&section, 1, sizeof section, file_.get()) != sizeof section ||
        section.checksum != checksum_of(section, before) || section.name.back() != '\0' ||
        section.bytes > file_bytes_ - at - sizeof section) {
      return fail(State::damaged, "is damaged in the head of section " + std::to_string(i + 1));
    }
    at += sizeof section;
    entries_.push_back({section.name.data(), at, section.bytes, section.content_checksum});
    at += section.bytes;
    before = section.checksum;
  }
  if (at != file_bytes_) return fail(State::damaged, "goes on behind its last section");
  heads_checksum_ = before;
  return true;
}

bool SectionReader::read(std::string_view name, std::span<std::byte> content) {
  if (state_ != State::readable) return false;
  if (at_end() || entries_[next_].name != name || entries_[next_].bytes != content.size()) {
    return fail(State::damaged, "has no section '" + std::string(name) + "' of " + std::to_string(content.size()) +
                                    " bytes where one is expected");
  }
  const Entry& entry = entries_[next_++];
  if (fseeko(file_.get(), static_cast<off_t>(entry.offset), SEEK_SET) != 0 ||
      std::fread(content.data(), 1, content.size(), file_.get()) != content.size() ||
      checksum(content) != entry.checksum) {
    return fail(State::damaged, "is damaged in section '" + entry.name + "'");
  }
  return true;
}

bool SectionReader::read(std::string_view name, std::vector<std::byte>& content, std::uint64_t most_bytes) {
  if (state_ == State::readable && !at_end() && entries_[next_].bytes <= most_bytes) {
    content.resize(entries_[next_].bytes);
  }
  return read(name, std::span(content));
}

}  // namespace norrsken
