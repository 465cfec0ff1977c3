// What tests of the program as its users meet it have in common.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "norrsken/image.h"
#include "tests/process.h"
#include "tests/temporary_folder.h"
#include "tests/told.h"

namespace norrsken::cli {

/// A rendering of milliseconds; and one that nobody would wait for.
inline const std::vector<std::string> kShort = {"-Dshadow_rays=1", "--size", "40x30", "--spp", "4"};
inline const std::vector<std::string> kEndless = {"-Dshadow_rays=1", "--size", "400x400", "--spp", "1000000"};

inline std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// One JSON object a line.
inline std::vector<nlohmann::json> parse_lines(const std::string& text) {
  std::vector<nlohmann::json> objects;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) objects.push_back(nlohmann::json::parse(line));
  return objects;
}

class Cli : public testing::Test {
 protected:
  ProcessResult run(const std::vector<std::string>& arguments, ProcessOptions options = {}) const {
    options.folder = folder_.string();
    return run_program(arguments, options);
  }
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  Image image_of(const std::string& name) const { return value_of(read_image(folder_.file(name))); }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      names.push_back(entry.path().filename().string());
    return names;
  }

  const TemporaryFolder folder_;
};

}  // namespace norrsken::cli
