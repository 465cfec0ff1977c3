#include "base/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class AtomicFileTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  void put(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  std::string text_of(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path(name)).rdbuf();
    return text.str();
  }
  int files() const { return static_cast<int>(std::distance(fs::directory_iterator(folder_.path()), {})); }

  const TemporaryFolder folder_;
};

TEST_F(AtomicFileTest, AppearsWithCommitOnly) {
  AtomicFile file;
  ASSERT_TRUE(file.create(path("a.png")));
  ASSERT_TRUE(file.write("hello", 5));
  EXPECT_FALSE(fs::exists(path("a.png")));
  EXPECT_TRUE(file.commit());
  EXPECT_EQ(text_of("a.png"), "hello");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, SeeksAndOverwrites) {
  AtomicFile file;
  ASSERT_TRUE(file.create(path("a.png")));
  file.write("hello", 5);
  EXPECT_TRUE(file.seek(1));
  file.write("EL", 2);
  EXPECT_EQ(file.position(), 3u);
  EXPECT_TRUE(file.seek(5));
  file.write("!", 1);
  EXPECT_TRUE(file.commit());
  EXPECT_EQ(text_of("a.png"), "hELlo!");
}

TEST_F(AtomicFileTest, LeavesNothingWithoutCommit) {
  put("a.png", "old");
  {
    AtomicFile file;
    ASSERT_TRUE(file.create(path("a.png")));
    file.write("new", 3);
    EXPECT_EQ(files(), 2);
  }
  EXPECT_EQ(text_of("a.png"), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, TwoWritersOfOneNameDoNotMix) {
  AtomicFile first, second;
  ASSERT_TRUE(first.create(path("a.png")));
  ASSERT_TRUE(second.create(path("a.png")));
  first.write("first", 5);
  second.write("second", 6);
  EXPECT_TRUE(first.commit());
  EXPECT_EQ(text_of("a.png"), "first");
  EXPECT_TRUE(second.commit());
  EXPECT_EQ(text_of("a.png"), "second");
  EXPECT_EQ(files(), 1);
}

// Whoever may write to the folder could guess the next temporary name and put a link to another file there.
TEST_F(AtomicFileTest, NeverWritesThroughAnExistingName) {
  put("victim", "old");
  AtomicFile first;
  ASSERT_TRUE(first.create(path("a.png")));
  std::string name;
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    if (entry.path().filename() != "victim") name = entry.path().filename().string();
  }
  const std::size_t number_at = name.rfind('-') + 1;
  const int number = std::stoi(name.substr(number_at));
  fs::create_symlink("victim", folder_ / (name.substr(0, number_at) + std::to_string(number + 1) + ".png"));
  AtomicFile second;
  ASSERT_TRUE(second.create(path("a.png")));
  second.write("new", 3);
  EXPECT_TRUE(second.commit());
  EXPECT_EQ(text_of("victim"), "old");
  EXPECT_EQ(text_of("a.png"), "new");
}

// A limit on the size of files stands for a full disk: the write fails in the kernel.
TEST_F(AtomicFileTest, KeepsTheOldFileWhenTheDiskIsFull) {
  put("a.png", "old");
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const rlimit limit{1000, old_limit.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);

  IoStatus small, large;
  for (const std::size_t size : {std::size_t{900}, std::size_t{100'000}}) {
    AtomicFile file;
    EXPECT_TRUE(file.create(path(size == 900 ? "b.png" : "a.png")));
    const std::string bytes(size, 'x');
    file.write(bytes.data(), bytes.size());
    (size == 900 ? small : large) = file.commit();
  }
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);

  EXPECT_TRUE(small) << small.error;
  EXPECT_THAT(large.error, HasSubstr("cannot write '" + path("a.png") + "': File too large"));
  EXPECT_EQ(text_of("a.png"), "old");
  EXPECT_EQ(text_of("b.png").size(), 900u);
  EXPECT_EQ(files(), 2);
}

TEST_F(AtomicFileTest, FollowsSymbolicLinks) {
  fs::create_directory(folder_ / "elsewhere");
  put("elsewhere/real.png", "old");
  fs::create_symlink("elsewhere/real.png", folder_ / "link.png");
  AtomicFile file;
  ASSERT_TRUE(file.create(path("link.png")));
  file.write("new", 3);
  EXPECT_TRUE(file.commit());
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.png"));
  EXPECT_EQ(text_of("elsewhere/real.png"), "new");
}

TEST_F(AtomicFileTest, FollowsSymbolicLinksToFilesThatAreStillToCome) {
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink("elsewhere/second.png", folder_ / "first.png");
  fs::create_symlink("third.png", folder_ / "elsewhere/second.png");
  AtomicFile file;
  ASSERT_TRUE(file.create(path("first.png")));
  file.write("new", 3);
  EXPECT_TRUE(file.commit());
  EXPECT_TRUE(fs::is_symlink(folder_ / "first.png"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "elsewhere/second.png"));
  EXPECT_EQ(text_of("elsewhere/third.png"), "new");
}

TEST_F(AtomicFileTest, RefusesSymbolicLinksThatLeadNowhere) {
  fs::create_symlink("b.png", folder_ / "a.png");
  fs::create_symlink("a.png", folder_ / "b.png");
  fs::create_symlink("missing/x.png", folder_ / "c.png");
  AtomicFile file;
  EXPECT_THAT(file.create(path("a.png")).error, HasSubstr("Too many levels of symbolic links"));
  EXPECT_THAT(file.create(path("c.png")).error, HasSubstr("there is no folder '" + path("missing") + "'"));
}

TEST_F(AtomicFileTest, ObeysTheUmask) {
  const mode_t old = umask(027);
  AtomicFile file;
  EXPECT_TRUE(file.create(path("a.png")));
  EXPECT_TRUE(file.commit());
  umask(old);
  EXPECT_EQ(static_cast<unsigned>(fs::status(path("a.png")).permissions()), 0640u);
}

TEST_F(AtomicFileTest, TakesTheLongestNames) {
  const std::string name = std::string(251, 'n') + ".png";
  AtomicFile file;
  ASSERT_TRUE(file.create(path(name)));
  EXPECT_TRUE(file.commit());
  EXPECT_TRUE(fs::exists(path(name)));
}

TEST_F(AtomicFileTest, SaysWhatIsWrongWithTheName) {
  put("file", "");
  fs::create_directory(folder_ / "folder.png");
  ASSERT_EQ(mkfifo(path("fifo.png").c_str(), 0600), 0);
  const std::pair<std::string, std::string> cases[] = {
      {"", "not a file name"},
      {std::string("a\0b.png", 7), "not a file name"},
      {path("missing/a.png"), "there is no folder '" + path("missing") + "'"},
      {path("file/a.png"), "file' is not a folder"},
      {path("folder.png"), "it is a folder"},
      {path("fifo.png"), "it is not a regular file"},
      {"/dev/null", "it is not a regular file"},
      {path(std::string(300, 'n') + ".png"), "File name too long"},
  };
  const int before = files();
  for (const auto& [name, complaint] : cases) {
    AtomicFile file;
    const IoStatus status = file.create(name);
    EXPECT_THAT(status.error, HasSubstr("cannot write '" + name + "': "));
    EXPECT_THAT(status.error, HasSubstr(complaint));
    EXPECT_FALSE(file.write("x", 1));
    EXPECT_FALSE(file.commit());
  }
  EXPECT_EQ(files(), before);
}

}  // namespace
}  // namespace norrsken
