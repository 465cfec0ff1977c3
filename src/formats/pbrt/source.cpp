#include "formats/pbrt/source.h"

#include <algorithm>
#include <string_view>

#include "formats/inflater.h"

namespace norrsken::pbrt {
namespace {

constexpr std::string_view kGzip = "\x1f\x8b";
constexpr std::size_t kFirstBytes = std::size_t{1} << 16;

/// False with `error` set if it is damaged.
bool unpack(std::string_view packed, FileContents& into, std::string& error) {
  Inflater input(packed, Inflater::Wrapping::gzip);
  std::size_t used = 0;
  while (used == into.bytes.size()) {
    const std::size_t size = std::max(2 * used, kFirstBytes);
    into.memory.grow(size - used);
    into.bytes.resize(size);
    used += input.read(into.bytes.data() + used, size - used);
  }
  into.bytes.resize(used);
  error = input.problem();
  return error.empty();
}

}  // namespace

std::optional<FileContents> read_unpacked(const FileSystem& files, const std::string& path, std::string& error) {
  auto contents = read_counted(files, path, error);
  if (!contents || !contents->bytes.starts_with(kGzip)) return contents;
  FileContents unpacked;
  unpacked.memory = MemoryReservation(0);
  if (!unpack(contents->bytes, unpacked, error)) return std::nullopt;
  return unpacked;
}

}  // namespace norrsken::pbrt
