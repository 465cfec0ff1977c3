#include "interrupt.h"

#include <atomic>

namespace norrsken::cli {
namespace {

std::atomic<Render*> g_target = nullptr;
std::atomic<bool> g_requested = false;
static_assert(std::atomic<Render*>::is_always_lock_free && std::atomic<bool>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

extern "C" void norrsken_on_interrupt(int) {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  g_requested.store(true);
  if (Render* render = g_target.load()) render->cancel();
}

void install(int signal_number, struct sigaction& old) {
  sigaction(signal_number, nullptr, &old);
  if (old.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = norrsken_on_interrupt;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard(Render& render) {
  g_target.store(&render);
  install(SIGINT, old_int_);
  install(SIGTERM, old_term_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
  g_target.store(nullptr);
}

bool interrupt_requested() noexcept { return g_requested.load(); }

}  // namespace norrsken::cli
