// SPDX-License-Identifier: BSD-3-Clause
// The gate of a server whose keys are in a database.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "server/auth/gate.h"
#include "server/auth/keys/key_book.h"
#include "server/auth/keys/key_table.h"
#include "server/auth/map_owners_table.h"
#include "tests/support/assert_ok.h"
#include "tests/support/fake_auth_tables.h"
#include "tests/unit/server/auth/keys/known_bytes.h"

namespace dhpmap::auth {
namespace {

class GateOnDatabase : public ::testing::Test {
 protected:
  std::string Make(const std::string& name) {
    std::string text;
    EXPECT_OK(ChangeKeyTable(*tables, [&](std::vector<KeyRecord>& records) -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const ShownKey shown, AddKey({.name = name, .expires_s = 10'000}, 0, random, records));
      text = shown.text;
      return Status::Ok();
    }));
    return text;
  }
  void Revoke(const std::string& name) {
    EXPECT_OK(ChangeKeyTable(
        *tables, [&](std::vector<KeyRecord>& records) { return RevokeKeys(name, now_s, records).status(); }));
  }
  std::shared_ptr<Gate> Open() {
    auto gate = Gate::WithKeys({.keys = std::make_shared<KeyTableSource>(tables),
                                .owners = std::make_shared<MapOwnersTable>(tables),
                                .audit_table = std::make_shared<AuditTable>(tables, AuditTableOptions{.flush_s = 0}),
                                .look_s = 0,
                                .now_s = [this] { return now_s; },
                                .passing_s = [this] { return passing_s; },
                                .randomness = random,
                                .on_fault = [this](const Status& fault) { faults.push_back(fault); }});
    EXPECT_OK(gate);
    return *gate;
  }
  static Reason Shown(const Gate& gate, const std::string& key) {
    return gate.Authenticate({"Bearer " + key}).status().reason();
  }

  std::shared_ptr<testing::FakeAuthTables> tables = std::make_shared<testing::FakeAuthTables>();
  Randomness random = KnownBytes();
  std::int64_t now_s = 10;
  double passing_s = 0;
  std::vector<Status> faults;
};

TEST_F(GateOnDatabase, AServerSeesNewAndRevokedKeysAtItsNextLook) {
  const std::string anna = Make("anna");
  const auto one = Open(), other = Open();
  EXPECT_EQ(Shown(*one, anna), Reason());
  const std::string bert = Make("bert");
  Revoke("anna");
  for (const auto& gate : {one, other}) {
    gate->Look();
    EXPECT_EQ(Shown(*gate, bert), Reason());
    EXPECT_EQ(Shown(*gate, anna), Reason("KEY_REVOKED"));
  }
}

TEST_F(GateOnDatabase, StreamsOfARevokedKeyEndAtTheNextLook) {
  const std::string anna = Make("anna");
  const auto gate = Open();
  std::vector<Status> ends;
  const auto place = gate->streams().Add(*gate->AuthenticateKey(anna), /*is_feed=*/false,
                                         [&](const Status& why) { ends.push_back(why); });
  ASSERT_OK(place);
  gate->Look();
  EXPECT_TRUE(ends.empty());
  Revoke("anna");
  gate->Look();
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends[0].reason(), Reason("KEY_REVOKED"));
}

TEST_F(GateOnDatabase, TheLastKnownKeysCountForTenMinutesWithoutADatabase) {
  const std::string anna = Make("anna");
  const auto gate = Open();
  std::vector<Status> ends;
  const auto place = gate->streams().Add(*gate->AuthenticateKey(anna), /*is_feed=*/false,
                                         [&](const Status& why) { ends.push_back(why); });
  tables->FailWith(Unavailable("gone"));
  passing_s = KeyTableSource::kLongestOutage_s;
  gate->Look();
  EXPECT_EQ(Shown(*gate, anna), Reason());
  EXPECT_TRUE(ends.empty());
  passing_s += 1;
  EXPECT_EQ(Shown(*gate, anna), Reason("DATABASE_UNREACHABLE"));
  gate->Look();
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends[0].code(), StatusCode::kUnavailable);
  EXPECT_EQ(faults.size(), 1u) << "one message for an outage";
  tables->FailWith(Status::Ok());
  gate->Look();
  EXPECT_EQ(Shown(*gate, anna), Reason());
}

TEST_F(GateOnDatabase, EveryOutageIsReported) {
  Make("anna");
  const auto gate = Open();
  for (int n = 0; n < 2; ++n) {
    tables->FailWith(Unavailable("gone"));
    gate->Look();
    tables->FailWith(Status::Ok());
    gate->Look();
  }
  EXPECT_EQ(faults.size(), 2u);
}

TEST_F(GateOnDatabase, AMapThatOneServerMakesHasAnOwnerAtAll) {
  Make("anna");
  const auto one = Open(), other = Open();
  ASSERT_OK(one->owners()->Add(7, "anna"));
  EXPECT_EQ(other->owners()->OwnerOf(7).value(), "anna");
  EXPECT_EQ(other->owners()->MapsOf("anna")->size(), 1u);
  tables->FailWith(Unavailable("gone"));
  EXPECT_EQ(other->owners()->MapsOf("anna").status().code(), StatusCode::kUnavailable);
}

TEST_F(GateOnDatabase, AuditedCallsGoIntoTheTable) {
  Make("anna");
  auto gate = Open();
  EXPECT_OK(gate->Audit({.rpc = "/x"}));
  gate.reset();  // stores what waits
  ASSERT_EQ(tables->ListAudit({})->size(), 1u);
  EXPECT_EQ(tables->ListAudit({}).value()[0].rpc, "/x");
}

}  // namespace
}  // namespace dhpmap::auth
