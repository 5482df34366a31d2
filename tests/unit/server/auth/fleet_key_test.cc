// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/fleet_key.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>

#include "tests/support/scenes.h"

namespace dhpmap::auth {
namespace {

constexpr char kSecret[] = "0123456789abcdef0123456789abcdef";

TEST(FleetKey, IsTheFirstLineOfAPrivateFile) {
  const testing::TempDir folder;
  const std::string path = (folder.path() / "fleet.key").string();
  std::ofstream(path) << kSecret << "\nmore\n";
  ASSERT_EQ(chmod(path.c_str(), 0600), 0);
  const auto key = FleetKey::Read(path);
  ASSERT_TRUE(key.ok()) << key.status().ToString();
  EXPECT_TRUE((*key)->Is(kSecret));
  EXPECT_FALSE((*key)->Is(std::string(kSecret) + "0"));
  EXPECT_FALSE((*key)->Is(""));
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  EXPECT_EQ(FleetKey::Read(path).status().reason(), Reason("BAD_KEY_FILE")) << "others may read it";
  EXPECT_EQ(FleetKey::Read(path + "x").status().reason(), Reason("BAD_KEY_FILE"));
}

TEST(FleetKey, HasAMinimumLengthAndPlainCharacters) {
  EXPECT_TRUE(FleetKey::Make(kSecret, "a test").ok());
  for (const std::string& text : {std::string(31, 'a'), std::string(1025, 'a'), std::string(40, ' '),
                                  std::string(kSecret) + "\r", std::string(kSecret) + "\xc3\xa4"}) {
    EXPECT_FALSE(FleetKey::Make(text, "a test").ok()) << text;
  }
}

TEST(FleetKey, APrincipalIsReadBackUnchanged) {
  for (const Role role : kRoles) {
    const Principal ann{.name = "ann",
                        .key_id = "0123456789ab",
                        .role = role,
                        .maps = *NamePatterns::Make({"hall*", "!hall-9"}),
                        .sessions = role == Role::kRobot ? *NamePatterns::Make({"r1"}) : NamePatterns(),
                        .expires_s = 1'900'000'000};
    const std::string text = TextOf(ann);
    for (const char c : text) EXPECT_TRUE(c >= ' ' && c < 0x7F) << text;
    const auto read = PrincipalFromText(text);
    ASSERT_TRUE(read.ok()) << read.status().ToString();
    EXPECT_EQ((*read)->name, ann.name);
    EXPECT_EQ((*read)->key_id, ann.key_id);
    EXPECT_EQ((*read)->role, role);
    EXPECT_EQ((*read)->maps, ann.maps);
    EXPECT_EQ((*read)->sessions, ann.sessions);
    EXPECT_EQ((*read)->expires_s, ann.expires_s);
  }
}

}  // namespace
}  // namespace dhpmap::auth
