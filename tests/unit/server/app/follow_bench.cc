// SPDX-License-Identifier: BSD-3-Clause
// dhpmap_follow_bench [ROUNDS]: how far another process is behind commits of 50 tiles to a PostgreSQL server of its own
// without fsync: its watchers, and its copy of the map. Not a test.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/app/follow/followed_maps.h"
#include "storage/postgres_store.h"
#include "tests/support/lone_fleet.h"
#include "tests/support/postgres_cluster.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using Clock = std::chrono::steady_clock;

void Require(const Status& status) {
  if (status.ok()) return;
  std::fprintf(stderr, "%s\n", status.ToString().c_str());
  std::exit(1);
}

/// Polls every 50 ms, like a fleet, for a store without one.
class PollingFleet final : public testing::LoneFleet {
 public:
  explicit PollingFleet(MapStore& store) : store_(store) {}
  void OnChange(std::function<void(const std::string&, std::int64_t)> on_change) override {
    on_change_ = std::move(on_change);
  }
  void SetFollowed(std::vector<std::string> maps) override {
    if (maps.empty() || thread_.joinable()) return;
    thread_ = std::jthread([this, map = maps.front()](const std::stop_token& stop) {
      for (std::int64_t last = 0; !stop.stop_requested(); std::this_thread::sleep_for(std::chrono::milliseconds(50))) {
        const auto told = store_.GetMap(map);
        if (!told.ok() || told->info.revision == last) continue;
        last = told->info.revision;
        on_change_(map, last);
      }
    });
  }

 private:
  MapStore& store_;
  std::function<void(const std::string&, std::int64_t)> on_change_;
  std::jthread thread_;
};

/// The arrival times of commits.
class Arrivals {
 public:
  void Note(std::int64_t count) {
    const std::lock_guard lock(mutex_);
    count_ = std::max(count_, count);
    changed_.notify_all();
  }
  double WaitFor_ms(std::int64_t count, Clock::time_point since) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return count_ >= count; });
    return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t count_ = 0;
};

void Print(const char* what, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = [&](double share) { return values[static_cast<std::size_t>(share * last)]; };
  std::printf("%-28s p50 %6.1f  p99 %6.1f ms\n", what, at(.5), at(.99));
}

int Run(int num_rounds) {
  auto* cluster = testing::PostgresCluster::Get();
  if (cluster == nullptr) return std::fprintf(stderr, "%s\n", testing::PostgresCluster::WhyThereIsNone()), 1;
  const std::string schema = cluster->NewSchema();
  auto owner = OpenPostgresStore(cluster->Url(), {.schema = schema});
  auto reader = OpenPostgresStore(cluster->Url(), {.schema = schema});
  Require(owner.status());
  Require(reader.status());
  testing::MapGenerator generator(3);
  Map map(generator.Info("bench"));
  for (int n = 0; n < 5; ++n) generator.AddSubmap(map, 1);
  Require((*owner)->CreateMap(*map.Publish(1)));
  PollingFleet polling(**reader);
  Fleet& fleet = (*reader)->fleet() != nullptr ? *(*reader)->fleet() : polling;
  Arrivals told, copied;
  std::atomic<std::int64_t> num_told = 0;
  FollowedMaps maps(**reader, fleet,
                    {.on_commit = [&](const std::string&) { told.Note(++num_told); },
                     .on_state = [&](const auto& state) { copied.Note(state->revision()); }});
  Require(maps.ViewOf("bench").status());
  std::this_thread::sleep_for(std::chrono::seconds(1));
  std::vector<double> told_ms, copied_ms;
  for (int round = 0; round < num_rounds; ++round) {
    const auto before = map.published();
    for (int n = 0; n < 50; ++n) {
      const int tile = (round * 25 + n) % 2000;
      Submap& submap = *map.FindMutable(SubmapId(static_cast<std::uint32_t>(1 + tile % 5)));
      generator.FillTsdf(submap.MutableTsdf({4 * (tile % 40), 4 * (tile / 40), 0}), submap.info().truncation_m);
    }
    const auto after = map.Publish(round + 2);
    const std::int64_t num_before = num_told;
    Require((*owner)->Commit(*before, *after, Durability::kFull));
    const auto committed = Clock::now();
    told_ms.push_back(told.WaitFor_ms(num_before + 1, committed));
    copied_ms.push_back(copied.WaitFor_ms(after->revision(), committed));
    std::this_thread::sleep_for(std::chrono::milliseconds(100 + 7 * round % 50));
  }
  Print("watchers are woken after", told_ms);
  Print("the copy is there after", copied_ms);
  maps.Stop();
  return 0;
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) { return dhpmap::Run(argc > 1 ? std::atoi(argv[1]) : 60); }
