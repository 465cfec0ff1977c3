// What has to be true of an OpenEXR file before its library may look at it.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

namespace norrsken {

/// Whether each attribute of the headers is as long as it says. The library believes the sizes and allocates them, up to
/// 2 GiB each, before it reads. Layout: "The OpenEXR File Layout", openexr.com, sections "Header" and "Multi-part files".
inline bool exr_attributes_fit(std::string_view file) {
  constexpr std::size_t kBegin = 8;  // magic number and version
  constexpr std::uint32_t kMultipart = 0x1000;
  if (file.size() < kBegin) return false;
  std::uint32_t version = 0;
  std::memcpy(&version, file.data() + 4, sizeof version);
  file.remove_prefix(kBegin);
  const auto skip_word = [&file] {
    const std::size_t end = file.find('\0');
    if (end == std::string_view::npos) return false;
    file.remove_prefix(end + 1);
    return true;
  };
  // A header ends with an empty name, the headers of several parts with an empty header.
  for (bool begins = true; !file.empty();) {
    if (file.front() == '\0') {
      if (begins || (version & kMultipart) == 0) return true;
      begins = true;
      file.remove_prefix(1);
      continue;
    }
    begins = false;
    std::int32_t size = 0;
    if (!skip_word() || !skip_word() || file.size() < sizeof size) return false;
    std::memcpy(&size, file.data(), sizeof size);
    file.remove_prefix(sizeof size);
    if (size < 0 || static_cast<std::size_t>(size) > file.size()) return false;
    file.remove_prefix(static_cast<std::size_t>(size));
  }
  return false;
}

}  // namespace norrsken
