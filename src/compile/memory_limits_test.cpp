// Every kind of input within a memory that just suffices, and within one byte less.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "compile/compile_testing.h"

namespace norrsken::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Loaded {
  Compiled compiled;
  std::uint64_t peak, left_over;  ///< most that was counted at once, and what is when all is gone
};

Loaded load(const std::string& elements, const Files& files, std::uint64_t limit) {
  const auto budget = std::make_shared<MemoryBudget>(limit);
  LoadOptions options;
  options.memory = budget;
  Loaded loaded{compile_elements(elements, files, options), budget->peak(), 0};
  if (!loaded.compiled.scene) loaded.left_over = budget->used();
  return loaded;
}

/// The least limit with which the scene loads.
std::uint64_t least_memory(const std::string& elements, const Files& files) {
  std::uint64_t too_little = 0, enough = load(elements, files, MemoryBudget::kUnlimited).peak;
  while (enough - too_little > 1) {
    const std::uint64_t middle = too_little + (enough - too_little) / 2;
    (load(elements, files, middle).compiled.scene ? enough : too_little) = middle;
  }
  return enough;
}

template <class T>
void append(std::string& bytes, std::initializer_list<T> values) {
  for (const T value : values) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof raw);
  }
}

/// A square of n x n vertices in the plane z = 0.
constexpr std::uint32_t kSide = 40, kVertices = kSide * kSide, kTriangles = 2 * (kSide - 1) * (kSide - 1);
template <class UseVertex, class UseTriangle>
void visit_square(const UseVertex& vertex, const UseTriangle& triangle) {
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) vertex(static_cast<float>(x), static_cast<float>(y));
  }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t i = y * kSide + x;
      triangle(i, i + 1, i + kSide);
      triangle(i + 1, i + kSide + 1, i + kSide);
    }
  }
}

std::string obj() {
  std::string text;
  visit_square([&](float x, float y) { text += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n"; },
               [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                 text +=
                     "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
               });
  return text;
}

std::string ply() {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(kVertices) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(kTriangles) + "\nproperty list uchar int vertex_indices\nend_header\n";
  visit_square(
      [&](float x, float y) {
        append(bytes, {x, y, 0.0f});
      },
      [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        bytes += '\3';
        append(bytes, {a, b, c});
      });
  return bytes;
}

/// RFC 1950 and 1951, in blocks that are stored as they are.
std::string zlib_stored(const std::string& data) {
  std::string stream = "\x78\x01";
  std::uint32_t a = 1, b = 0;
  for (const char c : data) a = (a + static_cast<unsigned char>(c)) % 65521, b = (b + a) % 65521;
  for (std::size_t at = 0; at < data.size(); at += 65535) {
    const auto size = static_cast<std::uint16_t>(std::min<std::size_t>(data.size() - at, 65535));
    stream += at + size == data.size() ? '\1' : '\0';
    append(stream, {size, static_cast<std::uint16_t>(~size)});
    stream += data.substr(at, size);
  }
  for (const std::uint32_t byte : {b >> 8, b & 255, a >> 8, a & 255}) stream += static_cast<char>(byte);
  return stream;
}

std::string serialized() {
  std::string data;
  append<std::uint32_t>(data, {0x1000});
  data += '\0';
  append<std::uint64_t>(data, {kVertices, kTriangles});
  visit_square(
      [&](float x, float y) {
        append(data, {x, y, 0.0f});
      },
      [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        append(data, {x, y, z});
      });
  std::string bytes("\x1c\x04\x04\x00", 4);
  bytes += zlib_stored(data);
  append<std::uint64_t>(bytes, {0});
  append<std::uint32_t>(bytes, {1});
  return bytes;
}

std::string curve_points() {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += std::to_string(i) + " 0 0 0.1\n";
  return text;
}

std::string vol() {
  constexpr std::int32_t kAlong = 24;
  std::string bytes = "VOL\3";
  append<std::int32_t>(bytes, {1, kAlong, kAlong, kAlong, 1});
  append<float>(bytes, {0, 0, 0, 1, 1, 1});
  for (int i = 0; i < kAlong * kAlong * kAlong; ++i) append(bytes, {i % 2 == 0 ? 1.0f : -1.0f});
  return bytes;
}

std::string tga() {
  constexpr int kPixels = 100;
  std::string bytes(18, '\0');
  bytes[2] = 2, bytes[12] = kPixels, bytes[14] = kPixels, bytes[16] = 24, bytes[17] = 0x20;
  return bytes + std::string(3 * kPixels * kPixels, '\x55');
}

struct Case {
  const char* name;
  const char* elements;  ///< in place of "FILE" there is the file's name
  const char* file;
  std::string (*contents)();
  std::uint64_t resident;  ///< bytes that what is loaded takes at the least
  int line = 3;            ///< of the complaint when a byte is missing: 1 where it is the scene as a whole
};

constexpr std::uint64_t kMeshBytes = kVertices * 12 + kTriangles * (12 + sizeof(SurfaceRecord));

const Case kCases[] = {
    {"obj", R"(<shape type="obj"><string name="filename" value="FILE"/></shape>)", "a.obj", obj, kMeshBytes},
    {"ply", R"(<shape type="ply"><string name="filename" value="FILE"/></shape>)", "a.ply", ply, kMeshBytes},
    {"serialized", R"(<shape type="serialized"><string name="filename" value="FILE"/></shape>)", "a.serialized",
     serialized, kMeshBytes},
    {"light", R"(<shape type="ply"><emitter type="area"/><string name="filename" value="FILE"/></shape>)", "a.ply", ply,
     kMeshBytes + kTriangles / 2 * sizeof(LightRecord)},
    {"curves", R"(<shape type="bsplinecurve"><string name="filename" value="FILE"/></shape>)", "a.txt", curve_points,
     1000 * 16, 1},
    {"sdfgrid", R"(<shape type="sdfgrid"><string name="filename" value="FILE"/></shape>)", "a.vol", vol,
     24 * 24 * 24 * 4},
    {"bitmap", R"(<texture type="bitmap"><string name="filename" value="FILE"/></texture><shape type="sphere"/>)",
     "a.tga", tga, 4 * 100 * 100},
    {"envmap", R"(<emitter type="envmap"><string name="filename" value="FILE"/></emitter><shape type="sphere"/>)",
     "a.tga", tga, (4 + 12 + 8) * 100 * 100},
};

constexpr const char* kSmallSensor =
    R"(<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/>
<integer name="height" value="8"/><rfilter type="box"/></film></sensor><emitter type="point"/>)";

class MemoryLimit : public ::testing::TestWithParam<Case> {};

TEST_P(MemoryLimit, IsHeldToTheByte) {
  const Case& c = GetParam();
  std::string elements = kSmallSensor;
  elements += c.elements;
  elements.replace(elements.find("FILE"), 4, c.file);
  const Files files{{c.file, c.contents()}};
  const std::uint64_t least = least_memory(elements, files);

  const Loaded fits = load(elements, files, least);
  ASSERT_TRUE(fits.compiled.scene);
  EXPECT_THAT(fits.compiled.messages(), IsEmpty());
  EXPECT_EQ(fits.peak, least);
  EXPECT_GE(least, c.resident) << "something is not counted";
  EXPECT_LT(least, 64 * c.resident);

  const Loaded refused = load(elements, files, least - 1);
  EXPECT_FALSE(refused.compiled.scene);
  EXPECT_EQ(refused.left_over, 0u);
  EXPECT_THAT(refused.compiled.messages(), ElementsAre(HasSubstr("does not fit into memory: it needs at least")));
  EXPECT_THAT(refused.compiled.messages().at(0), HasSubstr(", or a larger --max-memory]"));
  EXPECT_EQ(refused.compiled.diagnostics.all().at(0).location.line, c.line);

  // With much less it is the thing itself that does not fit.
  const Loaded far = load(elements, files, least / 2);
  EXPECT_THAT(far.compiled.messages(), ElementsAre(HasSubstr("does not fit into memory: it needs at least")));
}

INSTANTIATE_TEST_SUITE_P(Inputs, MemoryLimit, ::testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(MemoryLimit, IsToldWithThePlaceAndTheFigures) {
  const std::string elements =
      std::string(kSmallSensor) + R"(<shape type="ply"><string name="filename" value="a.ply"/></shape>)";
  const Loaded refused = load(elements, {{"a.ply", ply()}}, 60000);
  ASSERT_EQ(refused.compiled.diagnostics.all().size(), 1u);
  // The film and its image, 64 pixels of 167 bytes, come first; then the file.
  EXPECT_THAT(refused.compiled.messages(),
              ElementsAre("error: shape 'ply' does not fit into memory: it needs at least 57.5 KiB, and 48.2 KiB of "
                          "58.6 KiB are left [up to 48.2 KiB, or a larger --max-memory]"));
  const SourceLocation& place = refused.compiled.diagnostics.all()[0].location;
  EXPECT_EQ(place.file, "scene.xml");
  EXPECT_EQ(place.line, 3);
  EXPECT_EQ(place.column, 144);
}

/// What text and element counts become is counted too.
TEST(MemoryLimit, HoldsForXml) {
  std::string xml = "<scene version=\"3.0.0\">\n";
  for (int i = 0; i < 2000; ++i) xml += "<shape type=\"sphere\"><float name=\"radius\" value=\"1\"/></shape>\n";
  const MemoryFiles files({{"scene.xml", xml + "</scene>\n"}});
  const auto read = [&](std::uint64_t limit) {
    const auto budget = std::make_shared<MemoryBudget>(limit);
    const MemoryScope scope(budget);
    Diagnostics diagnostics;
    try {
      read_mitsuba_xml("scene.xml", files, {}, diagnostics);
    } catch (const MemoryExceeded&) {
      EXPECT_EQ(budget->used(), 0u);
      return std::uint64_t{0};
    }
    return budget->peak();
  };
  const std::uint64_t needed = read(MemoryBudget::kUnlimited);
  EXPECT_GT(needed, 2000 * (sizeof(Node) + sizeof(Property)));
  EXPECT_EQ(read(needed), needed);
  EXPECT_EQ(read(needed - 1), 0u);
}

}  // namespace
}  // namespace norrsken::testing
