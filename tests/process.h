// Runs the program under test as its users do: as a process with its own files, signals and terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace norrsken::cli {

struct ProcessResult {
  int status = -1;  ///< exit status; 128 + signal if one killed it
  std::string out, err;
  std::uint64_t peak_memory = 0;  ///< bytes that were resident at most
};

struct ProcessOptions {
  std::string folder = {};                      ///< current folder of the process
  std::vector<std::string> environment = {};    ///< "NAME=value", in addition
  bool terminal = false;                        ///< stderr is a terminal of 80 columns (and then arrives in `err`)
  std::string stdout_file = {};                 ///< where stdout goes in place of `out`
  std::uint64_t largest_file = 0;               ///< bytes beyond which no file grows; 0: without limit
  std::uint64_t processor_seconds = 0;          ///< after which it is killed; 0: without limit
  std::uint64_t address_space = 0;              ///< bytes of addresses that it may have; 0: without limit
  std::vector<int> signals = {};                ///< sent one after the other ...
  std::chrono::milliseconds signal_delay{700};  ///< ... each after this time, ...
  std::function<bool()> signal_when = {};       ///< ... or the first when this becomes true
};

/// Runs the program with these arguments to its end; kills it after two minutes.
ProcessResult run_program(const std::vector<std::string>& arguments, const ProcessOptions& options = {});

}  // namespace norrsken::cli
