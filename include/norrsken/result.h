// What a call has come to: a value with what there is to say about it, or complaints that say why there is none.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "norrsken/diagnostics.h"

namespace norrsken {

/// The library throws nothing but std::bad_alloc, and that only where the system has no memory left for what the memory
/// budget does not count: texts, small tables.
template <class T>
class [[nodiscard]] Result {
 public:
  // NOLINTBEGIN(google-explicit-constructor): `return value;` and `return diagnostics;` are what it is for
  Result(T value, Diagnostics diagnostics = {}) : value_(std::move(value)), diagnostics_(std::move(diagnostics)) {}
  /// Without a value; `diagnostics` have an error.
  Result(Diagnostics diagnostics) : diagnostics_(std::move(diagnostics)) {}
  // NOLINTEND(google-explicit-constructor)
  /// Without a value, for one reason.
  static Result failure(std::string message, std::string accepted = {}) {
    Diagnostics diagnostics;
    diagnostics.error({}, std::move(message), std::move(accepted));
    return diagnostics;
  }

  bool has_value() const noexcept { return value_.has_value(); }
  explicit operator bool() const noexcept { return has_value(); }

  // Only where there is a value.
  T& operator*() & { return *value_; }
  const T& operator*() const& { return *value_; }
  T&& operator*() && { return *std::move(value_); }
  T* operator->() { return &*value_; }
  const T* operator->() const { return &*value_; }

  /// Errors where there is no value; warnings and notes where there is one.
  const Diagnostics& diagnostics() const { return diagnostics_; }
  /// The message of the first error; empty if there is none.
  std::string error() const { return diagnostics_.first_error(); }

 private:
  std::optional<T> value_;
  Diagnostics diagnostics_;
};

}  // namespace norrsken
