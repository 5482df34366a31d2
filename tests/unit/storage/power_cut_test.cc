// SPDX-License-Identifier: BSD-3-Clause
// What disks do to the store: at every n-th call, in growing strides.
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <functional>
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
  using Tell = std::function<void(int)>;
  using Work = std::function<Status(MapStore&, const Tell&)>;
  /// Has `work` done on what was kept, by a store of its own each time, until the power goes at its first call, at its
  /// second, and so on until it needs no more; `look` sees what is left, and what was told last (0: nothing). Returns
  /// how many cuts there were.
  int CutAtEachCall(const Work& work, const std::function<void(int)>& look) {
    constexpr int kMostCalls = 3000;
    for (int nth = 1; nth <= kMostCalls; ++nth) {
      SCOPED_TRACE("call " + std::to_string(nth));
      Restart();
      int state = 0;
      const std::vector<int> heard = RunElsewhere([&](int told) { WorkUntil(nth, work, told); }, state);
      Open();
      if (HasFatalFailure()) return nth;
      look(heard.empty() ? 0 : heard.back());
      ExpectSound();
      if (HasFailure()) return nth;
      if (!WIFEXITED(state)) continue;
      EXPECT_EQ(WEXITSTATUS(state), 0);
      return nth - 1;
    }
    ADD_FAILURE() << "it needs more than " << kMostCalls << " calls";
    return kMostCalls;
  }
  void WorkUntil(int nth, const Work& work, int told) {
    auto store = OpenSqliteStore(Path());
    if (!store.ok()) _exit(1);
    const DiskFault fault(Kind::kPowerCut, nth, static_cast<std::uint32_t>(nth));
    const auto tell = [told](int number) { (void)!write(told, &number, sizeof(number)); };
    if (!work(**store, tell).ok()) _exit(1);
    store->reset();  // with a checkpoint
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

/// States of a map, each with a frame more than the one before.
std::vector<std::shared_ptr<const MapSnapshot>> StatesFrom(Map& map, std::size_t count) {
  std::vector<std::shared_ptr<const MapSnapshot>> states;
  states.reserve(count);
  states.push_back(map.published());
  while (states.size() < count) {
    ++map.mutable_info().num_frames;  // rows only: few calls, so that there is time for a cut at each
    states.push_back(map.Publish(map.info().update_time_ns + 1));
  }
  return states;
}

// Once Reserve has returned, states with these numbers are shown, and stored later.
TEST_F(PowerCutTest, NumbersThatWereReservedAreNeverGivenOutAgain) {
  constexpr int kSteps = 3;
  Open();
  const auto map = CreateSample("house");
  Keep();
  const std::uint32_t first_id = map->info().next_submap_id.value;
  const auto marks_of = [&](int step) {
    return NumberMarks{.revision = 1 + std::int64_t{100} * step,
                       .next_submap_id = SubmapId(first_id + 50 * static_cast<std::uint32_t>(step))};
  };
  const auto states = StatesFrom(*map, kSteps + 1);
  const auto reserve_ahead = [&](MapStore& store, const Tell& tell) {
    for (int step = 1; step <= kSteps; ++step) {
      DHPMAP_RETURN_IF_ERROR(store.Reserve("house", marks_of(step)));
      tell(step);
      const auto n = static_cast<std::size_t>(step);
      DHPMAP_RETURN_IF_ERROR(store.Commit(*states[n - 1], *states[n], Durability::kNormal));
    }
    return Status::Ok();
  };
  const int num_cuts = CutAtEachCall(reserve_ahead, [&](int step) {
    const auto stored = store_->GetMap("house");
    ASSERT_TRUE(stored.ok()) << stored.status().ToString();
    EXPECT_LE(stored->info.revision, marks_of(step + 1).revision + 1) << "the step that was under way, and no other";
    EXPECT_EQ(IsLost(stored->lost_revisions, marks_of(step).revision), step > 0);
    const auto loaded = store_->LoadMap("house");
    ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
    Map next(*loaded);
    EXPECT_GE(generator_.AddSubmap(next, 1).id().value, marks_of(step).next_submap_id.value);
    EXPECT_GT(next.Publish(50)->revision(), marks_of(step).revision);
  });
  EXPECT_GT(num_cuts, 12);
}

TEST_F(PowerCutTest, AnEditThatWasAnsweredIsThereWithItsEntryInTheLogAndItsAnswer) {
  constexpr std::size_t kEdits = 2;
  Open();
  const auto map = CreateSample("house");
  Keep();
  const auto request_of = [](std::size_t edit) { return "request " + std::to_string(edit); };
  std::vector<std::shared_ptr<const MapSnapshot>> states;
  states.reserve(2 * kEdits + 1);
  states.push_back(map->published());
  for (std::size_t edit = 1; edit <= kEdits; ++edit) {
    ++map->mutable_info().num_frames;
    states.push_back(map->Publish(20));
    map->FindMutable(SubmapId(1))->mutable_info().display_name = request_of(edit);
    states.push_back(map->Publish(21));
  }
  const auto record_of = [&](std::size_t edit) {
    const EditSource source{.author = "anna", .request_id = request_of(edit)};
    return EditRecord{.entry = {states[2 * edit]->revision(), 20, source, {}},
                      .answer = "answer to " + request_of(edit),
                      .before = states[2 * edit - 1]};
  };
  const auto edit_all = [&](MapStore& store, const Tell& tell) {
    for (std::size_t edit = 1; edit <= kEdits; ++edit) {
      DHPMAP_RETURN_IF_ERROR(store.Commit(*states[2 * edit - 2], *states[2 * edit - 1], Durability::kNormal));
      DHPMAP_RETURN_IF_ERROR(store.CommitEdit(*states[2 * edit - 1], *states[2 * edit], record_of(edit)));
      tell(static_cast<int>(edit));
    }
    return Status::Ok();
  };
  const int num_cuts = CutAtEachCall(edit_all, [&](int told) {
    const auto stored = store_->GetMap("house");
    ASSERT_TRUE(stored.ok()) << stored.status().ToString();
    const auto num_answered = static_cast<std::size_t>(told);
    const auto found = static_cast<std::size_t>(stored->info.revision - states[0]->revision());
    ASSERT_LT(found, states.size());
    EXPECT_GE(found, 2 * num_answered);
    EXPECT_LE(found, 2 * num_answered + 2) << "at most the one that was under way";
    ExpectStored(*states[found]);
    const auto edits = store_->ListEdits("house", {});
    ASSERT_TRUE(edits.ok()) << edits.status().ToString();
    ASSERT_EQ(edits->size(), found / 2) << "the log has what the map has";
    for (std::size_t edit = 1; edit <= kEdits; ++edit) {
      const auto answer = store_->FindAnswer("house", request_of(edit));
      ASSERT_TRUE(answer.ok()) << answer.status().ToString();
      ASSERT_EQ(answer->has_value(), edit <= found / 2);
      if (*answer) {
        EXPECT_EQ((*answer)->answer, record_of(edit).answer);
      }
    }
  });
  EXPECT_GT(num_cuts, 12);
}

// So that the two above show something: a power cut takes what was not synced.
TEST_F(PowerCutTest, WithoutAFullSyncWhatWasToldIsLostAndItsNumbersAreGivenOutAgain) {
  constexpr int kCommits = 3;
  Open();
  const auto map = CreateSample("house");
  Keep();
  const auto states = StatesFrom(*map, kCommits + 1);
  const auto commit_all = [&](MapStore& store, const Tell& tell) {
    for (int n = 1; n <= kCommits; ++n) {
      const auto after = static_cast<std::size_t>(n);
      DHPMAP_RETURN_IF_ERROR(store.Commit(*states[after - 1], *states[after], Durability::kNormal));
      tell(n);
    }
    return Status::Ok();
  };
  int num_lost = 0, num_given_out_again = 0;
  CutAtEachCall(commit_all, [&](int told) {
    const auto loaded = store_->LoadMap("house");
    ASSERT_TRUE(loaded.ok()) << loaded.status().ToString();
    const std::int64_t told_revision = states[static_cast<std::size_t>(told)]->revision();
    num_lost += (*loaded)->revision() < told_revision;
    Map next(*loaded);
    ++next.mutable_info().num_frames;
    num_given_out_again += next.Publish(50)->revision() <= told_revision;
  });
  EXPECT_GT(num_lost, 0);
  EXPECT_GT(num_given_out_again, 0);
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
      ExpectSameMap(MapSnapshot(info, map->submaps(), map->free_space(), VacatedSpace{map->vacated()}), **loaded);
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
