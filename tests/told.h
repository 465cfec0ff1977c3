// What a call has come to, for tests: its diagnostics apart from its value, or the value that it must have.
#pragma once

#include <gtest/gtest.h>

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

/// Where there must be a value; otherwise the test fails, and goes on with an empty one.
template <class T>
T value_of(Result<T> result) {
  EXPECT_TRUE(result) << result.error();
  return result ? *std::move(result) : T();
}

}  // namespace norrsken
