#include "formats/inflater.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace norrsken {
namespace {

constexpr std::size_t kStep = std::size_t{1} << 30;  // zlib counts with 32 bits
constexpr int kGzipOnly = 16;                        // zlib's manual, inflateInit2: 16 more than the window's bits

constexpr const char* kEndsEarly = "ends early";

}  // namespace

Inflater::Inflater(std::string_view packed, Wrapping wrapping) : rest_(packed), wrapping_(wrapping) {
  const int window = MAX_WBITS + (wrapping == Wrapping::gzip ? kGzipOnly : 0);
  if (inflateInit2(&stream_, window) != Z_OK) throw std::bad_alloc();
}

Inflater::~Inflater() { inflateEnd(&stream_); }

std::size_t Inflater::read(void* to, std::size_t count) {
  auto* const begin = static_cast<Bytef*>(to);
  std::size_t got = 0;
  while (got < count && !ended_) {
    const std::size_t want = std::min(count - got, kStep);
    stream_.next_out = begin + got;
    stream_.avail_out = static_cast<uInt>(want);
    ended_ = !step();
    got += want - stream_.avail_out;
  }
  return got;
}

bool Inflater::fill(void* to, std::size_t count) {
  if (read(to, count) == count) return true;
  if (problem_.empty()) problem_ = kEndsEarly;
  return false;
}

bool Inflater::step() {
  if (stream_.avail_in == 0) {
    const std::size_t feed = std::min(rest_.size(), kStep);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));
    stream_.avail_in = static_cast<uInt>(feed);
    rest_.remove_prefix(feed);
  }
  switch (const int status = inflate(&stream_, Z_NO_FLUSH)) {
    case Z_OK:
      return true;
    case Z_MEM_ERROR:
      throw std::bad_alloc();
    case Z_STREAM_END:
      if (wrapping_ == Wrapping::zlib || (stream_.avail_in == 0 && rest_.empty())) return false;
      if (inflateReset(&stream_) != Z_OK) throw std::bad_alloc();
      return true;
    default:
      problem_ = status == Z_BUF_ERROR ? kEndsEarly
                                       : fmt::format("is damaged ({})", stream_.msg ? stream_.msg : "its packing");
      return false;
  }
}

bool Inflater::may_have(std::uint64_t count, std::uint64_t size) {
  const std::uint64_t most = (rest_.size() + stream_.avail_in + 1) * 1032 + (std::uint64_t{1} << 16);
  if (count <= most / size) return true;
  problem_ = kEndsEarly;
  return false;
}

}  // namespace norrsken
