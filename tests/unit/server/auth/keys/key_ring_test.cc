// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_ring.h"

#include <gtest/gtest.h>

#include <string>

#include "server/auth/keys/key_book.h"
#include "tests/unit/server/auth/keys/known_bytes.h"

namespace dhpmap::auth {
namespace {

constexpr std::int64_t kNow_s = 1'000'000;

class KeyRingTest : public ::testing::Test {
 protected:
  ShownKey Add(const std::string& name, Role role, std::int64_t expires_s = kNever_s) {
    auto key = AddKey({.name = name, .role = role, .expires_s = expires_s}, kNow_s, random, records);
    EXPECT_TRUE(key.ok()) << key.status().ToString();
    return *std::move(key);
  }
  [[nodiscard]] Result<PrincipalPtr> Find(const std::string& text, std::int64_t now_s = kNow_s) const {
    return KeyRing(records).Find(text, now_s);
  }

  Randomness random = KnownBytes();
  std::vector<KeyRecord> records;
};

TEST_F(KeyRingTest, AKeyIdentifiesItsPrincipal) {
  const ShownKey anna = Add("anna", Role::kEditor), spot = Add("spot", Role::kRobot);
  const auto found = Find(spot.text);
  ASSERT_TRUE(found.ok());
  EXPECT_EQ((*found)->name, "spot");
  EXPECT_EQ((*found)->role, Role::kRobot);
  EXPECT_TRUE((*found)->sessions.Match("spot"));
  EXPECT_TRUE((*found)->sessions.Match("spot-2"));
  EXPECT_FALSE((*found)->sessions.Match("spotless"));
  EXPECT_EQ((*Find(anna.text))->key_id, anna.record.id);
}

TEST_F(KeyRingTest, AnUnknownIdAndAWrongSecretGetTheSameAnswer) {
  const ShownKey anna = Add("anna", Role::kEditor);
  const std::string unknown = MakeKeyText(random);
  records.push_back(anna.record);
  records.back().id = std::string(ParseKeyText(unknown)->id);  // its id is known now, its secret is another's
  const Status wrong = Find(unknown).status();
  records.pop_back();
  const Status stranger = Find(unknown).status();
  EXPECT_EQ(wrong.code(), StatusCode::kUnauthenticated);
  EXPECT_EQ(wrong.reason(), Reason("BAD_CREDENTIAL"));
  for (const Status& other : {stranger, Find("").status(), Find("dhp_x").status()}) {
    EXPECT_EQ(other.ToString(), wrong.ToString());
    EXPECT_EQ(other.reason(), wrong.reason());
  }
}

TEST_F(KeyRingTest, OnlyTheSecretRevealsThatAKeyIsExpiredOrRevoked) {
  const ShownKey anna = Add("anna", Role::kEditor, kNow_s + 10);
  EXPECT_TRUE(Find(anna.text, kNow_s + 9).ok());
  EXPECT_EQ(Find(anna.text, kNow_s + 10).status().reason(), Reason("KEY_EXPIRED"));
  const auto principal = *Find(anna.text);
  ASSERT_EQ(RevokeKeys("anna", kNow_s, records).value(), 1);
  EXPECT_EQ(Find(anna.text).status().reason(), Reason("KEY_REVOKED"));
  EXPECT_EQ(KeyRing(records).Check(*principal, kNow_s).reason(), Reason("KEY_REVOKED"));
  EXPECT_EQ(RevokeKeys(anna.record.id, kNow_s, records).value(), 0) << "again";
  EXPECT_EQ(RevokeKeys("nobody", kNow_s, records).status().reason(), Reason("KEY_NOT_FOUND"));
}

TEST_F(KeyRingTest, AnAdmittedCallerStaysUntilItsKeyChanges) {
  const auto principal = *Find(Add("anna", Role::kEditor, kNow_s + 10).text);
  EXPECT_TRUE(KeyRing(records).Check(*principal, kNow_s + 9).ok());
  EXPECT_FALSE(KeyRing(records).Check(*principal, kNow_s + 10).ok());
  records[0].role = Role::kViewer;
  EXPECT_FALSE(KeyRing(records).Check(*principal, kNow_s).ok()) << "an editor no longer";
  EXPECT_FALSE(KeyRing({}).Check(*principal, kNow_s).ok());
}

TEST_F(KeyRingTest, ARotatedKeyStaysValidForAWhile) {
  const ShownKey old = Add("anna", Role::kEditor, kNow_s + 1000);
  const auto rotated = RotateKey("anna", 60, kNow_s + 100, random, records);
  ASSERT_TRUE(rotated.ok()) << rotated.status().ToString();
  EXPECT_NE(rotated->record.id, old.record.id);
  EXPECT_EQ(rotated->record.role, Role::kEditor);
  EXPECT_EQ(rotated->record.expires_s, kNow_s + 1100) << "as long as the old one was made for";
  EXPECT_TRUE(Find(old.text, kNow_s + 159).ok());
  EXPECT_EQ(Find(old.text, kNow_s + 160).status().reason(), Reason("KEY_EXPIRED"));
  EXPECT_TRUE(Find(rotated->text, kNow_s + 160).ok());
  EXPECT_EQ(RotateKey("anna", 0, kNow_s + 5000, random, records).status().reason(), Reason("KEY_NOT_FOUND"));
}

TEST_F(KeyRingTest, KeysWithDifferentRightsAreNotRotatedTogether) {
  Add("anna", Role::kAdmin, kNow_s + 1000);
  Add("anna", Role::kViewer, kNow_s + 1000);
  const auto before = records;
  EXPECT_EQ(RotateKey("anna", 60, kNow_s, random, records).status().reason(), Reason("BAD_KEY"));
  EXPECT_EQ(records, before) << "the admin's key stays as it is";
}

TEST_F(KeyRingTest, InvalidKeysAreNotMade) {
  const std::vector<NewKey> wrong = {{.name = ""},
                                     {.name = "anna/laptop"},
                                     {.name = "a b"},
                                     {.name = std::string(65, 'a')},
                                     {.name = "a", .maps = {}},
                                     {.name = "a", .maps = {"maps/a"}},
                                     {.name = "a", .sessions = {"/"}},
                                     {.name = "a", .expires_s = kNow_s}};
  for (const NewKey& key : wrong) {
    EXPECT_EQ(AddKey(key, kNow_s, random, records).status().reason(), Reason("BAD_KEY")) << key.name;
  }
  EXPECT_TRUE(records.empty());
}

}  // namespace
}  // namespace dhpmap::auth
