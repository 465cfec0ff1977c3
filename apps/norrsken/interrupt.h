// Ctrl-C and SIGTERM: the first cancels the rendering, the second ends the program.
#pragma once

#include <csignal>

#include "norrsken/render.h"

namespace norrsken::cli {

/// While it lives, the first SIGINT or SIGTERM cancels `render` and gives both signals back their default effect, so
/// that a second one kills at once. A signal that was ignored when the program started stays ignored. One at a time.
class InterruptGuard {
 public:
  explicit InterruptGuard(Render& render);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  struct sigaction old_int_ {
  }, old_term_{};
};

/// Whether a signal has been caught since the program started.
bool interrupt_requested() noexcept;

}  // namespace norrsken::cli
