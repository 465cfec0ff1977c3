// Rendering a scene: settings, progress, cancellation, pixels.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "norrsken/image.h"
#include "norrsken/result.h"
#include "norrsken/samples.h"
#include "norrsken/scene.h"

namespace norrsken {

/// Most worker threads that a rendering takes.
inline constexpr int kMaxThreads = 1024;

struct RenderOptions {
  std::optional<int> samples_per_pixel = {};  ///< in place of the scene's
  std::optional<SampleRange> samples = {};    ///< these alone
  /// Render until the whole image's relative error is at most this, seen from the upper end of its interval, or for so
  /// many seconds, or both, whichever is first; 0: neither. Samples per pixel are the most to take then, if they are given
  /// here; the scene's number does not count. Samples are added in whole blocks.
  double target_error = 0;
  double seconds = 0;
  bool adaptive = false;  ///< more samples where there is more noise, by tiles; samples per pixel are the mean
  std::uint64_t seed = 0;
  int threads = 0;                   ///< 0: one per hardware thread
  std::string isa = "auto";          ///< auto, scalar, sse4.2, avx2, avx512
  std::string accelerator = "auto";  ///< auto, planes, moller_trumbore, bvh, embree
  bool features = false;             ///< also render depth, normal, albedo and object id of the first hits
  /// File that holds the state of the rendering, if not empty: Render::create takes up what it holds of the same
  /// rendering (fewer samples of it, too), and `run` writes it, at its end as well. The one before stays as FILE.1.
  /// Render::create refuses it while another Render has it, of this process or another.
  std::string checkpoint = {};
  double checkpoint_seconds = 60;  ///< from one writing to the next; more than 0
  /// Called with each diagnostic of Render::create as it comes; the result has them all.
  DiagnosticSink log = {};
};

struct RenderProgress {
  std::uint64_t samples_done = 0;     ///< camera samples
  std::uint64_t samples_total = 0;    ///< of all, or up to the next look at error and time
  std::uint64_t samples_resumed = 0;  ///< of those done: what the checkpoint held
  double elapsed_seconds = 0;         ///< since run() began
  double samples_per_second = 0;
  double fraction = 0;       ///< 0 to 1: how much is done, as far as can be told
  double seconds_left = -1;  ///< -1 while unknown
  RelativeError error = {};
  std::string checkpoint_error = {};  ///< why the checkpoint could not be written the last time; empty if it could
};

/// A sample whose radiance was NaN or infinite and was left out of its pixel's mean.
struct DroppedSample {
  int x = 0, y = 0;
  std::uint32_t sample = 0;
};

struct RenderStatistics {
  std::uint64_t samples = 0;          ///< camera samples in the image
  std::uint64_t samples_resumed = 0;  ///< of those: what the checkpoint held
  std::uint64_t closest_rays = 0;     ///< rays asked for their closest hit, since `run` began
  std::uint64_t shadow_rays = 0;      ///< rays asked whether anything is in between
  std::uint64_t dropped_samples = 0;
  std::vector<DroppedSample> dropped;  ///< the first few of them
  /// Rays that came to the boundary of a medium in another medium than the one that lies there, as behind an open mesh or in
  /// shapes that overlap, and the first shape where any did.
  std::uint64_t wrong_media = 0;
  int wrong_medium_shape = -1;        ///< counted as the scene's shapes are
  std::string wrong_medium_shape_id;  ///< may be empty
  bool samples_of_pixels = true;      ///< false: paths begin at the lights, and a sample's pixel is where it is counted
  double seconds = 0;
  RelativeError error = {};
  bool cancelled = false;  ///< before the end
  std::string failure;     ///< why it ended before the end without being cancelled: the system has no more threads
  bool has_image = false;  ///< there are samples, and the layers are complete
  std::string checkpoint_error;  ///< as in RenderProgress
  std::string isa, accelerator;
  int threads = 0, lanes = 0;
};

/// A part of an image, in its pixels.
struct ImageRegion {
  int x = 0, y = 0, width = 0, height = 0;
};

/// What every pixel has by now.
struct RenderPass {
  std::uint32_t samples = 0;  ///< so many at least, of the image
  bool has_layers = false;    ///< those of the first hits are complete, or there are none
};

/// Called from the thread that called `run`, while the others go on; they may call everything of their Render but `run`.
/// What they throw leaves `run` when the workers have ended: the image is there, but nothing more is written to the
/// checkpoint.
struct RenderCallbacks {
  std::function<void(const RenderProgress&)> on_progress = {};  ///< about ten times a second, and once at the end
  /// When every pixel has more than at the call before: after the first sample of each and the second, then at most ten
  /// times a second, and at the end.
  std::function<void(const RenderPass&)> on_pass = {};
};

/// One rendering of one scene. `run` may be called once; everything else at any time, from any thread; `cancel` from a
/// signal handler, too.
class Render {
 public:
  /// Builds nothing that the scene has already, nor what another rendering of it has built. Errors: an unknown instruction
  /// set, one that this processor lacks, no samples, the checkpoint of something else, too little memory.
  static Result<std::unique_ptr<Render>> create(const Scene& scene, const RenderOptions& options = {});
  virtual ~Render() = default;

  /// Renders until all samples are taken or `cancel` is called, and writes the checkpoint.
  virtual RenderStatistics run(const RenderCallbacks& callbacks) = 0;
  RenderStatistics run(std::function<void(const RenderProgress&)> on_progress = {}) {
    return run(RenderCallbacks{std::move(on_progress), {}});
  }
  virtual void cancel() noexcept = 0;
  /// Whether samples are being taken at this moment. Otherwise there is nothing to cancel: what they have come to is summed
  /// up or saved. From any thread, and from signal handlers.
  virtual bool is_sampling() const noexcept = 0;

  /// What has been rendered by now: R, G, B; `layers` adds `samples`, `variance.R/G/B` (of the mean),
  /// `error.R/G/B` (its root; both NaN while a pixel has too few samples to tell), `interval.R/G/B` (half the width of the
  /// interval around the value that holds the true one with a probability of 95 %, from the variances of the pixel and
  /// of its neighbours) and, with RenderOptions::features,
  /// `depth.Z`, `normal.X/Y/Z`, `albedo.R/G/B`, `id`. Its metadata say how it was made.
  ///
  /// While `run` is under way, each pixel is the mean of whole samples, one with more of them than another perhaps; layers
  /// of the first hits are there as soon as they are complete. Of the workers, only those wait that come to pixels which
  /// are being copied. `region` is the part that is wanted; what of it is beyond the image is left out.
  virtual Image image(bool layers = false, const std::optional<ImageRegion>& region = {}) const = 0;
};

/// Whether a checkpoint could be written there, asked before a long render: the folder can be written to, and no other
/// process has the checkpoint.
IoStatus check_checkpoint_writable(const std::string& path);

/// All files that a rendering with this checkpoint may replace or remove: it, the one before, the one that is being
/// written, and the lock.
std::vector<std::string> checkpoint_files(const std::string& path);

/// The instruction sets that this build has and this processor can run, best first: "avx512", "avx2", ...
std::vector<std::string> usable_isas();

}  // namespace norrsken
