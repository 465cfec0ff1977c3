#include "interrupt.h"

#include <atomic>
#include <cstdint>
#include <ctime>

namespace norrsken::cli {
namespace {

std::atomic<Render*> g_target = nullptr;
std::atomic<bool> g_requested = false, g_saving = false;
std::atomic<std::int64_t> g_first = 0;  // of a person's signals, in nanoseconds; 0: none has come
static_assert(std::atomic<Render*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
                  std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

/// Signals of somebody who may mean it when they come again.
bool is_from_a_person(int signal_number) {
  return signal_number == SIGINT || signal_number == SIGTERM || signal_number == SIGHUP;
}

/// `timeout` and other wrappers send a signal to the program and to its group, and a terminal may add its own: what comes
/// within this time is the same one.
constexpr std::int64_t kOneSignal = 300'000'000;  // nanoseconds

bool comes_again() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  const std::int64_t now = std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  std::int64_t first = 0;
  return !g_first.compare_exchange_strong(first, now) && now - first > kOneSignal;
}

extern "C" void norrsken_on_interrupt(int signal_number) {
  const bool again = is_from_a_person(signal_number) && comes_again();
  g_requested.store(true);
  if (g_saving.load()) return;
  Render* render = g_target.load();
  if (again) {
    if (render != nullptr && !render->is_sampling()) return;  // it is about to be saved
    // Blocked until this handler returns, and then deadly.
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
  } else if (render != nullptr) {
    render->cancel();
  }
}

}  // namespace

SignalHandlers::SignalHandlers() {
  struct sigaction action {};
  action.sa_handler = norrsken_on_interrupt;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &old_[i]);
    if (old_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

SignalHandlers::~SignalHandlers() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    // A warning that has been heeded does not kill on the way out.
    const bool is_heeded = g_requested.load() && !is_from_a_person(kSignals[i]) && old_[i].sa_handler == SIG_DFL;
    is_heeded ? static_cast<void>(std::signal(kSignals[i], SIG_IGN))
              : static_cast<void>(sigaction(kSignals[i], &old_[i], nullptr));
  }
}

// The handlers are members: they are there before the body sets what they act on, and go after it is taken back.
InterruptGuard::InterruptGuard(Render& render) {
  g_target.store(&render);
  if (g_requested.load()) render.cancel();  // came before there was anything to cancel
}
InterruptGuard::~InterruptGuard() { g_target.store(nullptr); }

SavingGuard::SavingGuard() { g_saving.store(true); }
SavingGuard::~SavingGuard() { g_saving.store(false); }

bool interrupt_requested() noexcept { return g_requested.load(); }

}  // namespace norrsken::cli
