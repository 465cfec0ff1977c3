// Checksums: of bytes that are to be believed, and of data that is to be the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

namespace norrsken {

/// 64 bits of XXH3: any single error is found, others but for one in 2^64. No protection against malice.
std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t seed = 0);

/// 128 bits of XXH3 over everything that is added, and over how it was cut.
class Fingerprint {
 public:
  Fingerprint();
  ~Fingerprint();
  Fingerprint(const Fingerprint&) = delete;
  Fingerprint& operator=(const Fingerprint&) = delete;

  void add(std::span<const std::byte> bytes);
  /// Types without padding: what is between members has no value.
  template <class Range>
  void add_all(const Range& values) {
    static_assert(std::is_trivially_copyable_v<std::remove_reference_t<decltype(*values.data())>>);
    add(std::as_bytes(std::span(values)));
  }
  template <class T>
  void add_one(const T& value) {
    add(std::as_bytes(std::span(&value, 1)));
  }

  /// 32 hexadecimal digits.
  std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace norrsken
