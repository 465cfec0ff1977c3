// Names for parameterized tests: the parameter itself, or its `name`.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <type_traits>

namespace norrsken::end_to_end {

/// For INSTANTIATE_TEST_SUITE_P; GoogleTest takes letters, digits and underscores only.
inline constexpr auto kParamName = [](const auto& test) {
  std::string name;
  if constexpr (std::is_convertible_v<decltype(test.param), std::string>) {
    name = test.param;
  } else {
    name = test.param.name;
  }
  std::erase_if(name, [](unsigned char c) { return !std::isalnum(c) && c != '_'; });
  return name;
};

}  // namespace norrsken::end_to_end
