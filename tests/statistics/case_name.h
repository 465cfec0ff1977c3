// Names of parametrised tests, for INSTANTIATE_TEST_SUITE_P.
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace norrsken::statistics {

/// Letters, digits and underscores only, as GoogleTest wants it.
inline std::string plain_name(std::string_view text) {
  std::string name(text);
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

/// A model and one of its sets of parameters.
inline std::string case_name(std::string_view model, std::string_view set) {
  return plain_name(std::string(model) + "_" + std::string(set));
}

}  // namespace norrsken::statistics
