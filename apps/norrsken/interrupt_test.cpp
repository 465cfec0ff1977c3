#include "interrupt.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

namespace norrsken::cli {
namespace {

struct FakeRender final : Render {
  RenderStatistics run(const RenderCallbacks&) override { return {}; }
  void cancel() noexcept override { ++cancelled; }
  bool is_sampling() const noexcept override { return sampling; }
  Image image(bool, const std::optional<ImageRegion>&) const override { return {}; }
  int cancelled = 0;
  bool sampling = true;
};

// Every case is a process of its own: a caught signal is remembered for as long as the program runs.
[[noreturn]] void finish(bool as_expected) { std::_Exit(as_expected ? 0 : 1); }

void cancel_once(int signal_number) {
  FakeRender render;
  const InterruptGuard guard(render);
  std::raise(signal_number);
  finish(render.cancelled == 1 && interrupt_requested());
}

// Longer than wrappers take to send one signal twice.
void wait_like_a_person() { std::this_thread::sleep_for(std::chrono::milliseconds(350)); }

void interrupt_twice() {
  FakeRender render;
  const InterruptGuard guard(render);
  std::raise(SIGTERM);
  wait_like_a_person();
  std::raise(SIGINT);
  finish(false);
}

void interrupt_twice_at_once() {
  FakeRender render;
  const InterruptGuard guard(render);
  std::raise(SIGINT);
  std::raise(SIGINT);
  std::raise(SIGTERM);
  finish(interrupt_requested());
}

void interrupt_again_when_no_samples_are_taken() {
  FakeRender render;
  const InterruptGuard guard(render);
  std::raise(SIGINT);
  render.sampling = false;
  wait_like_a_person();
  std::raise(SIGINT);
  std::raise(SIGTERM);
  finish(render.cancelled == 1);
}

void interrupt_while_saving() {
  FakeRender render;
  const InterruptGuard guard(render);
  std::raise(SIGINT);
  {
    const SavingGuard saving;
    wait_like_a_person();
    std::raise(SIGINT);
    std::raise(SIGHUP);
  }
  finish(render.cancelled == 1);
}

void interrupt_between_renderings() {
  {
    const SavingGuard saving;
    std::raise(SIGINT);
  }
  FakeRender render;
  const InterruptGuard guard(render);
  finish(render.cancelled == 1);
}

void warn_again_and_again() {
  {
    FakeRender render;
    const InterruptGuard guard(render);
    for (int i = 0; i < 3; ++i) {
      for (const int signal_number : {SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM}) std::raise(signal_number);
    }
    std::raise(SIGTERM);  // as Slurm sends when time is up
  }
  std::raise(SIGXCPU);  // on the way out
  finish(interrupt_requested());
}

void hang_up_when_ignored() {
  std::signal(SIGHUP, SIG_IGN);
  FakeRender render;
  const InterruptGuard guard(render);
  std::raise(SIGHUP);
  std::raise(SIGINT);
  std::raise(SIGHUP);
  finish(render.cancelled == 1);
}

TEST(InterruptDeathTest, TheFirstSignalCancelsAndTheSecondKills) {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU, SIGALRM})
    EXPECT_EXIT(cancel_once(signal_number), testing::ExitedWithCode(0), "") << signal_number;
  EXPECT_EXIT(interrupt_twice(), testing::KilledBySignal(SIGINT), "");
}

TEST(InterruptDeathTest, WhatWrappersSendTwiceIsOneSignal) {
  EXPECT_EXIT(interrupt_twice_at_once(), testing::ExitedWithCode(0), "");
}

TEST(InterruptDeathTest, WarningsOfBatchSystemsDiscardNothingHoweverOftenTheyCome) {
  EXPECT_EXIT(warn_again_and_again(), testing::ExitedWithCode(0), "");
}

TEST(InterruptDeathTest, SavingIsNotInterrupted) {
  EXPECT_EXIT(interrupt_while_saving(), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(interrupt_again_when_no_samples_are_taken(), testing::ExitedWithCode(0), "");
}

TEST(InterruptDeathTest, WhatCameWhileSavingCancelsTheNextRendering) {
  EXPECT_EXIT(interrupt_between_renderings(), testing::ExitedWithCode(0), "");
}

TEST(InterruptDeathTest, AnIgnoredSignalStaysIgnored) {
  EXPECT_EXIT(hang_up_when_ignored(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace norrsken::cli
