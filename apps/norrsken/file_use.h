// Which files are read and which are written, so that none of the one kind is taken for the other.
#pragma once

#include <string>
#include <vector>

#include "exit_status.h"

namespace norrsken::cli {

/// `use` completes "it is ...": "a file that the scene reads".
struct FileUse {
  std::string path, use;
};

/// One for each path.
std::vector<FileUse> uses_of(const std::vector<std::string>& paths, const std::string& use);

/// Whether both names lead to one file, through links of either kind; also where there is no file yet.
bool is_same_file(const std::string& a, const std::string& b);

/// Without those that are there already, "a.exr" and "./a.exr" being the same.
std::vector<std::string> without_repetitions(const std::vector<std::string>& paths);

/// Tells on stderr every file of `written` that is also one of `taken`, or comes twice under different names: `usage` if
/// there is any, otherwise `done`.
ExitStatus check_written_files(const std::vector<std::string>& written, const std::vector<FileUse>& taken);

}  // namespace norrsken::cli
