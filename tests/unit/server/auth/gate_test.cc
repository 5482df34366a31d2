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

TEST_F(GateTest, WithoutKeysEverybodyIsLocal) {
  const auto gate = Gate::Open();
  EXPECT_FALSE(gate->has_keys());
  EXPECT_TRUE(gate->CheckCalls().ok());
  EXPECT_EQ((*gate->Authenticate({}))->name, "local");
  EXPECT_EQ((*gate->Authenticate({"Bearer x", "y"}))->role, Role::kAdmin);
}

TEST_F(GateTest, OneKeyLetsIn) {
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

TEST_F(GateTest, TakesUpWhatHasBecomeOfTheFile) {
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

TEST_F(GateTest, LooksByItself) {
  const auto gate = Gate::WithKeys({.key_file = file, .look_s = 0.001, .now_s = [] { return 10; }});
  ASSERT_TRUE(gate.ok());
  Revoke("anna");
  EXPECT_TRUE(testing::Eventually([&] { return Shown(**gate, anna) == Reason("KEY_REVOKED"); }));
}

TEST_F(GateTest, AFileThatCannotBeUsedIsToldOfOnceAndTheKeysStay) {
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

TEST_F(GateTest, AStreamMayGiveItsPlaceBackWhileItIsEnded) {
  const auto gate = Open();
  std::unique_ptr<LiveStreams::Place> place;
  auto taken = gate->streams().Add(*gate->AuthenticateKey(anna), false, [&](const Status&) { place.reset(); });
  ASSERT_TRUE(taken.ok());
  place = *std::move(taken);
  Revoke("anna");
  gate->Look();
  EXPECT_EQ(gate->streams().size(), 0u);
}

TEST_F(GateTest, NobodyHasMoreStreamsOrCallsThanOneMay) {
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

TEST_F(GateTest, ATicketIsGoodOnceAndNoLongerThanItsCall) {
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
