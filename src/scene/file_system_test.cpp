#include "scene/file_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>

#include "scene/memory_files.h"
#include "scene/read_files.h"
#include "tests/temporary_folder.h"

namespace norrsken {

// This program's own built-in files, in place of those of scenes/.
std::vector<std::pair<std::string_view, std::string_view>> builtin_files() {
  return {{"room/room.xml", "<scene/>"}, {"room/parts/wall.obj", "v 0 0 0"}};
}

namespace {

class FileSystemTest : public testing::Test {
 protected:
  std::string error_of(const std::string& path) {
    std::string error;
    EXPECT_FALSE(files_.read(path, error).has_value());
    return error;
  }

  FileSystem files_;
  const TemporaryFolder folder_;
};

TEST_F(FileSystemTest, ReadsWholeFiles) {
  std::string contents(100000, 'x');
  contents[5] = '\0';
  std::string error;
  EXPECT_EQ(files_.read(folder_.write("a.bin", contents), error), contents);
  EXPECT_EQ(files_.read(folder_.write("empty", ""), error), "");
  EXPECT_EQ(error, "");
}

TEST_F(FileSystemTest, ReadsFilesThatClaimToBeEmpty) {
  std::string error;
  const auto status = files_.read("/proc/self/status", error);
  ASSERT_TRUE(status.has_value()) << error;
  EXPECT_NE(status->find("Pid:"), std::string::npos);
}

TEST_F(FileSystemTest, RefusesWhatIsNotAFile) {
  EXPECT_EQ(error_of(folder_.file("missing")), "no such file");
  EXPECT_EQ(error_of(folder_.write("file", "x") + "/below"), "Not a directory");
  EXPECT_EQ(error_of(folder_.string()), "is a folder");
  EXPECT_EQ(error_of("/dev/zero"), "is not a regular file");
  const std::string pipe = folder_.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(error_of(pipe), "is not a regular file");

  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = folder_.file("socket");
  std::strncpy(address.sun_path, name.c_str(), sizeof(address.sun_path) - 1);
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_EQ(error_of(name), "is not a regular file");
  ::close(socket);
}

TEST_F(FileSystemTest, RefusesHugeFilesBeforeReadingThem) {
  const std::string path = folder_.write("huge", "");
  std::filesystem::resize_file(path, (std::uintmax_t{4} << 30) + 1);  // a hole: takes no room on the disk
  EXPECT_EQ(error_of(path), "is larger than 4 GiB");
}

TEST_F(FileSystemTest, KnowsBuiltinFiles) {
  std::string error;
  EXPECT_EQ(files_.read("builtin:room/room.xml", error), "<scene/>");
  EXPECT_EQ(files_.read("builtin:room/../room/./parts/wall.obj", error), "v 0 0 0");
  EXPECT_EQ(error_of("builtin:room/other.xml"), "no such built-in file");
  EXPECT_TRUE(files_.exists("builtin:room/room.xml"));
  EXPECT_TRUE(files_.exists("builtin:room/parts"));
  EXPECT_TRUE(files_.exists("builtin:room/parts/"));
  EXPECT_FALSE(files_.exists("builtin:roo"));
  EXPECT_TRUE(files_.is_folder("builtin:room/parts"));
  EXPECT_TRUE(files_.is_folder("builtin:room/parts/"));
  EXPECT_TRUE(files_.is_folder("builtin:"));
  EXPECT_FALSE(files_.is_folder("builtin:roo"));
  EXPECT_FALSE(files_.is_folder("builtin:room/room.xml"));
}

TEST_F(FileSystemTest, RecordsWhatWasReadAndWhatItHeld) {
  const std::string a = folder_.write("a", "first"), b = folder_.write("b", "second"), c = folder_.write("c", "first");
  const auto record = [](const std::vector<std::string>& paths) {
    auto files = std::make_unique<RecordedFiles>();
    std::string error;
    for (const std::string& path : paths) files->read(path, error);
    return files;
  };
  EXPECT_THAT(record({b, a, b, "builtin:room/room.xml", folder_.file("missing")})->paths(), testing::ElementsAre(a, b));
  const std::string both = record({a, b})->fingerprint();
  EXPECT_EQ(both.size(), 32u);
  EXPECT_EQ(both, record({b, c, a, b})->fingerprint()) << "order, names and repetitions do not count";
  EXPECT_NE(both, record({a})->fingerprint());
  EXPECT_NE(both, record({a, b, "builtin:room/room.xml"})->fingerprint());
  folder_.write("a", "First");
  EXPECT_NE(both, record({a, b})->fingerprint());
}

TEST(ResolveFile, LooksInTheFoldersInTheirOrder) {
  const MemoryFiles files(
      {{"scenes/room.xml", ""}, {"scenes/a.obj", ""}, {"lib/a.obj", ""}, {"lib/b.obj", ""}, {"/abs/c.obj", ""}});
  const std::vector<std::string> folders{"scenes/", "other", "lib"};
  EXPECT_EQ(resolve_file(files, "a.obj", folders), "scenes/a.obj");
  EXPECT_EQ(resolve_file(files, "b.obj", folders), "lib/b.obj");
  EXPECT_EQ(resolve_file(files, "c.obj", folders), "");
  EXPECT_EQ(resolve_file(files, "/abs/c.obj", folders), "/abs/c.obj");
  EXPECT_EQ(resolve_file(files, "scenes/a.obj", {""}), "scenes/a.obj");
  EXPECT_EQ(resolve_file(files, "", folders), "");
}

TEST(ResolveFile, TellsOfASecondFileOfThatName) {
  const MemoryFiles files({{"scenes/a.obj", ""}, {"lib/a.obj", ""}, {"lib/b.obj", ""}});
  const auto other = [&files](const std::string& name, const std::vector<std::string>& folders) {
    std::string second;
    resolve_file(files, name, folders, &second);
    return second;
  };
  EXPECT_EQ(other("a.obj", {"scenes/", "lib"}), "lib/a.obj");
  EXPECT_EQ(other("a.obj", {"scenes/", "scenes", "scenes/../scenes/"}), "") << "the same file";
  EXPECT_EQ(other("b.obj", {"scenes/", "lib"}), "");
  EXPECT_EQ(other("c.obj", {"scenes/", "lib"}), "");
}

TEST(ResolveFile, StaysWithinTheBuiltinScene) {
  const FileSystem files;
  EXPECT_EQ(resolve_file(files, "parts/wall.obj", {"builtin:room/"}), "builtin:room/parts/wall.obj");
  EXPECT_EQ(resolve_file(files, "room/room.xml", {"builtin:"}), "builtin:room/room.xml");
}

TEST(AcceptedFiles, NameTheFoldersAndTheBuiltInFiles) {
  EXPECT_EQ(accepted_files("a.obj", {"", "lib"}), "a file in the current folder, lib");
  EXPECT_EQ(accepted_files("a.obj", {"dir/", "lib", "dir/"}), "a file in dir/, lib");
  EXPECT_EQ(accepted_files("/a.obj", {"dir/"}), "the path of an existing file");
  EXPECT_EQ(accepted_files("builtin:a.obj", {"dir/"}), "builtin:room/room.xml, builtin:room/parts/wall.obj");
  EXPECT_EQ(accepted_files("a.obj", {"builtin:room/parts/", "builtin:room/"}),
            "a file in builtin:room/parts/, builtin:room/ (wall.obj)");
  EXPECT_EQ(accepted_files("a.obj", {"builtin:room/"}), "a file in builtin:room/ (room.xml, parts/wall.obj)");
  EXPECT_EQ(accepted_files("a.obj", {"builtin:"}), "a file in builtin: (room/room.xml, room/parts/wall.obj)");
}

}  // namespace
}  // namespace norrsken
