// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_table.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "server/auth/keys/key_book.h"
#include "server/auth/keys/key_ring.h"
#include "server/auth/keys/key_source.h"
#include "tests/support/assert_ok.h"
#include "tests/support/fake_auth_tables.h"
#include "tests/unit/server/auth/keys/known_bytes.h"

namespace dhpmap::auth {
namespace {

class KeyTableTest : public ::testing::Test {
 protected:
  std::string Make(const std::string& name) {
    std::string text;
    EXPECT_OK(ChangeKeyTable(*tables, [&](std::vector<KeyRecord>& records) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const ShownKey shown,
                              AddKey({.name = name, .maps = {"site-*", "!site-x"}}, now_s, random, records));
      text = shown.text;
      return Status::Ok();
    }));
    return text;
  }
  std::shared_ptr<testing::FakeAuthTables> tables = std::make_shared<testing::FakeAuthTables>();
  Randomness random = KnownBytes();
  std::int64_t now_s = 10;
};

TEST_F(KeyTableTest, KeysAreReadAsTheyWereMade) {
  const std::string anna = Make("anna"), bert = Make("bert");
  const auto content = ReadKeyTable(*tables);
  ASSERT_OK(content);
  ASSERT_EQ(content->records.size(), 2u);
  const KeyRing ring(content->records);
  EXPECT_EQ((*ring.Find(anna, now_s))->name, "anna");
  EXPECT_EQ((*ring.Find(bert, now_s))->maps.texts(), (std::vector<std::string>{"site-*", "!site-x"}));
}

TEST_F(KeyTableTest, TheTableHoldsNoKeys) {
  const std::string anna = Make("anna");
  const std::string secret(ParseKeyText(anna)->secret.substr(17));
  const KeyRows keys = tables->ReadKeys().value();
  ASSERT_EQ(keys.rows.size(), 1u);
  for (const KeyRow& row : keys.rows) {
    EXPECT_EQ(row.record.find(secret.substr(0, 16)), std::string::npos) << row.record;
  }
}

TEST_F(KeyTableTest, AChangeRunsAgainOnTheKeysThatSomebodyElseHasWritten) {
  tables->BeforeWrite([this] { Make("bert"); });
  Make("anna");
  EXPECT_EQ(ReadKeyTable(*tables)->records.size(), 2u);
}

TEST_F(KeyTableTest, AnErrorOfAChangeChangesNothing) {
  Make("anna");
  const std::int64_t before = tables->KeysVersion().value();
  const Status refused = ChangeKeyTable(
      *tables, [&](std::vector<KeyRecord>& records) { return RevokeKeys("nobody", now_s, records).status(); });
  EXPECT_EQ(refused.reason(), Reason("KEY_NOT_FOUND"));
  EXPECT_EQ(tables->KeysVersion().value(), before);
}

TEST_F(KeyTableTest, ARotatedKeyIsLikeTheNewestOfItsName) {
  Make("anna");
  now_s = 20;
  ASSERT_OK(ChangeKeyTable(
      *tables, [&](std::vector<KeyRecord>& records) { return RotateKey("anna", 5, now_s, random, records).status(); }));
  const auto records = ReadKeyTable(*tables)->records;
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].expires_s, 25);
  EXPECT_EQ(records[1].created_s, 20);
}

TEST_F(KeyTableTest, AMalformedRowIsRefusedAndNotQuoted) {
  Make("anna");
  const std::vector<KeyRow> bad = {{"0123456789ab", "{\"id\":\"0123456789ab\",\"sha256\":\"hush\"}"}};
  ASSERT_OK(tables->WriteKeys(tables->KeysVersion().value(), bad));
  const Status refused = ReadKeyTable(*tables).status();
  EXPECT_EQ(refused.reason(), Reason("BAD_KEY_FILE"));
  EXPECT_NE(refused.message().find("0123456789ab"), std::string::npos);
  EXPECT_EQ(refused.message().find("hush"), std::string::npos);
}

TEST_F(KeyTableTest, ASourceReadsRowsOnlyAfterAChange) {
  Make("anna");
  KeyTableSource source(tables);
  ASSERT_TRUE(source.ReadIfChanged()->has_value());
  const int num_reads = tables->num_key_reads();
  EXPECT_FALSE(source.ReadIfChanged()->has_value());
  EXPECT_EQ(tables->num_key_reads(), num_reads);
  Make("bert");
  EXPECT_EQ(source.ReadIfChanged()->value().size(), 2u);
}

}  // namespace
}  // namespace dhpmap::auth
