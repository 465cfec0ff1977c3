#include "scene/read_files.h"

#include <algorithm>
#include <span>

#include "base/checksum.h"

namespace norrsken {

std::optional<std::string> RecordedFiles::read(const std::string& path, std::string& error) const {
  std::optional<std::string> contents = files_->read(path, error);
  if (contents) {
    const std::uint64_t sum = checksum(std::as_bytes(std::span(*contents)));
    const std::lock_guard lock(mutex_);
    checksums_[path] = sum;
  }
  return contents;
}

std::vector<std::string> RecordedFiles::paths() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> paths;
  for (const auto& [path, sum] : checksums_) {
    if (is_disk() && !is_builtin(path)) paths.push_back(path);
  }
  return paths;
}

std::string RecordedFiles::fingerprint() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::uint64_t> sums;
  for (const auto& [path, sum] : checksums_) sums.push_back(sum);
  // Copies of a file are the same file.
  std::ranges::sort(sums);
  sums.erase(std::unique(sums.begin(), sums.end()), sums.end());
  Fingerprint print;
  print.add_all(sums);
  return print.text();
}

}  // namespace norrsken
