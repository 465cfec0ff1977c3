// The commands, each with its options and what it does.
#pragma once

#include "command_line.h"

namespace norrsken::cli {

Command render_command();
Command merge_command();
Command info_command();
Command scenes_command();
Command convert_command();
Command compare_command();
Command bench_command();
Command figures_command();

}  // namespace norrsken::cli
