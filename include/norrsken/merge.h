// Joining what several renderings of one scene have left in their checkpoints.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "norrsken/image.h"
#include "norrsken/memory.h"
#include "norrsken/render.h"
#include "norrsken/result.h"

namespace norrsken {

struct MergedRender {
  Image image;
  std::vector<SampleRange> samples;  ///< those of the files, ascending; what follows on each other is one range
  std::vector<SampleRange> gaps;     ///< from sample 0 on: those that no file holds
  std::uint64_t dropped_samples = 0;
  double samples_per_pixel = 0;              ///< the mean
  std::uint64_t pixels_without_samples = 0;  ///< which are black
  RelativeError error = {};

  /// A file whose rendering goes on, or was stopped.
  struct Unfinished {
    std::string file;
    double samples_per_pixel = 0;  ///< the mean
    std::uint32_t goal = 0;        ///< samples per pixel that it was to take, at most
  };
  std::vector<Unfinished> unfinished;
};

/// The image of all samples that the files hold, bit for bit that of one rendering of them (see base/exact_sum.h),
/// whatever the order of the files, and finished or not: a rendering may be writing them meanwhile. `layers` as in
/// Render::image.
/// `memory` is that of two films and the image; empty: MemoryBudget::of_machine().
/// Errors: a file that cannot be read, is damaged or holds no image yet; files of different renderings (scene, size, seed,
/// sampler, instruction set, ...); samples that two files hold, or would hold in the end.
Result<MergedRender> merge_renders(const std::vector<std::string>& files, bool layers = false,
                                   std::shared_ptr<MemoryBudget> memory = {});

/// Whether the file is a checkpoint, of this version of the program or of another, whole or damaged.
bool is_checkpoint(const std::string& path);

}  // namespace norrsken
