// The page on which `norrsken figures` shows its pictures and measurements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "norrsken/compare.h"
#include "norrsken/render.h"

namespace norrsken::cli {

/// Pixels along a side, and the sampler, of the report's own figures.
inline constexpr int kReportSide = 800;
inline constexpr const char* kReportSampler = "independent";

/// One rendering of the room: how, at what cost, and how far from its reference.
struct FigureResult {
  std::string name;  ///< "Figure 5"; also the first word of what a reader is told about it
  std::string caption;
  std::string stem;  ///< file name without extension; empty if no files were written
  std::string light, integrator, sampler;
  int spp = 0, shadow_rays = 0;
  std::string reference = {};  ///< name of the reference it was compared with
  RenderStatistics statistics = {};
  Comparison comparison = {};  ///< with the reference; a reference's own holds its estimated mse and rel_mse

  std::uint64_t rays() const { return statistics.closest_rays + statistics.shadow_rays; }
  double samples_per_second() const;
  /// Root of relMSE: root mean square of (a - b) / sqrt(b^2 + 0.01) over pixels and channels.
  double relative_error() const;
  /// Root mean square error over the reference's mean. A few pixels at the edge of a light can make most of it.
  double relative_rmse() const;
};

struct FiguresReport {
  std::string command;  ///< as typed, to do it again
  std::string machine;  ///< name of the processor; may be empty
  int width = 0, height = 0;
  std::vector<FigureResult> references;
  std::vector<FigureResult> figures;  ///< in order
  std::vector<FigureResult> one_ray;  ///< the area light with one shadow ray per hit, by samples
  /// Of `one_ray`: the one whose error is that of the last figure.
  std::optional<std::size_t> equal;
};

/// The whole HTML document; refers to the images by their file names and to nothing else.
std::string figures_page(const FiguresReport& report);

}  // namespace norrsken::cli
