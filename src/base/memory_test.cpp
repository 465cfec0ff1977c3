#include "base/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "base/machine_memory.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

constexpr std::uint64_t kMebibyte = 1 << 20, kGibibyte = 1 << 30;

TEST(MemoryBudget, GivesNoMoreThanItHas) {
  MemoryBudget budget(100);
  EXPECT_TRUE(budget.take(60));
  EXPECT_FALSE(budget.take(41));
  EXPECT_EQ(budget.used(), 60u) << "what is refused is not taken";
  EXPECT_TRUE(budget.take(40));
  EXPECT_EQ(budget.left(), 0u);
  budget.give_back(70);
  EXPECT_EQ(budget.left(), 70u);
  EXPECT_EQ(budget.peak(), 100u);
  EXPECT_FALSE(budget.take(MemoryBudget::kUnlimited)) << "sums that overflow";
}

TEST(MemoryBudget, IsExactWithManyThreads) {
  MemoryBudget budget(1000);
  std::atomic<int> taken{0};
  {
    std::vector<std::jthread> threads;
    threads.reserve(4);
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (int i = 0; i < 10000; ++i) {
          if (budget.take(7)) {
            ++taken;
            if (i % 2 == 0) budget.give_back(7), --taken;
          }
        }
      });
    }
  }
  EXPECT_EQ(taken, 1000 / 7);
  EXPECT_EQ(budget.used(), 7u * (1000 / 7));
  EXPECT_LE(budget.peak(), 1000u);
}

TEST(MemoryReservation, IsGivenBack) {
  const auto budget = std::make_shared<MemoryBudget>(100);
  {
    MemoryReservation first(60, budget);
    EXPECT_THROW(first.grow(41), MemoryExceeded);
    EXPECT_EQ(first.bytes(), 60u);
    first.grow(40);
    const MemoryReservation moved = std::move(first);
    EXPECT_EQ(budget->used(), 100u);
    EXPECT_EQ(moved.bytes(), 100u);
  }
  EXPECT_EQ(budget->used(), 0u);
  EXPECT_NO_THROW(MemoryReservation(MemoryBudget::kUnlimited, nullptr)) << "nothing is counted without a budget";
}

TEST(Array, AsksBeforeItAllocates) {
  const auto budget = std::make_shared<MemoryBudget>(1000);
  {
    const MemoryScope scope(budget);
    Array<double> values;
    values.reserve(100);
    EXPECT_EQ(budget->used(), 800u);
    // Growing holds both copies.
    EXPECT_THROW(values.reserve(101), MemoryExceeded);
    EXPECT_EQ(budget->used(), 800u);
    EXPECT_EQ(values.capacity(), 100u);
    values = Array<double>();
    EXPECT_EQ(budget->used(), 0u);
    try {
      values.resize(std::size_t{1} << 40);
      FAIL();
    } catch (const MemoryExceeded& e) {
      EXPECT_EQ(e.wanted, std::uint64_t{8} << 40);
      EXPECT_STREQ(e.what(), "it needs another 8.00 TiB, and 1000 bytes of 1000 bytes are left");
    }
  }
  EXPECT_EQ(budget->used(), 0u);
}

TEST(Array, BelongsToTheBudgetThatItWasMadeIn) {
  const auto budget = std::make_shared<MemoryBudget>(1000), inner = std::make_shared<MemoryBudget>(1000);
  Array<char> uncounted(300), kept;
  {
    const MemoryScope scope(budget);
    Array<char> counted(100);
    {
      const MemoryScope inner_scope(inner);
      kept = std::move(counted);  // no copy
      const Array<char> other(50);
      EXPECT_EQ(inner->used(), 50u);
    }
    EXPECT_EQ(MemoryScope::current(), budget);
  }
  EXPECT_EQ(MemoryScope::current(), nullptr);
  EXPECT_EQ(budget->used(), 100u);
  EXPECT_EQ(inner->used(), 0u);
  std::thread([array = std::move(kept)]() mutable { array = Array<char>(); }).join();
  EXPECT_EQ(budget->used(), 0u) << "whoever frees it";
}

TEST(MemoryText, IsShortAndTellsApart) {
  EXPECT_EQ(memory_text(1), "1 byte");
  EXPECT_EQ(memory_text(1023), "1023 bytes");
  EXPECT_EQ(memory_text(1536), "1.50 KiB");
  EXPECT_EQ(memory_text(300 * kMebibyte), "300 MiB");
  EXPECT_EQ(memory_text(40 * kGibibyte), "40.0 GiB");
  EXPECT_EQ(memory_text(std::uint64_t{5000} << 40), "5000 TiB");
  EXPECT_EQ(shortage_text("it needs", 3 * kGibibyte, kGibibyte, 4 * kGibibyte),
            "it needs 3.00 GiB, and 1.00 GiB of 4.00 GiB are left");
  EXPECT_EQ(shortage_text("it needs", kGibibyte + 1, kGibibyte, kGibibyte),
            "it needs 1073741825 bytes, and 1073741824 bytes of 1.00 GiB are left");
}

/// A made-up root folder.
class MachineMemory : public ::testing::Test {
 protected:
  MachineMemory() {
    add("proc/meminfo", "MemTotal:  8388608 kB\nMemFree:  1 kB\nMemAvailable:    6291456 kB\nBuffers: 5 kB\n");
  }

  void add(const std::string& path, const std::string& text) {
    std::filesystem::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  std::uint64_t available() const { return available_memory(root_.string() + "/"); }
  std::uint64_t mebibytes() const { return available() / kMebibyte; }

 private:
  const TemporaryFolder root_;
};

std::string bytes(std::uint64_t mebibytes) { return std::to_string(mebibytes * kMebibyte) + "\n"; }

TEST_F(MachineMemory, IsWhatTheKernelSaysIsAvailable) {
  EXPECT_EQ(mebibytes(), 6144u);
  add("proc/self/cgroup", "0::/\n");
  EXPECT_EQ(mebibytes(), 6144u);
  add("proc/meminfo", "MemTotal:  8388608 kB\n");  // kernels before 3.14
  EXPECT_EQ(available(), MemoryBudget::kUnlimited);
}

TEST_F(MachineMemory, IsBoundByGroupsOfVersion2) {
  add("proc/self/cgroup", "0::/farm/job 7\n");
  add("sys/fs/cgroup/farm/job 7/memory.max", "max\n");
  EXPECT_EQ(mebibytes(), 6144u);
  add("sys/fs/cgroup/farm/job 7/memory.max", bytes(4096));
  add("sys/fs/cgroup/farm/job 7/memory.current", bytes(3000));
  EXPECT_EQ(mebibytes(), 1096u);
  add("sys/fs/cgroup/farm/job 7/memory.stat",
      "anon 5\nfile 7\nworkingset_inactive_file 1\ninactive_file " + bytes(1000) + "active_file 9\n");
  EXPECT_EQ(mebibytes(), 2096u) << "file cache is dropped when needed";
  add("sys/fs/cgroup/farm/memory.max", bytes(1000));
  add("sys/fs/cgroup/farm/memory.current", bytes(999));
  EXPECT_EQ(mebibytes(), 1u) << "the group around it";
  add("sys/fs/cgroup/farm/memory.current", bytes(2000));
  EXPECT_EQ(mebibytes(), 0u);
}

TEST_F(MachineMemory, IsBoundByTheGroupOfAContainer) {
  add("proc/self/cgroup", "0::/system.slice/docker-4711.scope\n");  // a folder outside, not seen here
  add("sys/fs/cgroup/memory.max", bytes(512));
  add("sys/fs/cgroup/memory.current", bytes(12));
  EXPECT_EQ(mebibytes(), 500u);
}

TEST_F(MachineMemory, IsBoundByGroupsOfVersion1) {
  add("proc/self/cgroup", "12:cpu,cpuacct:/x\n11:hugetlb,memory:/docker/4711\n10:memorylike:/y\n1:name=systemd:/z\n");
  add("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  add("sys/fs/cgroup/memory/memory.usage_in_bytes", bytes(7000));
  EXPECT_EQ(mebibytes(), 6144u);
  add("sys/fs/cgroup/memory/docker/4711/memory.limit_in_bytes", bytes(2048));
  add("sys/fs/cgroup/memory/docker/4711/memory.usage_in_bytes", bytes(1048));
  add("sys/fs/cgroup/memory/docker/4711/memory.stat", "inactive_file 4096\ntotal_inactive_file " + bytes(48));
  EXPECT_EQ(mebibytes(), 1048u);
  add("sys/fs/cgroup/memory/y/memory.limit_in_bytes", bytes(1));
  EXPECT_EQ(mebibytes(), 1048u) << "not ours";
}

TEST(AddressSpace, IsWhatTheLimitLeaves) {
#ifdef NORRSKEN_SANITIZED
  GTEST_SKIP() << "sanitizers map terabytes, and die of a limit";
#endif
  const auto in_child = [](auto body) {
    const pid_t child = fork();
    if (child == 0) _exit(body() ? 0 : 1);
    int status = -1;
    waitpid(child, &status, 0);
    return status == 0;
  };
  EXPECT_TRUE(in_child([] {
    const struct rlimit none { RLIM_INFINITY, RLIM_INFINITY };
    return setrlimit(RLIMIT_AS, &none) != 0 || available_address_space() == MemoryBudget::kUnlimited;
  }));
  EXPECT_TRUE(in_child([] {
    const struct rlimit limit { std::uint64_t{64} << 40, std::uint64_t{64} << 40 };
    if (setrlimit(RLIMIT_AS, &limit) != 0) return false;
    const std::uint64_t left = available_address_space();
    return left < limit.rlim_cur && left > limit.rlim_cur / 4;
  }));
  EXPECT_GT(resident_memory(), kMebibyte);
  EXPECT_LT(resident_memory(), std::uint64_t{1} << 40);
}

}  // namespace
}  // namespace norrsken
