// For tests that look at what a call says: its diagnostics apart from its value.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "norrsken/result.h"

namespace norrsken {

/// The value of `result`, if it has one.
template <class T>
std::optional<T> told(Result<T> result, Diagnostics& diagnostics) {
  diagnostics = result.diagnostics();
  return result ? std::optional<T>(*std::move(result)) : std::nullopt;
}
template <class T>
std::unique_ptr<T> told(Result<std::unique_ptr<T>> result, Diagnostics& diagnostics) {
  diagnostics = result.diagnostics();
  return result ? *std::move(result) : nullptr;
}

}  // namespace norrsken
