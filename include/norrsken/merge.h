// Joining what several renderings of one scene have left in their checkpoints.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "norrsken/image.h"
#include "norrsken/memory.h"
#include "norrsken/render.h"

namespace norrsken {

struct MergedRender {
  Image image;
  std::vector<SampleRange> samples;  ///< those of the files, ascending; what follows on each other is one range
  std::vector<SampleRange> gaps;     ///< from sample 0 on: those that no file holds
  std::uint64_t dropped_samples = 0;
};

/// The image of all samples that the files hold, bit for bit that of one rendering of them (see base/exact_sum.h),
/// whatever the order of the files. `layers` as in Render::image.
/// `memory` is that of two films and the image; empty: MemoryBudget::of_machine().
/// Errors: a file that cannot be read, is damaged or not finished; files of different renderings (scene, size, seed,
/// sampler, instruction set, ...); samples that two files hold. `result` changes on success only.
IoStatus merge_renders(const std::vector<std::string>& files, bool layers, MergedRender& result,
                       std::shared_ptr<MemoryBudget> memory = {});

}  // namespace norrsken
