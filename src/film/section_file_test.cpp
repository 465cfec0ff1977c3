// Files of sections: what was written is read, and whatever else is in the file is not believed.
#include "film/section_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

namespace fs = std::filesystem;
using State = SectionReader::State;

constexpr std::uint32_t kVersion = 7;

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

class SectionFile : public testing::Test {
 protected:
  IoStatus write(const std::string& first, const std::string& second, OlderGeneration older = OlderGeneration::keep) {
    const Section sections[] = {{"first", bytes_of(first)}, {"second", bytes_of(second)}};
    return write_sections(path_, kVersion, sections, older);
  }
  /// Both sections, or the complaint.
  static std::string read(const std::string& path, std::size_t first_size = 5, std::size_t second_size = 3) {
    SectionReader reader(path, kVersion);
    std::string first(first_size, '?'), second(second_size, '?');
    if (reader.read("first", std::as_writable_bytes(std::span(first))) &&
        reader.read("second", std::as_writable_bytes(std::span(second))) && reader.at_end()) {
      return first + "|" + second;
    }
    EXPECT_NE(reader.state(), State::readable);
    return reader.complaint();
  }
  static std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void put(const std::string& text) const { folder_.write("file", text); }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_.file("file");
};

TEST_F(SectionFile, IsReadAsItWasWritten) {
  ASSERT_TRUE(write("hello", "you"));
  EXPECT_EQ(read(path_), "hello|you");
  EXPECT_THAT(files(), testing::ElementsAre("file"));
}

TEST_F(SectionFile, KeepsOneOlderGeneration) {
  for (const char* text : {"one..", "two..", "three"}) ASSERT_TRUE(write(text, "abc"));
  EXPECT_EQ(read(path_), "three|abc");
  EXPECT_EQ(read(older_generation_of(path_)), "two..|abc");
  ASSERT_TRUE(write("four.", "abc", OlderGeneration::replace));
  EXPECT_EQ(read(path_), "four.|abc");
  EXPECT_EQ(read(older_generation_of(path_)), "two..|abc");
  EXPECT_THAT(files(), testing::ElementsAre("file", "file.1"));
}

TEST_F(SectionFile, NoTruncatedFileIsBelieved) {
  ASSERT_TRUE(write("hello", "you"));
  const std::string whole = contents(path_);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    put(whole.substr(0, size));
    EXPECT_NE(read(path_), "hello|you") << size;
  }
  put(whole + "x");
  EXPECT_NE(read(path_), "hello|you") << "one byte more";
}

TEST_F(SectionFile, NoFlippedBitIsBelieved) {
  ASSERT_TRUE(write("hello", "you"));
  const std::string whole = contents(path_);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
    put(flipped);
    EXPECT_NE(read(path_), "hello|you") << bit;
  }
}

TEST_F(SectionFile, SectionsOfTwoFilesDoNotMix) {
  ASSERT_TRUE(write("hello", "you"));
  const std::string one = contents(path_);
  ASSERT_TRUE(write("HELLO", "YOU"));
  const std::string other = contents(path_);
  // The second section with its head, 40 bytes.
  put(one.substr(0, one.size() - 43) + other.substr(other.size() - 43));
  EXPECT_EQ(read(path_), "is damaged in the head of section 2");
}

TEST_F(SectionFile, SaysWhatIsWrong) {
  const auto state_of = [&] { return SectionReader(path_, kVersion).state(); };
  EXPECT_EQ(state_of(), State::missing);
  put("PNG");
  EXPECT_EQ(state_of(), State::foreign);
  EXPECT_EQ(read(path_), "does not begin as checkpoints do");
  ASSERT_TRUE(write("hello", "you"));
  EXPECT_EQ(SectionReader(path_, kVersion + 1).state(), State::other_version);
  EXPECT_EQ(SectionReader(path_, kVersion + 1).complaint(), "has format 7, this program reads format 8");
  EXPECT_EQ(read(path_, 6), "has no section 'first' of 6 bytes where one is expected");
  const std::string whole = contents(path_);
  put(whole.substr(0, 100));
  EXPECT_EQ(read(path_), "has 100 of 120 bytes");
  std::string flipped = whole;
  flipped[32 + 40 + 1] = 'a';
  put(flipped);
  EXPECT_EQ(read(path_), "is damaged in section 'first'");
  fs::remove(path_);
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(read(path_), "is not a regular file");
}

TEST_F(SectionFile, LargeSectionsAreNotReadIntoSmallMemory) {
  ASSERT_TRUE(write("hello", "you"));
  SectionReader reader(path_, kVersion);
  std::vector<std::byte> content;
  EXPECT_FALSE(reader.read("first", content, 4));
  EXPECT_TRUE(content.empty());
}

TEST_F(SectionFile, AFullDiskCostsNeitherGeneration) {
  ASSERT_TRUE(write("one..", "abc"));
  ASSERT_TRUE(write("two..", "abc"));
  // A limit on the size of files fails in the same places as a full disk.
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t limit : {0, 10, 50, 100, 119}) {
    const rlimit small{limit, old.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const IoStatus status = write("three", "abc");
    setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_EQ(status.error, "cannot write '" + path_ + "': File too large") << limit;
    EXPECT_EQ(read(path_), "two..|abc");
    EXPECT_EQ(read(older_generation_of(path_)), "one..|abc");
    EXPECT_THAT(files(), testing::ElementsAre("file", "file.1"));
  }
  std::signal(SIGXFSZ, old_handler);
  ASSERT_TRUE(write("three", "abc"));
  EXPECT_EQ(read(path_), "three|abc");
}

TEST_F(SectionFile, WhatIsLeftOfAKilledWritingIsNoHindrance) {
  for (const std::string& left : {"\x89Norrsk\n half of a file, and longer than the new one: " + std::string(1000, 'x'),
                                  std::string("\x89No"), std::string(512, '\0'), std::string()}) {
    std::ofstream(path_ + ".tmp") << left;
    ASSERT_TRUE(write("hello", "you"));
    EXPECT_EQ(read(path_), "hello|you");
    EXPECT_THAT(files(), testing::ElementsAre("file"));
    fs::remove(path_);
  }
}

TEST_F(SectionFile, WhatIsNoCheckpointIsNotWrittenOver) {
  for (const std::string suffix : {".tmp", ".1"}) {
    std::ofstream(path_ + suffix) << "a thesis";
    const std::string complaint =
        "cannot write '" + path_ + "': '" + path_ + suffix + "' is in the way, which is no checkpoint";
    EXPECT_EQ(check_sections_writable(path_).error, complaint);
    EXPECT_EQ(write("hello", "you").error, complaint);
    std::string kept;
    std::getline(std::ifstream(path_ + suffix), kept);
    EXPECT_EQ(kept, "a thesis");
    fs::remove(path_ + suffix);
  }
}

TEST_F(SectionFile, RefusesWhatCannotBeWritten) {
  EXPECT_EQ(check_sections_writable("/proc/none").error, "cannot write '/proc/none': No such file or directory");
  EXPECT_EQ(check_sections_writable("").error, "cannot write '': not a file name");
  fs::create_directory(path_);
  EXPECT_EQ(check_sections_writable(path_).error, "cannot write '" + path_ + "': it is a folder");
  EXPECT_EQ(write("hello", "you").error, "cannot write '" + path_ + "': it is a folder");
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  chmod(folder_.path().c_str(), 0555);
  EXPECT_EQ(check_sections_writable(folder_.file("other")).error,
            "cannot write '" + folder_.file("other") + "': Permission denied");
  chmod(folder_.path().c_str(), 0755);
}

TEST_F(SectionFile, CheckingLeavesNothing) {
  EXPECT_TRUE(check_sections_writable(path_));
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace norrsken
