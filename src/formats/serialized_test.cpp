#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>

#include "formats/mesh_readers.h"
#include "formats/reader_testing.h"

namespace norrsken {
namespace {

using Triangles = Array<std::array<std::uint32_t, 3>>;
using Points = Array<std::array<float, 3>>;

template <typename T>
std::string bytes_of(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

template <typename T>
std::string numbers(const std::vector<double>& values) {
  std::string bytes;
  for (const double value : values) bytes += bytes_of(static_cast<T>(value));
  return bytes;
}

std::string header(std::uint16_t version) { return bytes_of<std::uint16_t>(0x041c) + bytes_of(version); }

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  EXPECT_EQ(
      compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
      Z_OK);
  return out.substr(0, size);
}

/// What stands in front of a mesh's arrays.
std::string counts(std::uint16_t version, std::uint32_t flags, std::uint64_t vertices = 3,
                   std::uint64_t triangles = 1) {
  return bytes_of(flags) + (version == 4 ? std::string("name\0", 5) : "") + bytes_of(vertices) + bytes_of(triangles);
}

std::string indices(const std::vector<std::uint32_t>& values) {
  std::string bytes;
  for (const std::uint32_t value : values) bytes += bytes_of(value);
  return bytes;
}

constexpr std::uint16_t kVersions[] = {3, 4};
const std::vector<double> kCorners = {0, 0, 0, 1, 0, 0, 1, 1, 0};
const std::string kOneTriangle = numbers<float>(kCorners) + indices({0, 1, 2});

/// A triangle whose corners are moved to x, so that meshes can be told apart.
std::string mesh(std::uint16_t version, double x) {
  return header(version) +
         deflated(counts(version, 0x1000) + numbers<float>({x, 0, 0, x, 1, 0, x, 1, 1}) + indices({0, 1, 2}));
}

/// Three meshes at x = 0, 1, 2, and their dictionary.
std::string three(std::uint16_t version) {
  std::string bytes, dictionary;
  for (int i = 0; i < 3; ++i) {
    dictionary +=
        version == 4 ? bytes_of<std::uint64_t>(bytes.size()) : bytes_of(static_cast<std::uint32_t>(bytes.size()));
    bytes += mesh(version, i);
  }
  return bytes + dictionary + bytes_of<std::uint32_t>(3);
}

MeshData read(const std::string& bytes, std::int64_t shape_index = 0) {
  Diagnostics diagnostics;
  auto mesh = read_serialized(bytes, shape_index, "a.serialized", diagnostics);
  EXPECT_EQ(to_text(diagnostics), "");
  return mesh.value_or(MeshData{});
}

std::string complaints(const std::string& bytes, std::int64_t shape_index = 0) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_serialized(bytes, shape_index, "a.serialized", diagnostics).has_value());
  return to_text(diagnostics);
}

std::string complaints_about_mesh(const std::string& inflated) { return complaints(header(4) + deflated(inflated)); }

TEST(Serialized, BothVersionsAndPrecisions) {
  for (const std::uint16_t version : kVersions) {
    for (const bool is_double : {false, true}) {
      const auto floats = is_double ? numbers<double> : numbers<float>;
      const std::string inflated = counts(version, 0x000b | (is_double ? 0x2000 : 0x1000)) + floats(kCorners) +
                                   floats({0, 0, 1, 0, 0, 1, 0, 0, 1}) + floats({0, 0, 0.5, 0, 0.5, 0.25}) +
                                   floats({1, 0, 0, 0, 1, 0, 0, 0, 0.75}) + indices({2, 0, 1});
      const MeshData mesh = read(header(version) + deflated(inflated));
      EXPECT_EQ(mesh.positions, (Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
      EXPECT_EQ(mesh.normals, (Points{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}));
      EXPECT_EQ(mesh.texcoords, (Array<std::array<float, 2>>{{0, 0}, {0.5f, 0}, {0.5f, 0.25f}}));
      EXPECT_EQ(mesh.triangles, (Triangles{{2, 0, 1}}));
      ASSERT_EQ(mesh.attributes.size(), 1u);
      EXPECT_EQ(mesh.attributes[0].name, "vertex_color");
      EXPECT_EQ(mesh.attributes[0].channels, 3u);
      EXPECT_FALSE(mesh.attributes[0].per_face);
      EXPECT_EQ(mesh.attributes[0].values, (Array<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.75f}));
      EXPECT_FALSE(mesh.face_normals);
    }
  }
}

TEST(Serialized, SaysThatItWantsFaceNormals) {
  EXPECT_TRUE(read(header(4) + deflated(counts(4, 0x1010) + kOneTriangle)).face_normals);
}

TEST(Serialized, FindsMeshesThroughTheDictionary) {
  for (const std::uint16_t version : kVersions) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(read(three(version), i).positions.at(0)[0], static_cast<float>(i)) << version;
  }
}

TEST(Serialized, ManyVertices) {
  // More than one block of doubles, more than one of zlib's windows.
  constexpr std::uint64_t kCount = 5000;
  std::vector<double> positions;
  for (std::uint64_t i = 0; i < 3 * kCount; ++i) positions.push_back(std::sin(static_cast<double>(i)));
  const MeshData mesh =
      read(header(4) + deflated(counts(4, 0x2000, kCount) + numbers<double>(positions) + indices({0, 1, kCount - 1})));
  ASSERT_EQ(mesh.positions.size(), kCount);
  for (std::size_t i = 0; i < positions.size(); ++i)
    ASSERT_EQ(mesh.positions[i / 3][i % 3], static_cast<float>(positions[i])) << i;
}

TEST(SerializedErrors, Files) {
  const std::string none =
      "a.serialized: error: this is no serialized mesh\naccepted: a file that begins with the bytes 1C 04";
  EXPECT_EQ(complaints(""), none);
  EXPECT_EQ(complaints("ply\n"), none);
  EXPECT_EQ(complaints(header(5)), "a.serialized: error: version 5\naccepted: 3 or 4");
}

TEST(SerializedErrors, Dictionary) {
  EXPECT_EQ(complaints(three(4), 3), "a.serialized: error: there is no mesh 3\naccepted: 'shape_index' 0 to 2");
  EXPECT_EQ(complaints(three(3), 7), "a.serialized: error: there is no mesh 7\naccepted: 'shape_index' 0 to 2");
  const std::string damaged =
      "a.serialized: error: the dictionary at the end of the file is damaged\n"
      "accepted: the places of all meshes and their number";
  for (const std::uint16_t version : kVersions) {
    const std::string all = three(version);
    EXPECT_EQ(complaints(all.substr(0, all.size() - 4) + bytes_of<std::uint32_t>(0xffffffffu), 1), damaged);
    EXPECT_EQ(complaints(all.substr(0, all.size() - 4) + bytes_of<std::uint32_t>(0), 1), damaged);
    EXPECT_EQ(complaints(header(version), 1), damaged);
    // Places beyond the file, and where no mesh begins.
    for (const char byte : {'\x7f', '\1'}) {
      std::string lost = all;
      lost[all.size() - 4 - (version == 4 ? 16 : 8)] = byte;
      EXPECT_EQ(complaints(lost, 1), damaged);
    }
  }
}

TEST(SerializedErrors, Data) {
  const std::string ends = "a.serialized: error: mesh 0 ends early\naccepted: a file as Mitsuba's exporters write it";
  EXPECT_EQ(complaints(header(4)), ends);
  EXPECT_EQ(complaints_about_mesh(counts(4, 0x1000) + kOneTriangle.substr(1)), ends);
  EXPECT_EQ(complaints_about_mesh(bytes_of<std::uint32_t>(0x1000) + std::string(100, 'n')), ends);
  // Counts that would need more memory than there is are not believed.
  EXPECT_EQ(complaints_about_mesh(counts(4, 0x1000, 0xfffffffeu) + kOneTriangle), ends);
  EXPECT_EQ(complaints_about_mesh(counts(4, 0x1000, 3, ~std::uint64_t{0}) + kOneTriangle), ends);
  EXPECT_EQ(complaints_about_mesh(counts(4, 0x1000, 0xffffffffu) + kOneTriangle),
            "a.serialized: error: 4294967295 vertices are too many\naccepted: fewer than 2^32");
  std::string broken = mesh(4, 0);
  broken[5] = '\x55';
  EXPECT_EQ(complaints(broken),
            "a.serialized: error: mesh 0 is damaged (incorrect header check)\n"
            "accepted: a file as Mitsuba's exporters write it");
}

TEST(SerializedErrors, Values) {
  const double inf = INFINITY;
  EXPECT_EQ(
      complaints_about_mesh(counts(4, 0x1000) + numbers<float>({0, 0, 0, 1, inf, 0, 1, 1e13, 0}) + indices({0, 1, 2})),
      "a.serialized: error: a position of vertex 2 is 1e+13\naccepted: numbers from -1e+12 to 1e+12");
  EXPECT_EQ(complaints_about_mesh(counts(4, 0x1000) + numbers<float>(kCorners) + indices({0, 1, 3})),
            "a.serialized: error: triangle 0 has a vertex 3\naccepted: 0 to 2");
}

/// A mesh that is read, and its warnings.
std::pair<MeshData, std::string> read_with_warnings(const std::string& data) {
  Diagnostics diagnostics;
  auto mesh = read_serialized(header(4) + deflated(data), 0, "a.serialized", diagnostics);
  EXPECT_TRUE(mesh.has_value());
  return {mesh.value_or(MeshData{}), to_text(diagnostics)};
}

TEST(Serialized, MeshesOfNothingAreEmpty) {
  EXPECT_EQ(read_with_warnings(counts(4, 0x1000, 0) + kOneTriangle).second,
            "a.serialized: warning: mesh 0 has no vertices, nothing of it is drawn");
  EXPECT_EQ(read_with_warnings(counts(4, 0x1000, 3, 0) + kOneTriangle).second,
            "a.serialized: warning: mesh 0 has no triangles, nothing of it is drawn");
}

TEST(Serialized, WhatIsNotFiniteIsLeftOut) {
  const double inf = INFINITY;
  const auto [mesh, warning] =
      read_with_warnings(counts(4, 0x2001) + numbers<double>({0, 0, 0, 1, inf, 0, 1, 1, 0}) +
                         numbers<double>({0, 0, 1, 0, 0, 1, 0, 0, 1e300}) + indices({0, 1, 2}));
  EXPECT_EQ(
      warning,
      "a.serialized: warning: a position of vertex 1 is inf: vertices that are not finite are left out with their "
      "triangles, other values are taken for 0; the first of 2 such places");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0][0], mesh.triangles[0][1]) << "without an area";
  EXPECT_EQ(mesh.positions.at(1), (std::array<float, 3>{0, 0, 0}));
  EXPECT_EQ(mesh.normals.at(2), (std::array<float, 3>{0, 0, 0}));
}

TEST(SerializedErrors, EveryPrefixIsRefused) {
  const std::string bytes = header(4) + deflated(counts(4, 0x1000) + kOneTriangle);
  EXPECT_EQ(read(bytes).triangles.size(), 1u);
  // zlib's last four bytes are a checksum, which need not be there.
  for (std::size_t length = 0; length + 5 < bytes.size(); ++length) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_serialized(bytes.substr(0, length), 0, "a.serialized", diagnostics).has_value()) << length;
    EXPECT_TRUE(diagnostics.has_errors()) << length;
  }
}

}  // namespace
}  // namespace norrsken
