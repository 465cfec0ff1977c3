#include "render/checkpoint_file.h"

#include <utility>

#include "base/atomic_file.h"

namespace norrsken {

CheckpointFile::CheckpointFile(std::string path, Traits traits, FilmForm form)
    : path_(std::move(path)),
      traits_(std::move(traits)),
      form_(std::move(form)),
      lock_(path_),
      known_(identity_of_render(path_)) {}

void CheckpointFile::resume(const SampleSchedule& schedule, Work& work, Film& film, double& seconds,
                            Diagnostics& diagnostics) {
  SourceLocation place;
  place.file = path_;
  if (lock_.state() == FileLock::State::busy) {
    diagnostics.error(place, "another process is writing the checkpoint",
                      "another file, or this one when it has ended");
    return;
  }
  const Resumption resumption = resume_render(path_, traits_, schedule, work, film, seconds, diagnostics);
  if (resumption != Resumption::refused && lock_.state() == FileLock::State::unsupported)
    diagnostics.warning(place, "the checkpoint cannot be locked: nothing keeps another process from writing it");
  // What is damaged must not take the place of what is not.
  older_ = resumption == Resumption::older ? OlderGeneration::replace : OlderGeneration::keep;
}

IoStatus CheckpointFile::save(const Provenance& made, const Work& work, Film& film) {
  const SectionFileIdentity found = identity_of_render(path_);
  if (found.state != SectionReader::State::missing && found != known_)
    return write_failure(path_, "it is no longer the checkpoint of this rendering, and is left as it is");
  IoStatus status = save_render(path_, traits_, form_, made, work, film, older_);
  if (!status) return status;
  known_ = identity_of_render(path_);
  older_ = OlderGeneration::keep;
  return status;
}

}  // namespace norrsken
