// SPDX-License-Identifier: BSD-3-Clause
// dhpmap_postgres_bench URL FOLDER [ROUNDS]: commits of 50 tiles to a PostgreSQL database and to a SQLite file in that
// folder with a full sync, in turns; then reads. Not a test.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mapping/map/history_id.h"
#include "storage/postgres_store.h"
#include "storage/sqlite_store.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using Clock = std::chrono::steady_clock;

double TimeOf_ms(const std::function<void()>& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

double Quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void Require(const Status& status) {
  if (status.ok()) return;
  std::fprintf(stderr, "%s\n", status.ToString().c_str());
  std::exit(1);
}

/// A store with a map, and how long its commits took.
struct Side {
  const char* name;
  std::unique_ptr<MapStore> store;
  std::unique_ptr<Map> map;
  testing::MapGenerator generator{3};
  std::vector<double> commits_ms = {}, small_ms = {};

  void Create() {
    map = std::make_unique<Map>(generator.Info("bench"));
    for (int n = 0; n < 5; ++n) generator.AddSubmap(*map, 1);
    Require(store->CreateMap(*map->Publish(1)));
  }
  /// 50 tiles of a block in five submaps: some new, some written again.
  void Commit(int round) {
    const auto before = map->published();
    for (int n = 0; n < 50; ++n) {
      const int tile = (round * 25 + n) % 2000;
      Submap& submap = *map->FindMutable(SubmapId(static_cast<std::uint32_t>(1 + tile % 5)));
      generator.FillTsdf(submap.MutableTsdf({4 * (tile % 40), 4 * (tile / 40), 0}), submap.info().truncation_m);
    }
    commits_ms.push_back(CommitNow(*before, round));
    const auto between = map->published();
    map->mutable_info().num_frames += 1;  // nothing to encode
    small_ms.push_back(CommitNow(*between, round));
  }
  double CommitNow(const MapSnapshot& before, int round) {
    const auto after = map->Publish(round);
    return TimeOf_ms([&] { Require(store->Commit(before, *after, Durability::kFull)); });
  }
};

int Run(const std::string& url, const std::filesystem::path& folder, int num_rounds) {
  const auto file = folder / ("bench-" + std::to_string(DrawHistoryId()) + ".db");
  auto sqlite = OpenSqliteStore(file.string());
  Require(sqlite.status());
  auto postgres = OpenPostgresStore(url, {.schema = "bench_" + std::to_string(DrawHistoryId())});
  Require(postgres.status());
  Side sides[] = {{"SQLite FULL", std::move(*sqlite), nullptr}, {"PostgreSQL", std::move(*postgres), nullptr}};
  for (Side& side : sides) side.Create();
  for (int round = 0; round < num_rounds; ++round) {
    for (Side& side : sides) side.Commit(round);
  }
  for (Side& side : sides) {
    side.commits_ms.erase(side.commits_ms.begin(), side.commits_ms.begin() + num_rounds / 10);
    const StoredMap stored = side.store->GetMap("bench").value();
    if (stored.info.revision != side.map->published()->revision()) return 1;  // else it has measured refusals
    std::vector<double> gets_ms, answers_ms;
    for (int n = 0; n < 200; ++n) {
      gets_ms.push_back(TimeOf_ms([&] { Require(side.store->GetMap("bench").status()); }));
      answers_ms.push_back(TimeOf_ms([&] { Require(side.store->FindAnswer("bench", "none").status()); }));
    }
    const double load_ms = TimeOf_ms([&] { Require(side.store->LoadMap("bench").status()); });
    std::printf(
        "%-12s commit of 50 tiles p50 %.2f p90 %.2f, of none p50 %.2f ms; GetMap p50 %.3f, FindAnswer p50 %.3f ms; "
        "load of %.1f MB "
        "%.1f ms\n",
        side.name, Quantile(side.commits_ms, 0.5), Quantile(side.commits_ms, 0.9), Quantile(side.small_ms, 0.5),
        Quantile(gets_ms, 0.5), Quantile(answers_ms, 0.5), static_cast<double>(stored.blob_bytes) / 1e6, load_ms);
  }
  std::printf("commit: PostgreSQL / SQLite FULL = %.2f\n",
              Quantile(sides[1].commits_ms, 0.5) / Quantile(sides[0].commits_ms, 0.5));
  for (const char* end : {"", "-wal", "-shm"}) std::filesystem::remove(file.string() + end);
  return 0;
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: dhpmap_postgres_bench URL FOLDER [ROUNDS]\n");
    return 2;
  }
  return dhpmap::Run(argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 60);
}
