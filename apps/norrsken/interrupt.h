// Ctrl-C, SIGTERM and a closed terminal (SIGHUP): the first cancels the rendering, the second ends the program. The
// signals with which batch systems say that time is running out (SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM) cancel it, too,
// however often they come: SIGXCPU comes every second.
#pragma once

#include <array>
#include <csignal>

#include "norrsken/render.h"

namespace norrsken::cli {

/// These signals are ours while it lives. One that was ignored before, as under nohup, stays ignored.
class SignalHandlers {
 public:
  SignalHandlers();
  ~SignalHandlers();
  SignalHandlers(const SignalHandlers&) = delete;
  SignalHandlers& operator=(const SignalHandlers&) = delete;

 private:
  static constexpr std::array<int, 7> kSignals = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM};

  std::array<struct sigaction, kSignals.size()> old_{};
};

/// While it lives, the first signal cancels `render`, also one that came earlier, and a second SIGINT, SIGTERM or SIGHUP,
/// if it comes 0.3 s later or more, kills the program as long as the rendering takes samples: not while it looks at them, and not once it is over.
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
