// Scenes of Mitsuba 0.x beside the same scenes in the words of Mitsuba 3: both must be read as the same description.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "formats/mitsuba_upgrade.h"
#include "formats/reader_testing.h"

namespace norrsken {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Upgraded {
  std::string description, complaints;
  std::vector<std::string> changes;
};

inline Upgraded read(const std::string& version, const std::string& body) {
  Diagnostics diagnostics;
  const auto description =
      read_scene(fmt::format("<scene version=\"{}\">\n{}\n</scene>", version, body), {}, diagnostics);
  Upgraded result;
  result.complaints = to_text(diagnostics);
  if (!description) return result;
  result.description = text_of(*description->scene);
  for (const SceneChange& change : description->changes)
    result.changes.push_back(place_text(change.location) + ": " + change.text);
  return result;
}

// The same description, and for the old one the one warning that there always is.
inline void expect_same(const std::string& version, const std::string& old, const std::string& today) {
  SCOPED_TRACE(old);
  const Upgraded upgraded = read(version, old), modern = read("3.0.0", today);
  EXPECT_EQ(upgraded.description, modern.description);
  EXPECT_EQ(modern.complaints, "");
  EXPECT_EQ(
      upgraded.complaints,
      fmt::format("room.xml:1:17: note: the scene is for Mitsuba '{}' and was upgraded; 'norrsken info' tells how\n"
                  "    1 | <scene version=\"{}\">\n      |                 {}",
                  version, version, "^" + std::string(version.size() - 1, '~')));
}

// The same description, and a warning that says `warning`.
inline void expect_same_but(const std::string& version, const std::string& old, const std::string& today,
                            const std::string& warning) {
  SCOPED_TRACE(old);
  const Upgraded upgraded = read(version, old);
  EXPECT_EQ(upgraded.description, read("3.0.0", today).description);
  EXPECT_THAT(upgraded.complaints, HasSubstr("warning: " + warning));
  EXPECT_THAT(upgraded.complaints, Not(HasSubstr("error:")));
}

}  // namespace norrsken
