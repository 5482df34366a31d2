// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/gate.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <string>
#include <vector>

#include "server/auth/keys/key_book.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/auth/keys/known_bytes.h"

namespace dhpmap::auth {
namespace {

class GateTest : public ::testing::Test {
 protected:
  GateTest() { anna = Add("anna"); }

  std::string Add(const std::string& name) {
    std::string text;
    EXPECT_TRUE(ChangeKeyFile(file, [&](std::vector<KeyRecord>& records) {
                  auto key = AddKey({.name = name, .expires_s = 100}, 0, random, records);
                  text = key->text;
                  return Status::Ok();
                }).ok());
    return text;
  }
  void Revoke(const std::string& name) const {
    EXPECT_TRUE(ChangeKeyFile(file, [&](std::vector<KeyRecord>& records) {
                  return RevokeKeys(name, now_s, records).status();
                }).ok());
  }
  std::shared_ptr<Gate> Open(CallLimits limits = {}) {
    auto gate = Gate::WithKeys({.key_file = file,
                                .limits = limits,
                                .look_s = 0,
                                .now_s = [this] { return now_s; },
                                .passing_s = [this] { return passing_s; },
                                .randomness = random,
                                .on_fault = [this](const Status& fault) { faults.push_back(fault); }});
    EXPECT_TRUE(gate.ok()) << gate.status().ToString();
    return *gate;
  }
  static Reason Shown(const Gate& gate, const std::string& key) {
    return gate.Authenticate({"Bearer " + key}).status().reason();
  }

  testing::TempDir folder;
  const std::string file = (folder.path() / "keys").string();
  Randomness random = KnownBytes();
  std::int64_t now_s = 10;
  double passing_s = 0;
  std::vector<Status> faults;
  std::string anna;
};

TEST_F(GateTest, WithoutKeysEveryCallerIsLocal) {
  const auto gate = Gate::Open();
  EXPECT_FALSE(gate->has_keys());
  EXPECT_TRUE(gate->CheckCalls().ok());
  EXPECT_EQ((*gate->Authenticate({}))->name, "local");
  EXPECT_EQ((*gate->Authenticate({"Bearer x", "y"}))->role, Role::kAdmin);
}

TEST_F(GateTest, AValidKeyIsAdmitted) {
  const auto gate = Open();
  EXPECT_EQ((*gate->Authenticate({"Bearer " + anna}))->name, "anna");
  EXPECT_EQ((*gate->Authenticate({"bEARER " + anna}))->name, "anna") << "a scheme has no case";
  EXPECT_EQ(gate->Authenticate({}).status().reason(), Reason("NO_CREDENTIAL"));
  for (const std::string& other : {std::string(), anna, "Basic " + anna, std::string("Bearer"), "Bearer  " + anna}) {
    EXPECT_EQ(gate->Authenticate({other}).status().reason(), Reason("BAD_CREDENTIAL")) << other;
  }
  const std::string shown = "Bearer " + anna;
  EXPECT_EQ(gate->Authenticate({shown, shown}).status().reason(), Reason("AMBIGUOUS_CREDENTIAL"));
}

TEST_F(GateTest, WrongKeysOfAnAddressAreThrottledAndValidOnesAdmitted) {
  const auto gate = Open();
  const auto from = [&](std::string_view address, const std::string& key) {
    const std::string shown = "Bearer " + key;
    return gate->AuthenticateFrom(address, {shown}).status();
  };
  for (int i = 0; i < 20; ++i) EXPECT_EQ(from("192.0.2.7", "x").reason(), Reason("BAD_CREDENTIAL"));
  const Status throttled = from("192.0.2.7", "x");
  EXPECT_EQ(throttled.code(), StatusCode::kResourceExhausted);
  EXPECT_EQ(throttled.reason(), Reason("TOO_MANY_LOGINS"));
  EXPECT_EQ(throttled.metadata(), (std::vector<std::pair<std::string, std::string>>{{"retry_after_s", "3"}}));
  EXPECT_TRUE(from("192.0.2.7", anna).ok()) << "nobody is locked out";
  EXPECT_EQ(gate->AuthenticateFrom("192.0.2.7", {}).status().reason(), Reason("NO_CREDENTIAL")) << "which is no guess";
  EXPECT_EQ(from("192.0.2.8", "x").reason(), Reason("BAD_CREDENTIAL")) << "another address";
  for (int i = 0; i < 30; ++i) EXPECT_EQ(from("", "x").reason(), Reason("BAD_CREDENTIAL")) << "behind unix:";
  passing_s += 3;
  EXPECT_EQ(from("192.0.2.7", "x").reason(), Reason("BAD_CREDENTIAL"));
  EXPECT_EQ(from("192.0.2.7", "x").reason(), Reason("TOO_MANY_LOGINS"));
  Revoke("anna");
  gate->Look();
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(from("192.0.2.9", anna).reason(), Reason("KEY_REVOKED")) << "who had it, knows";
}

TEST_F(GateTest, TheTableOfWrongKeysIsBounded) {
  FailedLogins failed([this] { return passing_s; });
  const auto fail = [&](std::size_t i) { return failed.Count("2001:db8:" + std::to_string(i) + "::/64"); };
  for (std::size_t i = 0; i < 3 * FailedLogins::kMostAddresses; ++i) EXPECT_TRUE(fail(i).ok());
  EXPECT_LE(failed.num_addresses(), FailedLogins::kMostAddresses);
  for (int i = 0; i < 30; ++i) (void)failed.Count("192.0.2.7");
  passing_s += 3;  // the others are at rest again, this one is not
  for (std::size_t i = 0; failed.num_addresses() < FailedLogins::kMostAddresses; ++i) EXPECT_TRUE(fail(i).ok());
  EXPECT_TRUE(failed.Count("192.0.2.7").ok());
  passing_s += 3;
  EXPECT_TRUE(failed.Count("192.0.2.1").ok()) << "those at rest make room for it";
  EXPECT_TRUE(failed.Count("192.0.2.7").ok());
  EXPECT_EQ(failed.Count("192.0.2.7").reason(), Reason("TOO_MANY_LOGINS")) << "which has not been forgotten";
}

TEST_F(GateTest, ReloadsAChangedFile) {
  const auto gate = Open();
  const std::string bert = Add("bert");
  EXPECT_EQ(Shown(*gate, bert), Reason("BAD_CREDENTIAL"));
  gate->Look();
  EXPECT_EQ(Shown(*gate, bert), Reason());
  Revoke("anna");
  gate->Look();
  EXPECT_EQ(Shown(*gate, anna), Reason("KEY_REVOKED"));
  now_s = 100;
  EXPECT_EQ(Shown(*gate, bert), Reason("KEY_EXPIRED"));
  EXPECT_TRUE(faults.empty());
}

TEST_F(GateTest, ReloadsByItself) {
  const auto gate = Gate::WithKeys({.key_file = file, .look_s = 0.001, .now_s = [] { return 10; }});
  ASSERT_TRUE(gate.ok());
  Revoke("anna");
  EXPECT_TRUE(testing::Eventually([&] { return Shown(**gate, anna) == Reason("KEY_REVOKED"); }));
}

TEST_F(GateTest, AnUnusableFileIsReportedOnceAndTheKeysStay) {
  const auto gate = Open();
  ASSERT_EQ(chmod(file.c_str(), 0644), 0);
  for (int i = 0; i < 3; ++i) gate->Look();
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].reason(), Reason("BAD_KEY_FILE"));
  EXPECT_EQ(Shown(*gate, anna), Reason());
  ASSERT_EQ(chmod(file.c_str(), 0600), 0);
  const std::string bert = Add("bert");
  gate->Look();
  EXPECT_EQ(Shown(*gate, bert), Reason());
  std::filesystem::remove(file);
  for (int i = 0; i < 3; ++i) gate->Look();
  EXPECT_EQ(faults.size(), 2u);
  EXPECT_EQ(Shown(*gate, anna), Reason());
  EXPECT_FALSE(Gate::WithKeys({.key_file = file, .look_s = 0}).ok()) << "and none starts without it";
}

TEST_F(GateTest, StreamsEndWithTheirKey) {
  const auto gate = Open();
  const std::string bert = Add("bert");
  gate->Look();
  std::vector<Reason> of_anna, of_bert;
  const auto a = gate->streams().Add(*gate->AuthenticateKey(anna), false,
                                     [&](const Status& why) { of_anna.push_back(why.reason()); });
  auto b = gate->streams().Add(*gate->AuthenticateKey(bert), false,
                               [&](const Status& why) { of_bert.push_back(why.reason()); });
  ASSERT_TRUE(a.ok() && b.ok());
  gate->Look();
  EXPECT_TRUE(of_anna.empty());
  Revoke("anna");
  gate->Look();
  EXPECT_EQ(of_anna, std::vector{Reason("KEY_REVOKED")});
  EXPECT_TRUE(of_bert.empty());
  now_s = 100;
  gate->Look();
  EXPECT_EQ(of_bert, std::vector{Reason("KEY_EXPIRED")});
  b->reset();
  EXPECT_EQ(gate->streams().size(), 1u) << "a place is given back";
}

TEST_F(GateTest, AStreamMayReleaseItsPlaceWhileItIsEnded) {
  const auto gate = Open();
  std::unique_ptr<LiveStreams::Place> place;
  auto taken = gate->streams().Add(*gate->AuthenticateKey(anna), false, [&](const Status&) { place.reset(); });
  ASSERT_TRUE(taken.ok());
  place = *std::move(taken);
  Revoke("anna");
  gate->Look();
  EXPECT_EQ(gate->streams().size(), 0u);
}

TEST_F(GateTest, StreamsAndCallsOfACallerAreLimited) {
  const auto gate = Open({.calls_per_s = 10, .burst_calls = 3, .streams = 3, .feeds = 1});
  const PrincipalPtr principal = *gate->AuthenticateKey(anna);
  std::vector<std::unique_ptr<LiveStreams::Place>> places;
  const auto add = [&](bool is_feed) {
    auto place = gate->streams().Add(principal, is_feed, [](const Status&) {});
    const Reason reason = place.status().reason();
    if (place.ok()) places.push_back(*std::move(place));
    return reason;
  };
  EXPECT_EQ(add(true), Reason());
  EXPECT_EQ(add(true), Reason("OUT_OF_QUOTA")) << "a second feed";
  EXPECT_EQ(add(false), Reason());
  EXPECT_EQ(add(false), Reason());
  EXPECT_EQ(add(false), Reason("OUT_OF_QUOTA"));
  places.pop_back();
  EXPECT_EQ(add(false), Reason());

  for (int i = 0; i < 3; ++i) EXPECT_TRUE(gate->Count(*principal).ok());
  EXPECT_EQ(gate->Count(*principal).reason(), Reason("OUT_OF_QUOTA"));
  Principal other = *principal;
  other.name = "bert";
  EXPECT_TRUE(gate->Count(other).ok()) << "each has its own";
  passing_s += 0.1;
  EXPECT_TRUE(gate->Count(*principal).ok());
  EXPECT_FALSE(gate->Count(*principal).ok());
  passing_s += 1000;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(gate->Count(*principal).ok());
  EXPECT_FALSE(gate->Count(*principal).ok()) << "no more is saved up";
}

TEST_F(GateTest, CallsThatCannotBeAuditedAreRefusedIfRequired) {
  for (const bool is_required : {false, true}) {
    const auto gate = Gate::WithKeys({.key_file = file,
                                      .audit_file = "/dev/full",
                                      .is_audit_required = is_required,
                                      .look_s = 0,
                                      .on_fault = [this](const Status& fault) { faults.push_back(fault); }});
    ASSERT_TRUE(gate.ok());
    faults.clear();
    EXPECT_EQ((*gate)->Audit({.rpc = "/x"}).ok(), !is_required);
    const Status refused = Status(StatusCode::kUnauthenticated, "no").WithReason("NO_CREDENTIAL");
    EXPECT_TRUE((*gate)->Audit({.rpc = "/x", .decision = refused}).ok()) << "it is refused anyway";
    EXPECT_EQ(faults.size(), 1u) << "told once";
  }
}

TEST_F(GateTest, ACallerGetsOnlyAShareOfTheBudget) {
  const auto all = std::make_shared<ByteBudget>(1000, 10);
  const auto gate = Open();
  const PrincipalPtr principal = *gate->AuthenticateKey(anna);
  const auto budget = gate->BudgetOf(*principal, all);
  EXPECT_EQ(budget->limit_bytes(), 500u);
  EXPECT_EQ(budget->free_bytes(), 10u);
  EXPECT_TRUE(budget->TryTake(500));
  EXPECT_FALSE(budget->TryTake(1));
  EXPECT_EQ(all->used_bytes(), 500u);
  EXPECT_EQ(gate->BudgetOf(*principal, all), budget) << "of all its keys and doors";
  Principal other = *principal;
  other.name = "bert";
  EXPECT_TRUE(gate->BudgetOf(other, all)->TryTake(500));
  EXPECT_EQ(Gate::Open()->BudgetOf(*principal, all), all);
}

TEST_F(GateTest, ATicketIsValidOnceAndDuringItsCall) {
  Tickets tickets(random);
  const PrincipalPtr principal = *Open()->AuthenticateKey(anna);
  auto ticket = tickets.Issue(principal);
  const std::string text = ticket->text();
  EXPECT_EQ(text.size(), 32u);
  EXPECT_EQ(tickets.Take(text + "0"), nullptr);
  EXPECT_EQ(tickets.Take(text), principal);
  EXPECT_EQ(tickets.Take(text), nullptr) << "twice";
  ticket = tickets.Issue(principal);
  const std::string second = ticket->text();
  EXPECT_NE(second, text);
  ticket.reset();
  EXPECT_EQ(tickets.Take(second), nullptr) << "its call is over";
}

}  // namespace
}  // namespace dhpmap::auth
