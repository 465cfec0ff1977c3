// The pieces of which the subcommands build their command lines.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "command_line.h"
#include "norrsken/memory.h"
#include "norrsken/render.h"
#include "norrsken/scene.h"

namespace norrsken::cli {

/// "NAME=VALUE" taken apart at the first '='; the name is empty if there is none.
std::pair<std::string, std::string> parse_definition(const std::string& text);
/// "800x600" or "800X600": width and height of at least 1; (0, 0) if it is anything else.
std::pair<int, int> parse_size(const std::string& text);

/// "90s", "1.5m", "2h": seconds, greater than 0; empty if it is anything else.
std::optional<double> parse_duration(const std::string& text);
/// "1%", "0.01": a share greater than 0 and less than 1; empty if it is anything else.
std::optional<double> parse_share(const std::string& text);
/// "4G", "512M", "1.5G", "65536": bytes, at least 1, in units of 1024; "none": MemoryBudget::kUnlimited. Empty if it is
/// anything else.
std::optional<std::uint64_t> parse_memory_size(const std::string& text);
/// "16:64": samples 16 to 63; empty if it is anything else, or no sample.
std::optional<SampleRange> parse_samples(const std::string& text);

Check whole_number(std::int64_t min, std::int64_t max);
Check seed_number();
Check real_number(double min, double max);
Check one_of(std::vector<std::string> words);
Check image_size();
Check definition();
Check duration();
Check file_name();
Check sample_range();
Check share();
Check memory_size();

/// How much memory the program may take: --max-memory.
struct MemoryArguments {
  std::string size;  ///< empty: what the machine has

  void add_to(Command& command);
  std::shared_ptr<MemoryBudget> budget() const;
};

/// The scene and what may be said over its head: SCENE, -D, --sensor, --integrator, --sampler, --size, --spp; --max-memory.
struct SceneArguments {
  std::string scene, size;
  std::optional<std::string> sensor, integrator, sampler;
  std::vector<std::string> definitions;
  MemoryArguments memory;
  int spp = 0;  ///< 0: the scene's

  void add_to(Command& command);
  LoadOptions load_options() const;
};

/// What computes: --threads, --isa, --accel.
struct MachineArguments {
  int threads = 0;
  std::string isa = "auto", accelerator = "auto";

  void add_to(Command& command);
  void apply_to(RenderOptions& options) const;
};

/// How radiance becomes colours: --exposure, --tone.
struct ToneArguments {
  float exposure = 0;
  std::string curve = "srgb";

  void add_to(Command& command);
  ToneMapping tone_mapping() const;
};

}  // namespace norrsken::cli
