// The checkpoint of a rendering that goes on: one rendering at a time has it, and replaces only what it knows.
#pragma once

#include <string>

#include "film/file_lock.h"
#include "render/checkpoint.h"

namespace norrsken {

class CheckpointFile {
 public:
  /// Takes the lock of `path`.
  CheckpointFile(std::string path, Traits traits, FilmForm form);

  /// Takes up what the file holds, as `resume_render` does, and the seconds that it took. An error if somebody else has
  /// the lock, a warning if there are no locks.
  void resume(const SampleSchedule& schedule, Work& work, Film& film, double& seconds, Diagnostics& diagnostics);

  /// Errors: those of writing, and that the file is neither the one that was read nor the one that was written last.
  IoStatus save(const Provenance& made, const Work& work, Film& film);

 private:
  std::string path_;
  Traits traits_;
  FilmForm form_;
  FileLock lock_;
  SectionFileIdentity known_;
  OlderGeneration older_ = OlderGeneration::keep;
};

}  // namespace norrsken
