#include "scene/find_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "scene/memory_files.h"
#include "tests/temporary_folder.h"

namespace norrsken {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class FindFile : public testing::Test {
 protected:
  std::string find(const std::string& name, const std::vector<std::string>& folders = {"scene/", "lib"}) {
    return find_file(files_, name, folders, {}, " (from '$f')", diagnostics_);
  }
  /// What was said since it was asked last.
  std::vector<std::string> messages() {
    std::vector<std::string> lines;
    for (const Diagnostic& d : diagnostics_.all()) lines.push_back(std::string(name_of(d.severity)) + ": " + d.message);
    diagnostics_ = {};
    return lines;
  }

  MemoryFiles files_{{{"scene/textures/Wood.png", ""}, {"scene/a.obj", ""}, {"lib/a.obj", ""}, {"lib/b.obj", ""}}};
  Diagnostics diagnostics_;
};

TEST_F(FindFile, InTheFirstFolderThatHasIt) {
  EXPECT_EQ(find("b.obj"), "lib/b.obj");
  EXPECT_THAT(messages(), IsEmpty());
  EXPECT_EQ(find("a.obj"), "scene/a.obj");
  EXPECT_THAT(messages(), ElementsAre("warning: 'a.obj' is 'scene/a.obj' here, and there is 'lib/a.obj' too"));
}

TEST_F(FindFile, BackslashesAreSlashes) {
  EXPECT_EQ(find("textures\\Wood.png"), "scene/textures/Wood.png");
  EXPECT_THAT(messages(), ElementsAre("note: backslashes in paths are read as slashes"));
  // Unless a file has one in its name.
  files_.add("scene/textures\\Wood.png", "");
  EXPECT_EQ(find("textures\\Wood.png"), "scene/textures\\Wood.png");
  EXPECT_THAT(messages(), IsEmpty());
}

TEST_F(FindFile, TellsWhatIsThereInstead) {
  const auto said = [&](const std::string& name) {
    EXPECT_EQ(find(name), "") << name;
    return messages().at(0);
  };
  const std::string none = "error: there is no file ";
  EXPECT_EQ(said("Textures/wood.PNG"), none + "'Textures/wood.PNG' (from '$f'), but there is 'textures/Wood.png'");
  EXPECT_EQ(said("textures\\wood.png"), none + "'textures\\wood.png' (from '$f'), but there is 'textures/Wood.png'");
  EXPECT_EQ(said("./x/../textures/wood.png"),
            none + "'./x/../textures/wood.png' (from '$f'), but there is 'textures/Wood.png'");
  EXPECT_EQ(said("/home/me/b.obj"), none + "'/home/me/b.obj' (from '$f'), but there is 'b.obj'");
  EXPECT_EQ(said("C:\\Users\\me\\b.obj"), none + "'C:\\Users\\me\\b.obj' (from '$f'), but there is 'b.obj'");
  EXPECT_EQ(said("textures/Wood.jpg"), none + "'textures/Wood.jpg' (from '$f'), but there is 'textures/Wood.png'");
  EXPECT_EQ(said("c.obj"), none + "'c.obj' (from '$f')") << "quite another";
  EXPECT_EQ(said("quite/another.ply"), none + "'quite/another.ply' (from '$f')");
  EXPECT_EQ(said(""), none + "'' (from '$f')");
}

TEST(FindFileOnDisk, ListsFolders) {
  const TemporaryFolder folder;
  folder.write("Wood.png", "");
  const std::string inside = std::filesystem::path(folder.write("a.obj", "")).parent_path().string();
  const FileSystem files;
  EXPECT_THAT(files.list(inside), ElementsAre("Wood.png", "a.obj"));
  EXPECT_THAT(files.list(inside + "/none"), IsEmpty());
  Diagnostics diagnostics;
  EXPECT_EQ(find_file(files, "wood.png", {inside}, {}, "", diagnostics), "");
  EXPECT_EQ(diagnostics.all().at(0).message, "there is no file 'wood.png', but there is 'Wood.png'");
}

}  // namespace
}  // namespace norrsken
