// The subcommands. Each adds itself to the command line and, if chosen, sets what is to be done.
#pragma once

#include "arguments.h"

namespace norrsken::cli {

void add_render_command(CLI::App& app, Action& action);
void add_merge_command(CLI::App& app, Action& action);
void add_info_command(CLI::App& app, Action& action);
void add_scenes_command(CLI::App& app, Action& action);
void add_compare_command(CLI::App& app, Action& action);
void add_bench_command(CLI::App& app, Action& action);
void add_figures_command(CLI::App& app, Action& action);

}  // namespace norrsken::cli
