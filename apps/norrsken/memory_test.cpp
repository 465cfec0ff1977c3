// --max-memory as its users meet it, and what it counts against what the system says of the process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/process.h"
#include "tests/temporary_folder.h"

namespace norrsken::cli {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::MatchesRegex;

constexpr std::uint64_t kMebibyte = 1 << 20;

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof raw);
}

/// A wavy sheet of about a million triangles.
std::string large_mesh() {
  constexpr std::uint32_t kSide = 700;
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(kSide * kSide) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(2 * (kSide - 1) * (kSide - 1)) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      append(bytes, static_cast<float>(x) / kSide);
      append(bytes, static_cast<float>(y) / kSide);
      append(bytes, static_cast<float>(x * y % 17) / (17 * kSide));
    }
  }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t i = y * kSide + x;
      for (const std::array<std::uint32_t, 3> t :
           {std::array{i, i + 1, i + kSide}, {i + 1, i + kSide + 1, i + kSide}}) {
        bytes += '\3';
        for (const std::uint32_t vertex : t) append(bytes, vertex);
      }
    }
  }
  return bytes;
}

std::string large_texture() {
  constexpr std::uint16_t kSide = 4000;
  std::string bytes(12, '\0');
  bytes[2] = 2;
  append(bytes, kSide);
  append(bytes, kSide);
  bytes += std::string("\x18\x20", 2);
  return bytes + std::string(std::size_t{3} * kSide * kSide, '\x55');
}

class MaxMemory : public testing::Test {
 protected:
  ProcessResult run(const std::vector<std::string>& arguments, ProcessOptions options = {}) const {
    options.folder = folder_.string();
    return run_program(arguments, options);
  }
  /// A scene of an 8 x 8 film with these elements, which begin in line 4.
  void write_scene(const std::string& elements) const {
    write("scene.xml",
          "<scene version=\"3.0.0\">\n<sensor type=\"perspective\"><film type=\"hdrfilm\"><integer "
          "name=\"width\" value=\"8\"/>\n<integer name=\"height\" value=\"8\"/></film></sensor>\n" +
              elements + "\n<emitter type=\"constant\"/>\n</scene>\n");
  }
  void write(const std::string& name, const std::string& bytes) const { folder_.write(name, bytes); }
  void write_mesh_scene() const {
    write("mesh.ply", large_mesh());
    write_scene(R"(<shape type="ply"><string name="filename" value="mesh.ply"/></shape>)");
  }
  void write_texture_scene() const {
    write("image.tga", large_texture());
    write_scene(
        R"(<texture type="bitmap"><string name="filename" value="image.tga"/></texture><shape type="sphere"/>)");
  }
  ProcessResult render(const std::vector<std::string>& more = {}, const char* spp = "1") const {
    std::vector<std::string> arguments = {"render",    "scene.xml", "--spp", spp,    "--quiet",
                                          "--threads", "2",         "-o",    "a.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  const TemporaryFolder folder_;
};

/// The program itself.
constexpr std::uint64_t kProgram = 40 * kMebibyte;

/// What is counted is what is taken, within a fifth.
void expect_near(std::uint64_t counted, std::uint64_t measured, std::uint64_t program, double factor = 1.2) {
  EXPECT_LT(static_cast<double>(counted), factor * static_cast<double>(measured))
      << counted / kMebibyte << " MiB counted, " << measured / kMebibyte << " MiB measured";
  EXPECT_LT(static_cast<double>(measured), factor * static_cast<double>(counted) + static_cast<double>(program))
      << counted / kMebibyte << " MiB counted, " << measured / kMebibyte << " MiB measured";
}

TEST_F(MaxMemory, CountsWhatAMeshTakes) {
  write_mesh_scene();
  const ProcessResult info = run({"info", "scene.xml", "--json"});
  ASSERT_EQ(info.status, 0) << info.err;
  const auto memory = nlohmann::json::parse(info.out).at("memory");
  const auto loading = memory.at("loading_peak_bytes").get<std::uint64_t>();
  expect_near(loading, info.peak_memory, kProgram);
  EXPECT_GT(loading, 48 * kMebibyte) << "large enough to tell";

  // With the acceleration structure, of which there is but an estimate before.
  const ProcessResult rendered = render();
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  const std::uint64_t resident =
      memory.at("geometry_bytes").get<std::uint64_t>() + memory.at("acceleration_estimate_bytes").get<std::uint64_t>();
  expect_near(resident, rendered.peak_memory, kProgram, 2);
}

TEST_F(MaxMemory, CountsWhatATextureTakes) {
  write_texture_scene();
  const ProcessResult info = run({"info", "scene.xml", "--json"});
  ASSERT_EQ(info.status, 0) << info.err;
  const auto memory = nlohmann::json::parse(info.out).at("memory");
  expect_near(memory.at("loading_peak_bytes").get<std::uint64_t>(), info.peak_memory, kProgram);
}

TEST_F(MaxMemory, CountsWhatAFilmTakes) {
  write_scene(R"(<shape type="sphere"/>)");
  const std::vector<std::string> size = {"--size", "1024x1024", "--layers"};
  const ProcessResult info = run({"info", "scene.xml", "--json", "--size", "1024x1024"});
  ASSERT_EQ(info.status, 0) << info.err;
  const auto memory = nlohmann::json::parse(info.out).at("memory");
  const std::uint64_t counted =
      memory.at("film_bytes").get<std::uint64_t>() + memory.at("image_bytes").get<std::uint64_t>();
  // Of the film, what nobody has written to takes no memory: a sample of each replicate.
  const ProcessResult rendered = render(size, "4");
  ASSERT_EQ(rendered.status, 0) << rendered.err;
  expect_near(counted, rendered.peak_memory, kProgram);
}

/// Whatever the limit: what is accepted stays within it, and what is not is told.
TEST_F(MaxMemory, IsKept) {
  write_mesh_scene();
  const std::uint64_t needed = render().peak_memory;
  int accepted = 0, refused = 0;
  for (const double share : {0.25, 0.4, 0.6, 0.8, 1.3, 1.6}) {
    const auto limit = static_cast<std::uint64_t>(share * static_cast<double>(needed));
    const ProcessResult result = render({"--max-memory", std::to_string(limit)});
    if (result.status == 0) {
      ++accepted;
      EXPECT_LT(result.peak_memory, limit + 16 * kMebibyte) << "with " << share << " of what it takes";
    } else {
      ++refused;
      // The scene's data is at fault, unless what the command line's threads work on is what does not fit.
      EXPECT_EQ(result.status, result.err.find("threads work on") == std::string::npos ? 65 : 64) << result.err;
      EXPECT_THAT(result.err, HasSubstr("does not fit into memory: it needs at least"));
      EXPECT_LT(result.peak_memory, limit + 16 * kMebibyte);
      EXPECT_LT(share, 1.3) << result.err;
    }
  }
  EXPECT_GE(accepted, 2);
  EXPECT_GE(refused, 3);
  EXPECT_EQ(render({"--max-memory", "none"}).status, 0);
}

TEST_F(MaxMemory, TellsPlaceAndRemedy) {
  write_mesh_scene();
  const ProcessResult mesh = render({"--max-memory", "40M"});
  EXPECT_EQ(mesh.status, 65);
  EXPECT_THAT(mesh.err, MatchesRegex("scene.xml:4:50: error: shape 'ply' does not fit into memory: it needs at least "
                                     "[0-9.]+ MiB, and [0-9.]+ MiB of 40.0 MiB are left\n"
                                     "[^\n]*<shape type=[^\n]*\n[^\n]*\\^[^\n]*\n"
                                     "accepted: up to [0-9.]+ MiB, or a larger --max-memory\n"));
  write_texture_scene();
  const ProcessResult image = render({"--max-memory", "100M"});
  EXPECT_EQ(image.status, 65);
  EXPECT_THAT(image.err, HasSubstr("scene.xml:4:55: error: image 'image.tga' does not fit into memory: it needs at"));
  const ProcessResult film = render({"--max-memory", "300M", "--size", "4096x4096"});
  EXPECT_EQ(film.status, 64);
  EXPECT_THAT(film.err, AllOf(HasSubstr("a film of 4096 x 4096 pixels with its image needs 2.61 GiB, and "),
                              HasSubstr("as by a smaller --size, or a larger --max-memory")));
  EXPECT_LT(film.peak_memory, 100 * kMebibyte) << "told before anything is loaded";
  write_scene(R"(<shape type="sphere"/>)");
  const ProcessResult threads = render({"--max-memory", "100M", "--threads", "1024"});
  EXPECT_EQ(threads.status, 64);
  EXPECT_THAT(threads.err, HasSubstr("what 1024 threads work on does not fit into memory: it needs at least"));
}

TEST_F(MaxMemory, HoldsForEveryCommandThatReadsMuch) {
  write_scene(R"(<shape type="sphere"/>)");
  ASSERT_EQ(render({"--size", "512x512", "--checkpoint", "a.part"}).status, 0);
  const std::vector<std::string> little = {"--max-memory", "30M"};
  const auto refused = [&](std::vector<std::string> arguments, int status) {
    arguments.insert(arguments.end(), little.begin(), little.end());
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.status, status) << arguments[0] << ": " << result.err;
    EXPECT_THAT(result.err, AnyOf(HasSubstr("it needs "), HasSubstr("image needs"))) << arguments[0];
  };
  refused({"bench", "scene.xml", "--size", "512x512"}, 64);
  refused({"merge", "a.part", "-o", "b.exr"}, 65);
  refused({"compare", "a.exr", "a.exr"}, 65);
  EXPECT_EQ(run({"figures", "--quick", "-o", "out", "--quiet", "--max-memory", "12M"}).status, 64);
  EXPECT_EQ(run({"merge", "a.part", "-o", "b.exr", "--quiet", "--max-memory", "400M"}).status, 0);
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--max-memory", "400M"}).status, 0);
  // What has no film needs no memory for it.
  EXPECT_EQ(run({"info", "scene.xml", "--size", "16384x16384", "--max-memory", "30M"}).status, 0);
  EXPECT_EQ(run({"render", "scene.xml", "--size", "16384x16384", "--pixel", "8000,8000", "--sample", "0",
                 "--max-memory", "30M"})
                .status,
            0);
  for (const char* size : {"0", "4X", "-1G", "G", "1e99", "nan", "inf"}) {
    const ProcessResult result = run({"info", "scene.xml", "--max-memory", size});
    EXPECT_EQ(result.status, 64) << size;
  }
}

/// A system that gives less than the program counts on ends it with a word, not with a crash.
TEST_F(MaxMemory, LimitsOfTheSystemAreErrorsToo) {
  write_mesh_scene();
  const std::uint64_t needed = render().peak_memory;
  int refused = 0;
  for (const double share : {0.3, 0.6, 0.9}) {
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--max-memory", "none"}}) {
      ProcessOptions options;
      options.address_space = static_cast<std::uint64_t>(share * static_cast<double>(needed)) + 60 * kMebibyte;
      std::vector<std::string> arguments = {"render", "scene.xml", "--spp", "1", "--quiet", "--threads", "1"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const ProcessResult result = run(arguments, options);
      EXPECT_THAT(result.status, AnyOf(0, 64, 65, 70)) << share << ": " << result.err;
      if (result.status == 0) continue;
      ++refused;
      EXPECT_THAT(result.err, AnyOf(HasSubstr("memory"), HasSubstr("no more threads"))) << share;
    }
  }
  EXPECT_GE(refused, 4);
}

}  // namespace
}  // namespace norrsken::cli
