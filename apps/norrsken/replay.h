// One sample of one pixel again: `norrsken render SCENE --pixel X,Y --sample N [--trace]`.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "arguments.h"
#include "norrsken/path_trace.h"

namespace norrsken::cli {

/// "12,40": column and row, counted from the upper left; empty if it is anything else.
std::optional<std::pair<int, int>> parse_pixel(const std::string& text);

struct ReplayArguments {
  std::string pixel;  ///< empty: nothing is to be replayed
  int sample = 0;
  bool trace = false;

  void add_to(Command& command);
  bool wanted() const { return !pixel.empty(); }
};

/// The path as text, a paragraph a vertex, or its sum alone.
std::string describe_path(const PathTrace& path, bool vertices);

/// Prints it on stdout.
ExitStatus replay(const Scene& scene, const RenderOptions& options, const ReplayArguments& arguments, bool json);

/// The command that replays a sample of a rendering.
std::string replay_command(const SceneArguments& scene, std::uint64_t seed, const RenderStatistics& statistics, int x,
                           int y, std::uint32_t sample);

}  // namespace norrsken::cli
