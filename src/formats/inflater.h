// Unpacking what zlib's deflate has packed.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace norrsken {

/// Reads the bytes that were packed, a stretch at a time. Throws std::bad_alloc where zlib finds no memory.
class Inflater {
 public:
  enum class Wrapping {
    zlib,  ///< RFC 1950: one stream, whatever comes behind it
    gzip,  ///< RFC 1952: one member after the other, to the end of the bytes
  };

  /// `packed` has to live as long as this.
  Inflater(std::string_view packed, Wrapping wrapping);
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater();

  /// The next bytes, at most `count`: so many as are written to `to`. Fewer at the end, or where `problem` says why.
  std::size_t read(void* to, std::size_t count);
  /// The next `count` bytes. False if there are fewer.
  bool fill(void* to, std::size_t count);
  template <class T>
  bool fill(T& value) {
    return fill(&value, sizeof value);
  }
  /// What is wrong with the packed bytes, after the file's name: "ends early"; empty if nothing is, as far as was read.
  const std::string& problem() const { return problem_; }

  /// False if so many values of `size` bytes cannot come any more: deflate makes at most 1032 bytes of one (zlib's manual).
  bool may_have(std::uint64_t count, std::uint64_t size);

 private:
  /// False at the end of what was packed.
  bool step();

  z_stream stream_{};
  std::string_view rest_;
  Wrapping wrapping_;
  bool ended_ = false;
  std::string problem_;
};

}  // namespace norrsken
