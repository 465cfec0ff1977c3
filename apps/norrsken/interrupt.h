// Ctrl-C, SIGTERM and a closed terminal (SIGHUP): the first cancels the rendering, the second ends the program.
#pragma once

#include <array>
#include <csignal>

#include "norrsken/render.h"

namespace norrsken::cli {

/// SIGINT, SIGTERM and SIGHUP are ours while it lives. One that was ignored before, as under nohup, stays ignored.
class SignalHandlers {
 public:
  SignalHandlers();
  ~SignalHandlers();
  SignalHandlers(const SignalHandlers&) = delete;
  SignalHandlers& operator=(const SignalHandlers&) = delete;

 private:
  std::array<struct sigaction, 3> old_{};
};

/// While it lives, the first signal cancels `render`, also one that came earlier, and a second one kills the program.
/// One at a time.
class InterruptGuard {
 public:
  explicit InterruptGuard(Render& render);
  ~InterruptGuard();

 private:
  SignalHandlers handlers_;
};

/// While it lives, signals are remembered and nothing else: what is being saved is not destroyed by impatience.
class SavingGuard {
 public:
  SavingGuard();
  ~SavingGuard();

 private:
  SignalHandlers handlers_;
};

/// Whether a signal has been caught since the program started.
bool interrupt_requested() noexcept;

}  // namespace norrsken::cli
