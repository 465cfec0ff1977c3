// The state of a rendering in a file: sums of the film, how far each tile has come, and what all of that belongs to.
#pragma once

#include <optional>
#include <string>

#include "film/film.h"
#include "film/section_file.h"
#include "render/provenance.h"
#include "render/traits.h"
#include "render/worker_pool.h"

namespace norrsken {

/// What of a film's settings decides about what its sums mean: enough to make images of them without the scene.
struct FilmForm {
  FilmSettings settings;
  SamplerKind sampler = SamplerKind::sobol;
  bool from_lights = false;
  SceneLayers layers;
};

/// A file that holds a rendering, after its traits and before its sums.
struct StoredRender {
  Traits traits;
  FilmForm form;
  Provenance made;
  SampleRange samples, feature_samples;
  SampleGoal goal;
  std::uint32_t tile_width = 0, tile_height = 0;
  TileProgress progress, feature_progress;
  DroppedSamples dropped;
};

IoStatus save_render(const std::string& path, const Traits& traits, const FilmForm& form, const Provenance& made,
                     const Work& work, Film& film, OlderGeneration older);

/// What is at `path`, as it is now.
SectionFileIdentity identity_of_render(const std::string& path);

/// Reads a file of `save_render` in the order in which it was written: first what it holds, then its sums.
class RenderReader {
 public:
  explicit RenderReader(const std::string& path);

  /// Readable only if `stored` is to be believed.
  SectionReader::State state() const { return reader_.state(); }
  const std::string& complaint() const { return reader_.complaint(); }
  std::uint64_t file_bytes() const { return reader_.file_bytes(); }
  const StoredRender& stored() const { return stored_; }
  /// Into a film of the stored form. False if a part of it is damaged; then the film is empty.
  bool read_film(Film& film);

 private:
  SectionReader reader_;
  StoredRender stored_;
};

/// Where a rendering goes on.
enum class Resumption {
  none,    ///< there is no checkpoint
  newest,  ///< with the file
  older,   ///< with the generation before, the file being damaged; this was told as a warning
  refused  ///< this was told as an error
};
/// Takes up what `path` holds of the same rendering, into `work` and `film`, and the `seconds` that it took. `work` comes
/// with what is asked for, and `schedule` says what is to become of it.
Resumption resume_render(const std::string& path, const Traits& traits, const SampleSchedule& schedule, Work& work,
                         Film& film, double& seconds, Diagnostics& diagnostics);

}  // namespace norrsken
