// SPDX-License-Identifier: BSD-3-Clause
// What disks do to the store: at every n-th call, in growing strides.
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include "tests/support/places.h"
#include "tests/unit/storage/disk_fault.h"
#include "tests/unit/storage/sqlite_fixture.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using testing::DiskFault;
using testing::ExpectDiscreet;
using testing::ExpectSameMap;
using testing::SqliteStoreTest;
using Kind = DiskFault::Kind;

int Next(int nth) { return nth + 1 + nth / 4; }

/// A store that is written by another process until the power goes.
class PowerCutTest : public SqliteStoreTest {
 protected:
  /// Runs `body`, which may write to `told`, in a process that ends with it or before. What was told.
  template <typename Body>
  std::vector<int> RunElsewhere(Body&& body, int& state) {
    std::array<int, 2> told{};
    EXPECT_EQ(pipe(told.data()), 0);
    const pid_t child = fork();
    if (child == 0) {
      body(told[1]);
      _exit(0);
    }
    close(told[1]);
    std::vector<int> heard;
    for (int number = 0; read(told[0], &number, sizeof(number)) == sizeof(number);) heard.push_back(number);
    close(told[0]);
    waitpid(child, &state, 0);
    fs::remove(Path() + "-shm");  // of memory: gone with the power
    return heard;
  }
  void Keep() {
    store_ = nullptr;
    fs::copy_file(Path(), Path() + ".given", fs::copy_options::overwrite_existing);
  }
  void Restart() {
    store_ = nullptr;
    for (const char* suffix : {"-wal", "-shm", "-lock"}) fs::remove(Path() + suffix);
    fs::copy_file(Path() + ".given", Path(), fs::copy_options::overwrite_existing);
  }
  void ExpectSound() {
    EXPECT_EQ(Query("SELECT count(*) FROM pragma_integrity_check WHERE integrity_check = 'ok'"), 1);
  }
};

TEST_F(PowerCutTest, EveryAcknowledgedCommitIsThereAndAtMostOneMore) {
  constexpr int kCommits = 4;
  Open();
  const auto map = CreateSample("house");
  std::vector<std::shared_ptr<const MapSnapshot>> states{map->published()};
  Keep();
  for (int n = 1; n <= kCommits; ++n) {
    generator_.AddBlocks(*map->FindMutable(SubmapId(2)), 3);
    if (n % 2 == 0) map->Clone(SubmapId(1));  // an edit: rows only
    states.push_back(map->Publish(20 + n));
  }
  const auto commit_all = [&](int nth, int told) {
    auto store = OpenSqliteStore(Path());
    const DiskFault fault(Kind::kPowerCut, nth, static_cast<std::uint32_t>(nth));
    for (std::size_t n = 1; n < states.size(); ++n) {
      if (!(*store)->Commit(*states[n - 1], *states[n], Durability::kFull).ok()) _exit(1);
      const auto number = static_cast<int>(n);
      (void)!write(told, &number, sizeof(number));
    }
    store->reset();  // with a checkpoint
  };
  int num_cuts = 0;
  for (int nth = 1; nth < 3000; nth = Next(nth)) {
    SCOPED_TRACE("call " + std::to_string(nth));
    Restart();
    int state = 0;
    const std::vector<int> heard = RunElsewhere([&](int told) { commit_all(nth, told); }, state);
    Open();
    const auto stored = store_->GetMap("house");
    ASSERT_TRUE(stored.ok()) << stored.status().ToString();
    const std::size_t num_told = heard.size();
    std::size_t found = 0;
    while (found < states.size() && states[found]->revision() != stored->info.revision) ++found;
    ASSERT_LT(found, states.size());
    EXPECT_GE(found, num_told);
    EXPECT_LE(found, num_told + 1);
    ExpectStored(*states[found]);
    EXPECT_EQ(store_->VerifyMap("house", false, {})->num_faults, 0);
    ExpectSound();
    ASSERT_FALSE(HasFailure());
    if (WIFEXITED(state)) {
      ASSERT_EQ(WEXITSTATUS(state), 0);
      break;  // it needs no more than nth calls
    }
    ++num_cuts;
  }
  EXPECT_GT(num_cuts, 12);
}

class MigrationFaultTest : public PowerCutTest, public ::testing::WithParamInterface<Kind> {
 protected:
  void SetUp() override {
    const fs::path released = testing::SourceDir() / "tests/unit/storage/released/schema-6.sqlite";
    fs::copy_file(released, Path());
    Keep();
    Open();
    const auto maps = store_->ListMaps();
    ASSERT_TRUE(maps.ok());
    for (const StoredMap& map : *maps) {
      const auto loaded = store_->LoadMap(map.info.name);
      if (loaded.ok()) expected_.push_back(*loaded);
    }
    ASSERT_FALSE(expected_.empty());
  }
  void ExpectAllOfIt() {
    for (const auto& map : expected_) {
      const auto loaded = store_->LoadMap(map->info().name);
      ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
      MapInfo info = map->info();  // schema 3 drew histories, which a migration from before draws anew
      info.history_id = (*loaded)->info().history_id;
      ExpectSameMap(MapSnapshot(info, map->submaps(), map->free_space(), map->vacated()), **loaded);
    }
    ExpectSound();
  }
  std::vector<std::shared_ptr<const MapSnapshot>> expected_;
};

TEST_P(MigrationFaultTest, AFaultAtAnyCallLosesNothingAndTheNextStartGoesOn) {
  const bool is_end = GetParam() == Kind::kKill || GetParam() == Kind::kPowerCut;
  int num_failed = 0;
  for (int nth = 1; nth < 20'000; nth = Next(nth) + nth / 4) {
    SCOPED_TRACE("call " + std::to_string(nth));
    Restart();
    bool has_struck = true;
    if (is_end) {
      int state = 0;
      RunElsewhere(
          [&](int) {
            const DiskFault fault(GetParam(), nth, static_cast<std::uint32_t>(nth));
            _exit(OpenSqliteStore(Path()).ok() ? 0 : 1);
          },
          state);
      has_struck = !WIFEXITED(state);
      num_failed += has_struck;
      if (!has_struck) {
        EXPECT_EQ(WEXITSTATUS(state), 0);
      }
    } else {
      const DiskFault fault(GetParam(), nth);
      const Status opened = TryOpen();
      has_struck = fault.has_struck();
      num_failed += !opened.ok();
      if (!opened.ok()) {
        EXPECT_TRUE(opened.code() == StatusCode::kResourceExhausted || opened.code() == StatusCode::kUnavailable)
            << opened.ToString();
        ExpectDiscreet(opened, Path());
      }
    }
    Open();
    ExpectAllOfIt();
    ASSERT_FALSE(HasFailure());
    if (!has_struck) break;
  }
  EXPECT_GT(num_failed, 0);
}

std::string NameOf(const ::testing::TestParamInfo<Kind>& kind) {
  switch (kind.param) {
    case Kind::kFull: return "FullDisk";
    case Kind::kBroken: return "BrokenDisk";
    case Kind::kShort: return "ShortWrite";
    case Kind::kNoSync: return "FailingSync";
    case Kind::kKill: return "Killed";
    case Kind::kPowerCut: return "PowerCut";
  }
  return "Unknown";
}

INSTANTIATE_TEST_SUITE_P(Faults, MigrationFaultTest,
                         ::testing::Values(Kind::kFull, Kind::kBroken, Kind::kNoSync, Kind::kKill, Kind::kPowerCut),
                         NameOf);

TEST_F(PowerCutTest, AShortWriteIsGoneOnWith) {
  Open();
  const auto map = CreateSample("house");
  for (int nth = 1; nth < 300; nth = Next(nth)) {
    SCOPED_TRACE("call " + std::to_string(nth));
    const auto before = map->published();
    generator_.AddBlocks(*map->FindMutable(SubmapId(2)), 2);
    const auto after = map->Publish(nth);
    const DiskFault fault(Kind::kShort, nth);
    const Status committed = store_->Commit(*before, *after, Durability::kFull);
    EXPECT_TRUE(committed.ok()) << committed.ToString();
    if (!fault.has_struck()) break;
  }
  Open();
  ExpectStored(*map->published());
  ExpectSound();
}

TEST_F(PowerCutTest, ABackupThatFailsAtAnyCallLeavesNothingAndTheStoreGoesOn) {
  Open();
  const auto map = CreateSample("house");
  const auto num_files = [&] {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator{});
  };
  const auto num_before = num_files();
  for (const Kind kind : {Kind::kFull, Kind::kBroken, Kind::kNoSync}) {
    int num_failed = 0;
    for (int nth = 1; nth < 3000; nth = Next(nth)) {
      SCOPED_TRACE("fault " + std::to_string(static_cast<int>(kind)) + ", call " + std::to_string(nth));
      bool has_struck = false;
      {
        const DiskFault fault(kind, nth);
        const Status made = store_->Backup({}).status();
        has_struck = fault.has_struck();
        num_failed += !made.ok();
        if (!made.ok()) {
          EXPECT_TRUE(made.code() == StatusCode::kResourceExhausted || made.code() == StatusCode::kUnavailable)
              << made.ToString();
          ExpectDiscreet(made, Path());
        }
      }
      EXPECT_EQ(num_files(), num_before);
      ASSERT_FALSE(HasFailure());
      if (!has_struck) break;
    }
    EXPECT_GT(num_failed, 0);
  }
  const auto before = map->published();
  generator_.Change(*map);
  ASSERT_TRUE(store_->Commit(*before, *map->Publish(40), Durability::kFull).ok());
  ExpectStored(*map->published());
}

}  // namespace
}  // namespace dhpmap
