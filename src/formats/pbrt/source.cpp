#include "formats/pbrt/source.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <new>

namespace norrsken::pbrt {
namespace {

constexpr std::string_view kGzip = "\x1f\x8b";
constexpr int kGzipOnly = 16;  // zlib's manual, inflateInit2: 16 more than the window's bits
constexpr std::size_t kFirstBytes = std::size_t{1} << 16;

class Gunzip {
 public:
  explicit Gunzip(std::string_view packed) : rest_(packed) {
    if (inflateInit2(&stream_, MAX_WBITS + kGzipOnly) != Z_OK) throw std::bad_alloc();
  }
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;
  ~Gunzip() { inflateEnd(&stream_); }

  /// All members of the file, one after the other. False with `error` set if it is damaged.
  bool unpack(FileContents& into, std::string& error) {
    std::size_t used = 0;
    for (;;) {
      if (used == into.bytes.size()) {
        const std::size_t size = std::max(2 * used, kFirstBytes);
        into.memory.grow(size - used);
        into.bytes.resize(size);
      }
      feed();
      stream_.next_out = reinterpret_cast<Bytef*>(into.bytes.data()) + used;
      stream_.avail_out = static_cast<uInt>(std::min(into.bytes.size() - used, kStep));
      const uInt room = stream_.avail_out;
      const int status = inflate(&stream_, Z_NO_FLUSH);
      used += room - stream_.avail_out;
      if (status == Z_MEM_ERROR) throw std::bad_alloc();
      if (status == Z_STREAM_END) {
        if (stream_.avail_in == 0 && rest_.empty()) break;
        if (inflateReset(&stream_) != Z_OK) throw std::bad_alloc();
      } else if (status != Z_OK && !(status == Z_BUF_ERROR && stream_.avail_out == 0)) {
        error = status == Z_BUF_ERROR ? "ends early"
                                      : fmt::format("is damaged ({})", stream_.msg ? stream_.msg : "its packing");
        return false;
      }
    }
    into.bytes.resize(used);
    return true;
  }

 private:
  static constexpr std::size_t kStep = std::size_t{1} << 30;  // zlib counts with 32 bits

  void feed() {
    if (stream_.avail_in > 0) return;
    const std::size_t size = std::min(rest_.size(), kStep);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));
    stream_.avail_in = static_cast<uInt>(size);
    rest_.remove_prefix(size);
  }

  z_stream stream_{};
  std::string_view rest_;
};

}  // namespace

std::optional<FileContents> read_unpacked(const FileSystem& files, const std::string& path, std::string& error) {
  auto contents = read_counted(files, path, error);
  if (!contents || !contents->bytes.starts_with(kGzip)) return contents;
  FileContents unpacked;
  unpacked.memory = MemoryReservation(0);
  if (!Gunzip(contents->bytes).unpack(unpacked, error)) return std::nullopt;
  return unpacked;
}

}  // namespace norrsken::pbrt
