// Files of named sections with checksums: what checkpoints are kept in. A file appears under its name whole or not at
// all, the one that had the name before stays as NAME.1, and what cannot be read whole is not believed.
//
//   head     magic, 8 bytes; format version, u32; number of sections, u32; bytes of the file, u64; checksum of these, u64
//   section  name, 16 bytes; bytes of content, u64; checksum of the content, u64; checksum of these and of all heads
//            before, u64; content
//
// Numbers are in the byte order of little-endian machines. Checksums are XXH3, 64 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "norrsken/image.h"

namespace norrsken {

/// Content is borrowed. A name has at most 15 bytes.
struct Section {
  std::string_view name;
  std::span<const std::byte> content;
};

/// Whether the generation that a file replaces is kept.
enum class OlderGeneration { keep, replace };

/// `path`.1
std::string older_generation_of(const std::string& path);

/// Writes to `path`.tmp, waits for the disk, gives the file its name, and waits for the folder. On an error both
/// generations stay as they are. One process at a time: whoever writes holds the FileLock of `path`.
IoStatus write_sections(const std::string& path, std::uint32_t version, std::span<const Section> sections,
                        OlderGeneration older);

/// Whether that is likely to succeed: the folder can be written to, nothing but a file has the name, and nobody else
/// has the lock.
IoStatus check_sections_writable(const std::string& path);

/// All that writing `path` may replace or remove.
std::vector<std::string> files_of_sections(const std::string& path);

class SectionReader {
 public:
  enum class State {
    readable,
    missing,
    unreadable,     ///< not a regular file, no permission
    foreign,        ///< not a file of sections at all
    other_version,  ///< intact, but this program does not know what is in it
    damaged
  };

  /// Looks at all heads; contents are verified as they are read.
  explicit SectionReader(const std::string& path, std::uint32_t version);

  State state() const { return state_; }
  /// What is wrong, to follow the file's name.
  const std::string& complaint() const { return complaint_; }
  std::uint64_t file_bytes() const { return file_bytes_; }
  /// Of all heads, the checksums of the contents among them: files of other contents have another one. 0 if it is not
  /// readable.
  std::uint64_t heads_checksum() const { return heads_checksum_; }

  /// Reads the next section, if it has this name, into memory of its size. False, and damaged, if anything is wrong.
  bool read(std::string_view name, std::span<std::byte> content);
  /// The same for one of at most so many bytes.
  bool read(std::string_view name, std::vector<std::byte>& content, std::uint64_t most_bytes);
  /// What was read makes no sense: damaged from now on. Returns false.
  bool distrust(std::string complaint) { return fail(State::damaged, std::move(complaint)); }
  /// Whether every section was read.
  bool at_end() const { return next_ == entries_.size(); }

 private:
  struct Entry {
    std::string name;
    std::uint64_t offset, bytes, checksum;
  };
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  bool fail(State state, std::string complaint);
  bool read_heads(std::uint32_t version);

  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t file_bytes_ = 0, heads_checksum_ = 0;
  std::vector<Entry> entries_;
  std::size_t next_ = 0;
  State state_ = State::readable;
  std::string complaint_;
};

/// What is at a path, told from what may come to be there later.
struct SectionFileIdentity {
  SectionReader::State state = SectionReader::State::missing;
  std::uint64_t heads_checksum = 0;

  friend bool operator==(const SectionFileIdentity&, const SectionFileIdentity&) = default;
};
SectionFileIdentity identity_of(const std::string& path, std::uint32_t version);

}  // namespace norrsken
