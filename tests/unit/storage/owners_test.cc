// SPDX-License-Identifier: BSD-3-Clause
// Who writes a map, of the servers on one PostgreSQL database.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "tests/unit/storage/fleet_fixture.h"

namespace dhpmap {
namespace {

using testing::CutConnection;
using testing::ExpectSameMap;
using testing::PostgresCluster;

class OwnersTest : public testing::FleetOfStores {};

TEST_F(OwnersTest, AMapHasOneOwnerWhomTheOthersName) {
  auto one = Open("one:1"), two = Open("two:2");
  const auto map = Create(one);
  Pass(1, {&one, &two});
  EXPECT_EQ(OwnerIn(two.store->LoadMap("house").status()), "one:1");
  EXPECT_EQ(OwnerIn(two.store->DeleteMap("house")), "one:1");
  EXPECT_EQ(OwnerIn(two.store->Reserve("house", {100, SubmapId(100)})), "one:1");
  EXPECT_OK(Commit(one, *map));
  EXPECT_EQ(two.store->GetMap("house")->info.revision, map->published()->revision()) << "to read it nobody owns it";
  const auto owner = two.fleet().OwnerOf("house");
  ASSERT_OK(owner);
  EXPECT_EQ(owner->address, "one:1");
  EXPECT_FALSE(owner->is_me);
  EXPECT_EQ(owner->server, one.fleet().Me().id);
  EXPECT_TRUE(one.fleet().KnownOwner("house")->is_me);
}

TEST_F(OwnersTest, CachedOwnersAreDroppedWithTheirServerAndOnDemand) {
  auto one = Open("one:1"), two = Open("two:2");
  (void)Create(one);
  Pass(1, {&one, &two});
  EXPECT_FALSE(two.fleet().KnownOwner("house")) << "nobody has asked";
  ASSERT_OK(two.fleet().OwnerOf("house"));
  EXPECT_EQ(two.fleet().KnownOwner("house")->address, "one:1");
  two.fleet().Forget("house");
  EXPECT_FALSE(two.fleet().KnownOwner("house"));
  ASSERT_OK(two.fleet().OwnerOf("house"));
  Pass(2.5, {&two});
  EXPECT_FALSE(two.fleet().KnownOwner("house")) << "it is dead";
}

TEST_F(OwnersTest, ADeadOwnersMapIsTakenOverAndItsCommitsAreRefused) {
  auto one = Open("one:1"), two = Open("two:2");
  const auto map = Create(one);
  const auto other = Create(one, "garden");
  const MapInfo info = map->published()->info();
  const std::int64_t others_revision = other->published()->revision();
  ASSERT_OK(one.store->Reserve("house", {info.revision + 5, SubmapId(40)}));
  ASSERT_OK(one.store->Reserve("garden", {others_revision + 5, SubmapId(40)}));
  Pass(1, {&one, &two});
  const std::int64_t epoch = EpochOf(one);
  Pass(1.9, {&two});
  EXPECT_EQ(OwnerIn(two.store->LoadMap("house").status()), "one:1") << "not yet";
  Pass(0.5, {&two});
  const auto taken = two.store->LoadMap("house");
  ASSERT_OK(taken);
  EXPECT_EQ((*taken)->revision(), info.revision + 6) << "numbers that it had reserved are left";
  EXPECT_EQ(EpochOf(two), epoch + 1);
  EXPECT_EQ(two.store->GetMap("garden")->info.revision, others_revision) << "of this map alone";

  std::vector<std::string> lost;
  one.fleet().OnLost([&](const std::string& name) { lost.push_back(name); });
  EXPECT_EQ(OwnerIn(Commit(one, *map)), "two:2");
  EXPECT_EQ(lost, std::vector<std::string>{"house"});
  EXPECT_OK(Commit(one, *other)) << "what nobody has taken is still its own";
  Map going_on(*taken);
  EXPECT_OK(Commit(two, going_on));
  const auto stored = two.store->LoadMap("house");
  ASSERT_OK(stored);
  ExpectSameMap(*going_on.published(), **stored);
}

TEST_F(OwnersTest, AnOwnerThatWasSilentLooksThroughItsMapsBeforeItAnswers) {
  auto one = Open("one:1"), two = Open("two:2");
  (void)Create(one);
  (void)Create(one, "garden");
  Pass(1, {&one, &two});
  Pass(2.5, {&two});
  ASSERT_OK(two.store->LoadMap("house"));
  std::vector<std::string> lost;
  one.fleet().OnLost([&](const std::string& name) {
    EXPECT_FALSE(one.fleet().MayAnswer()) << "before it knows";
    lost.push_back(name);
  });
  EXPECT_FALSE(one.fleet().MayAnswer());
  ASSERT_OK(one.fleet().Beat());
  EXPECT_TRUE(one.fleet().MayAnswer());
  EXPECT_EQ(lost, std::vector<std::string>{"house"});
  EXPECT_FALSE(one.fleet().KnownOwner("house"));
  EXPECT_TRUE(one.fleet().KnownOwner("garden")->is_me);
  Pass(0.2, {&one, &two});
  EXPECT_EQ(OwnerIn(one.store->LoadMap("house").status()), "two:2");
}

TEST_F(OwnersTest, ATakeoverIsRefusedIfTheOwnerHasBeatenSince) {
  auto one = Open("one:1"), two = Open("two:2");
  (void)Create(one);
  Pass(1, {&one, &two});
  const std::int64_t epoch = EpochOf(one);
  Pass(2.5, {&two});
  ASSERT_OK(one.fleet().Beat());  // which the other has not seen
  EXPECT_EQ(OwnerIn(two.store->LoadMap("house").status()), "one:1") << "the database knows better";
  ASSERT_OK(two.fleet().Beat());
  EXPECT_EQ(OwnerIn(two.store->LoadMap("house").status()), "one:1");
  EXPECT_EQ(EpochOf(one), epoch);
}

TEST_F(OwnersTest, ADatabaseThatIsSilentMakesNoEpochs) {
  CutConnection way_of_one(PostgresCluster::Get()->Folder()), way_of_two(PostgresCluster::Get()->Folder());
  auto one = Open("one:1", way_of_one.Url()), two = Open("two:2", way_of_two.Url());
  const auto map = Create(one);
  Pass(1, {&one, &two});
  const std::int64_t epoch = EpochOf(one);
  way_of_one.GoAway();
  way_of_two.GoAway();
  PostgresCluster::Get()->CutConnections();
  for (int n = 0; n < 5; ++n) {
    now_ns_ += kSecond;
    EXPECT_FALSE(one.fleet().Beat().ok());
    EXPECT_FALSE(two.fleet().Beat().ok());
    EXPECT_FALSE(one.fleet().MayAnswer());
  }
  way_of_one.ComeBack();
  way_of_two.ComeBack();
  ASSERT_OK(two.fleet().Beat());  // the owner comes later
  EXPECT_FALSE(two.store->LoadMap("house").ok());
  now_ns_ += kSecond / 2;
  ASSERT_OK(two.fleet().Beat());
  EXPECT_FALSE(two.store->LoadMap("house").ok());
  ASSERT_OK(one.fleet().Beat());
  EXPECT_TRUE(one.fleet().MayAnswer());
  EXPECT_OK(Commit(one, *map));
  EXPECT_EQ(EpochOf(one), epoch);
}

TEST_F(OwnersTest, WhoseBeatsFailTakesNoMap) {
  auto one = Open("one:1");
  (void)Create(one);
  ASSERT_OK(one.fleet().GiveUp("house", 0));
  now_ns_ += kSecond;
  EXPECT_EQ(one.store->LoadMap("house").status().reason(), Reason("DATABASE_UNREACHABLE"));
  ASSERT_OK(one.fleet().Beat());
  EXPECT_OK(one.store->LoadMap("house"));
}

TEST_F(OwnersTest, AMapThatIsGivenUpGoesToWhoAsksFirst) {
  auto one = Open("one:1"), two = Open("two:2");
  const auto map = Create(one);
  Pass(1, {&one, &two});
  const std::int64_t epoch = EpochOf(one);
  ASSERT_OK(one.fleet().GiveUp("house", 0));
  EXPECT_EQ(OwnerIn(Commit(one, *map)), "") << "not before it is loaded anew";
  ASSERT_OK(two.store->LoadMap("house"));
  EXPECT_GT(EpochOf(two), epoch);
  EXPECT_EQ(OwnerIn(one.store->LoadMap("house").status()), "two:2");
  EXPECT_OK(one.fleet().GiveUp("house", 0)) << "is not its own: nothing to do";
  EXPECT_TRUE(two.fleet().KnownOwner("house")->is_me);
}

TEST_F(OwnersTest, AMapIsGivenToAServerThatLivesAndTakesMaps) {
  auto one = Open("one:1"), two = Open("two:2"), three = Open("three:3");
  (void)Create(one);
  Pass(1, {&one, &two, &three});
  constexpr std::int64_t kNobody = 4711;
  EXPECT_EQ(one.fleet().GiveUp("house", kNobody).code(), StatusCode::kFailedPrecondition);
  EXPECT_TRUE(one.fleet().KnownOwner("house")->is_me);
  ASSERT_OK(one.fleet().GiveUp("house", two.fleet().Me().id));
  EXPECT_EQ(OwnerIn(three.store->LoadMap("house").status()), "two:2") << "before the new owner has met a request";
  EXPECT_OK(two.store->LoadMap("house"));
  three.fleet().StopTaking();
  Pass(0.1, {&two, &three});
  EXPECT_EQ(two.fleet().GiveUp("house", three.fleet().Me().id).code(), StatusCode::kFailedPrecondition);
}

TEST_F(OwnersTest, ADrainingServerTakesNothingAndKeepsWhatItHas) {
  auto one = Open("one:1"), two = Open("two:2");
  (void)Create(one);
  const auto own = Create(two, "garden");
  two.fleet().StopTaking();
  ASSERT_OK(one.fleet().GiveUp("house", 0));
  EXPECT_EQ(two.store->LoadMap("house").status().reason(), Reason("OWNER_UNREACHABLE"));
  EXPECT_OK(Commit(two, *own));
  EXPECT_OK(one.store->LoadMap("house"));
}

TEST_F(OwnersTest, ClosingAStoreGivesAllMapsUp) {
  auto one = Open("one:1"), two = Open("two:2");
  (void)Create(one);
  (void)Create(one, "garden");
  const std::int64_t epoch = EpochOf(one);
  one.store.reset();
  EXPECT_OK(two.store->LoadMap("house")) << "no lease has to pass";
  EXPECT_OK(two.store->LoadMap("garden"));
  EXPECT_GT(EpochOf(two), epoch) << "epochs never fall";
  const auto servers = two.fleet().ListServers();
  ASSERT_OK(servers);
  EXPECT_EQ(servers->size(), 1u);
}

TEST_F(OwnersTest, ServersAreListedWithTheirMapsAndTheDeadThatOwnSome) {
  auto one = Open("one:1"), two = Open("two:2"), three = Open("three:3");
  (void)Create(one);
  (void)Create(two, "garden");
  (void)Create(two, "attic");
  two.fleet().StopTaking();
  Pass(0.5, {&one, &two, &three});
  Pass(2.5, {&one});
  const auto servers = one.fleet().ListServers();
  ASSERT_OK(servers);
  std::map<std::string, FleetServer> by_address;
  for (const FleetServer& server : *servers) by_address[server.address] = server;
  ASSERT_EQ(by_address.size(), 2u) << "the third is dead, and owns nothing";
  EXPECT_TRUE(by_address["one:1"].is_alive && by_address["one:1"].is_me);
  EXPECT_EQ(by_address["one:1"].num_maps, 1);
  EXPECT_FALSE(by_address["two:2"].is_alive);
  EXPECT_TRUE(by_address["two:2"].is_draining);
  EXPECT_EQ(by_address["two:2"].num_maps, 2);
  const auto owners = one.fleet().ListOwners("attic", 10);
  ASSERT_OK(owners);
  ASSERT_EQ(owners->size(), 2u);
  EXPECT_EQ((*owners)[0].map, "garden");
  EXPECT_EQ((*owners)[0].owner.address, "two:2");
  EXPECT_EQ((*owners)[1].map, "house");
  EXPECT_TRUE((*owners)[1].owner.is_me);
  EXPECT_EQ(one.fleet().ListOwners("", 1)->size(), 1u);
}

TEST_F(OwnersTest, AMapIsDeletedByItsOwnerAndMayBeMadeElsewhere) {
  auto one = Open("one:1"), two = Open("two:2");
  const auto map = Create(one);
  Pass(1, {&one, &two});
  ASSERT_OK(one.store->DeleteMap("house"));
  EXPECT_EQ(two.store->LoadMap("house").status().code(), StatusCode::kNotFound);
  (void)Create(two);
  EXPECT_FALSE(Commit(one, *map).ok()) << "of the map that was deleted";
  EXPECT_EQ(OwnerIn(one.store->LoadMap("house").status()), "two:2");
}

TEST_F(OwnersTest, CommitsOfOtherServersAreReported) {
  auto one = Open("one:1"), two = Open("two:2");
  const auto map = Create(one);
  const auto own = Create(two, "garden");
  std::vector<std::pair<std::string, std::int64_t>> told;
  two.fleet().OnChange([&](const std::string& name, std::int64_t revision) { told.emplace_back(name, revision); });
  two.fleet().SetFollowed({"house", "garden", "nowhere"});
  const auto look = [&] {
    told.clear();
    EXPECT_OK(two.fleet().LookAtFollowed());
    return told;
  };
  using Told = std::vector<std::pair<std::string, std::int64_t>>;
  EXPECT_EQ(look(), (Told{{"house", map->published()->revision()}})) << "as it begins";
  EXPECT_EQ(look(), Told{});
  ASSERT_OK(Commit(one, *map));
  ASSERT_OK(Commit(two, *own));
  EXPECT_EQ(look(), (Told{{"house", map->published()->revision()}})) << "own commits are told where they are made";
  ASSERT_OK(one.store->DeleteMap("house"));
  EXPECT_EQ(look(), (Told{{"house", 0}})) << "it is gone";
  two.fleet().SetFollowed({});
  EXPECT_EQ(look(), Told{});
}

}  // namespace
}  // namespace dhpmap
