// Names of what is no file, wherever a file is read: each ends in an error that names it and its place, and none is
// waited for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "norrsken/merge.h"
#include "tests/end_to_end/scene_folder.h"
#include "tests/told.h"

namespace norrsken::end_to_end {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// What the reader said, and where.
struct Complaint {
  std::string text;
  bool has_place = false;
};

/// A way for a file to be read.
struct Input {
  const char* name;
  const char* element;  ///< in a scene, with % for the file's name; empty for inputs that no scene names

  friend void PrintTo(const Input& input, std::ostream* out) { *out << input.name; }
};

const Input kInputs[] = {
    {"scene", ""},
    {"checkpoint", ""},
    {"merged", ""},
    {"compared", ""},
    {"include", R"(<include filename="%"/>)"},
    {"spectrum", R"(<bsdf type="diffuse" id="b"><spectrum name="reflectance" filename="%"/></bsdf>)"},
    {"obj", R"(<shape type="obj"><string name="filename" value="%"/></shape>)"},
    {"ply", R"(<shape type="ply"><string name="filename" value="%"/></shape>)"},
    {"serialized", R"(<shape type="serialized"><string name="filename" value="%"/></shape>)"},
    {"sdfgrid", R"(<shape type="sdfgrid"><string name="filename" value="%"/></shape>)"},
    {"linearcurve", R"(<shape type="linearcurve"><string name="filename" value="%"/></shape>)"},
    {"bsplinecurve", R"(<shape type="bsplinecurve"><string name="filename" value="%"/></shape>)"},
    {"bitmap", R"(<shape type="disk"><bsdf type="diffuse"><texture type="bitmap" name="reflectance">
                  <string name="filename" value="%"/></texture></bsdf></shape>)"},
    {"envmap", R"(<emitter type="envmap"><string name="filename" value="%"/></emitter>)"},
};

/// A name that is none of a file with something in it, and what is said about it: "" where that differs by reader.
struct Hostile {
  const char* name;
  const char* path;  ///< in the test's folder unless it begins with a slash
  const char* said;

  friend void PrintTo(const Hostile& hostile, std::ostream* out) { *out << hostile.path; }
};

const Hostile kHostile[] = {
    {"zero", "/dev/zero", "is not a regular file"},
    {"full", "/dev/full", "is not a regular file"},
    {"null", "/dev/null", "is not a regular file"},
    {"stdin", "/dev/stdin", "is not a regular file"},
    {"fifo", "fifo", "is not a regular file"},
    {"link_to_fifo", "link_to_fifo", "is not a regular file"},
    {"folder", "folder", "is a folder"},
    {"loop", "loop", ""},
    {"unreadable", "unreadable", "Permission denied"},
    {"empty", "empty", ""},
};

class HostileFile : public SceneFolder, public ::testing::WithParamInterface<std::tuple<Input, Hostile>> {
 protected:
  void SetUp() override {
    SceneFolder::SetUp();
    ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);
    fs::create_symlink("fifo", path("link_to_fifo"));
    fs::create_directory(path("folder"));
    fs::create_symlink("loop", path("loop"));
    write("empty", "");
    write("unreadable", "secret");
    fs::permissions(path("unreadable"), fs::perms::none);
    // Standard input is a pipe whose other end is open and silent.
    ASSERT_EQ(pipe(pipe_.data()), 0);
    stdin_ = dup(STDIN_FILENO);
    ASSERT_EQ(dup2(pipe_[0], STDIN_FILENO), STDIN_FILENO);
    alarm(300);  // ends the test if something waits
  }
  void TearDown() override {
    alarm(0);
    if (stdin_ >= 0) dup2(stdin_, STDIN_FILENO);
    for (const int end : {pipe_[0], pipe_[1], stdin_}) close(end);
    SceneFolder::TearDown();
  }

  Complaint first_error(const Diagnostics& diagnostics) const {
    for (const Diagnostic& d : diagnostics.all()) {
      if (d.severity == Diagnostic::Severity::error) return {to_text(d), !d.location.file.empty()};
    }
    return {};
  }

  Complaint load_scene(const std::string& file) const {
    Diagnostics diagnostics;
    EXPECT_FALSE(told(Scene::load(file, {}), diagnostics).has_value());
    return first_error(diagnostics);
  }

  Complaint read(const Input& input, const std::string& file) const {
    const std::string kind = input.name;
    if (kind == "scene") return load_scene(file);
    if (kind == "merged") {
      MergedRender merged;
      return {merge_renders({file}).error(), true};
    }
    if (kind == "compared") return {read_image(file).error(), true};
    if (kind == "checkpoint") {
      Diagnostics diagnostics;
      RenderOptions options;
      options.threads = 1;
      options.checkpoint = file;
      const Scene scene = load_elements(camera(4) + R"(<shape type="sphere"/><emitter type="constant"/>)");
      EXPECT_EQ(told(Render::create(scene, options), diagnostics), nullptr);
      return first_error(diagnostics);
    }
    std::string element = input.element;
    element.replace(element.find('%'), 1, file);
    write("scene.xml", "<scene version=\"3.0.0\">" + camera(4) + element +
                           R"(<shape type="sphere"/><emitter type="point"/></scene>)");
    return load_scene(path("scene.xml"));
  }

 private:
  std::array<int, 2> pipe_{-1, -1};
  int stdin_ = -1;
};

TEST_P(HostileFile, EndsInAnErrorWithItsPlace) {
  const auto& [input, hostile] = GetParam();
  if (geteuid() == 0 && std::string_view(hostile.name) == "unreadable") GTEST_SKIP() << "root may read everything";
  const std::string file = hostile.path[0] == '/' ? hostile.path : path(hostile.path);
  const Complaint complaint = read(input, file);
  ASSERT_NE(complaint.text, "");
  // A name that leads nowhere is looked for as that of a built-in scene, too.
  if (std::string_view(input.name) != "scene") {
    EXPECT_TRUE(complaint.has_place) << complaint.text;
  }
  EXPECT_THAT(complaint.text, HasSubstr(file));
  EXPECT_THAT(complaint.text, HasSubstr(hostile.said));
}

INSTANTIATE_TEST_SUITE_P(, HostileFile, ::testing::Combine(::testing::ValuesIn(kInputs), ::testing::ValuesIn(kHostile)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) + "_" + std::get<1>(test.param).name;
                         });

}  // namespace
}  // namespace norrsken::end_to_end
