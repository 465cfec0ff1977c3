#include "film/file_lock.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <optional>

#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

namespace fs = std::filesystem;
using State = FileLock::State;

TEST(FileLock, IsHadOnce) {
  const TemporaryFolder folder;
  const std::string path = folder.file("file");
  std::optional<FileLock> first(path);
  EXPECT_EQ(first->state(), State::held);
  EXPECT_TRUE(first->status());
  const FileLock second(path);
  EXPECT_EQ(second.state(), State::busy);
  EXPECT_EQ(second.status().error, "cannot write '" + path + "': another process is writing it");
  EXPECT_EQ(FileLock(folder.file("other")).state(), State::held);
  first.reset();
  EXPECT_EQ(FileLock(path).state(), State::held);
  EXPECT_TRUE(fs::is_empty(folder.path())) << "nothing is left";
}

TEST(FileLock, IsGoneWithAKilledProcess) {
  const TemporaryFolder folder;
  const std::string path = folder.file("file");
  int told[2];
  ASSERT_EQ(pipe(told), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FileLock lock(path);
    const char state = lock.state() == State::held ? 'h' : '?';
    if (write(told[1], &state, 1) != 1) _exit(1);
    for (;;) pause();
  }
  char state = 0;
  ASSERT_EQ(read(told[0], &state, 1), 1);
  EXPECT_EQ(state, 'h');
  EXPECT_EQ(FileLock(path).state(), State::busy);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(lock_of(path)));
  EXPECT_EQ(FileLock(path).state(), State::held);
  EXPECT_FALSE(fs::exists(lock_of(path)));
}

TEST(FileLock, LeavesFilesOfOthersAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("file"), name = folder.write("file.lock", "a text");
  {
    const FileLock lock(path);
    EXPECT_EQ(lock.state(), State::unsupported);
    EXPECT_EQ(lock.status().error,
              "cannot write '" + path + "': '" + name + "' is in the way, which is no lock of this program");
  }
  EXPECT_EQ(fs::file_size(name), 6u);
  EXPECT_EQ(FileLock("/proc/none").status().error, "cannot write '/proc/none': No such file or directory");
}

}  // namespace
}  // namespace norrsken
