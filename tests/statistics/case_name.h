// Names of parametrised tests, for INSTANTIATE_TEST_SUITE_P.
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace norrsken::statistics {

/// A model and one of its sets of parameters. GoogleTest takes letters, digits and underscores only.
inline std::string case_name(std::string_view model, std::string_view set) {
  std::string name = std::string(model) + "_" + std::string(set);
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return name;
}

}  // namespace norrsken::statistics
