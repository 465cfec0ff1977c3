// Files of sections (film/section_file.h) taken apart and put together with right checksums, whatever is in them.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/checksum.h"
#include "fuzz/fuzz.h"

namespace norrsken::fuzz {

struct SectionFile {
  struct Section {
    std::array<char, 16> name{};
    std::string content;
  };
  std::array<char, 16> head{};  ///< magic, version, number of sections
  std::vector<Section> sections;
};

inline constexpr std::size_t kHeadBytes = 32, kSectionHeadBytes = 40;

/// What `bytes` begin with of such a file; sections as far as there are bytes.
inline SectionFile take_apart(std::string_view bytes) {
  SectionFile file;
  bytes.copy(file.head.data(), file.head.size());
  bytes.remove_prefix(std::min(bytes.size(), kHeadBytes));
  while (bytes.size() >= kSectionHeadBytes) {
    auto& section = file.sections.emplace_back();
    bytes.copy(section.name.data(), section.name.size());
    std::uint64_t count = 0;
    std::memcpy(&count, bytes.data() + section.name.size(), sizeof count);
    bytes.remove_prefix(kSectionHeadBytes);
    section.content = bytes.substr(0, count);
    bytes.remove_prefix(section.content.size());
  }
  return file;
}

inline std::string put_together(const SectionFile& file) {
  std::string bytes;
  const auto add = [&bytes](const void* data, std::size_t count) {
    bytes.append(static_cast<const char*>(data), count);
  };
  const auto add_number = [&](std::uint64_t number) { add(&number, sizeof number); };
  const auto add_checksum = [&](std::size_t head, std::uint64_t before) {
    const std::uint64_t sum = checksum(std::as_bytes(std::span(bytes).subspan(head)), before);
    add_number(sum);
    return sum;
  };
  std::size_t total = kHeadBytes;
  for (const auto& section : file.sections) total += kSectionHeadBytes + section.content.size();
  add(file.head.data(), file.head.size());
  add_number(total);
  std::uint64_t before = add_checksum(0, 0);
  for (const auto& section : file.sections) {
    const std::size_t head = bytes.size();
    add(section.name.data(), section.name.size());
    add_number(section.content.size());
    add_number(checksum(std::as_bytes(std::span(section.content))));
    before = add_checksum(head, before);
    bytes += section.content;
  }
  return bytes;
}

}  // namespace norrsken::fuzz
