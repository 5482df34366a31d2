// SPDX-License-Identifier: BSD-3-Clause
// dhpmap_postgres_bench URL FOLDER [ROUNDS]: a PostgreSQL database against an SQLite file in that folder with a full
// sync, in turns: commits of 50 tiles, of one map and of eight at once; round trips; reads. Not a test.
// tests/rig/fleet/table.py gives it a database of its own, alone and with two standbys.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "mapping/map/history_id.h"
#include "mapping/paging/tile_page.h"
#include "storage/postgres/connection.h"
#include "storage/postgres_store.h"
#include "storage/sqlite_store.h"
#include "tests/unit/storage/bench_timing.h"
#include "tests/unit/storage/blob_reads.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::Quantile;
using testing::Require;
using testing::TimeOf_ms;

/// A map of a store, and how long its commits took.
struct Writer {
  MapStore* store;
  std::string name = "bench";
  std::unique_ptr<Map> map = nullptr;
  testing::MapGenerator generator{3};
  std::vector<double> commits_ms = {}, small_ms = {};

  void Create() {
    map = std::make_unique<Map>(generator.Info(name));
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
  }
  void CommitNothing(int round) {
    const auto between = map->published();
    map->mutable_info().num_frames += 1;  // nothing to encode
    small_ms.push_back(CommitNow(*between, round));
  }
  double CommitNow(const MapSnapshot& before, int round) {
    const auto after = map->Publish(round);
    return TimeOf_ms([&] { Require(store->Commit(before, *after, Durability::kFull)); });
  }
};

/// What PostgreSQL counts.
class Counters {
 public:
  Counters(const std::string& url, const std::string& schema)
      : connection_(Connect(url, schema)),
        hot_("SELECT sum(n_tup_hot_upd)::bigint, sum(n_tup_upd)::bigint FROM pg_stat_user_tables WHERE schemaname = '" +
             schema + "' AND relname = 'maps'") {}

  std::int64_t WalBytes() { return Ask("SELECT (pg_current_wal_insert_lsn() - '0/0')::bigint").front(); }
  /// Of all that were written: those that nobody refers to any more stay for ten minutes.
  std::int64_t BlobBytes() {
    return Ask("SELECT coalesce(sum(octet_length(blob)), 0)::bigint FROM tile_blobs").front();
  }
  /// Of the updates of table maps, those that touched no index.
  double HotShare(std::int64_t num_updates) {
    std::vector<std::int64_t> counted;
    for (int n = 0; n < 30; ++n) {  // an idle session tells what it has counted after ten seconds
      counted = Ask(hot_);
      if (counted[1] >= num_updates) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
    return static_cast<double>(counted[0]) / static_cast<double>(std::max<std::int64_t>(1, counted[1]));
  }

 private:
  static postgres::Connection Connect(const std::string& url, const std::string& schema) {
    auto opened = postgres::Connection::Open({.url = url, .schema = schema});
    Require(opened.status());
    return std::move(opened).value();
  }
  std::vector<std::int64_t> Ask(const std::string& sql) {
    texts_.push_back(std::make_unique<std::string>(sql));
    auto answer = connection_.Query({texts_.back().get()}, "count");
    Require(answer.status());
    std::vector<std::int64_t> values;
    while (answer->Next()) {
      values.push_back(answer->Int());
      if (sql == hot_) values.push_back(answer->Int());
    }
    return values;
  }

  postgres::Connection connection_;
  const std::string hot_;
  std::vector<std::unique_ptr<std::string>> texts_;  ///< statements are named by them
};

using Open = std::function<std::unique_ptr<MapStore>(bool pages_tiles)>;

void Commits(MapStore& sqlite, MapStore& postgres, Counters& counters, int num_rounds) {
  Writer files{&sqlite}, tables{&postgres};
  for (Writer* writer : {&files, &tables}) writer->Create();
  std::int64_t wal_bytes = 0;
  const std::int64_t blobs_before = counters.BlobBytes();
  for (int round = 0; round < num_rounds; ++round) {
    files.Commit(round);
    const std::int64_t wal = counters.WalBytes();
    tables.Commit(round);
    wal_bytes += counters.WalBytes() - wal;
    for (Writer* writer : {&files, &tables}) writer->CommitNothing(round);
  }
  const StoredMap stored = postgres.GetMap("bench").value();
  if (stored.info.revision != tables.map->published()->revision()) std::exit(1);  // else it has measured refusals
  const std::int64_t written_bytes = counters.BlobBytes() - blobs_before;
  std::printf("commit of 50 tiles, p50 / p90 ms: SQLite FULL %.2f / %.2f, PostgreSQL %.2f / %.2f: %.2f x\n",
              Quantile(files.commits_ms, .5), Quantile(files.commits_ms, .9), Quantile(tables.commits_ms, .5),
              Quantile(tables.commits_ms, .9), Quantile(tables.commits_ms, .5) / Quantile(files.commits_ms, .5));
  std::printf("commit of the map's row, p50 ms: %.2f, %.2f: %.2f x\n", Quantile(files.small_ms, .5),
              Quantile(tables.small_ms, .5), Quantile(tables.small_ms, .5) / Quantile(files.small_ms, .5));
  std::printf("WAL / blobs written: %.2f; HOT updates of maps: %.1f %%\n",
              static_cast<double>(wal_bytes) / static_cast<double>(written_bytes),
              100 * counters.HotShare(2 * num_rounds));
}

/// Commits a second of so many maps at once.
double Rate(MapStore& store, const std::string& prefix, int num_maps, int num_rounds) {
  std::vector<std::unique_ptr<Writer>> writers;
  for (int n = 0; n < num_maps; ++n) {
    writers.push_back(std::make_unique<Writer>(Writer{&store, prefix + std::to_string(n)}));
    writers.back()->Create();
  }
  const double took_ms = TimeOf_ms([&] {
    std::vector<std::thread> threads;
    for (auto& writer : writers) {
      threads.emplace_back([&writer, num_rounds] {
        for (int round = 0; round < num_rounds; ++round) writer->Commit(round);
      });
    }
    for (std::thread& thread : threads) thread.join();
  });
  return 1000.0 * num_maps * num_rounds / took_ms;
}

void EightMaps(MapStore& sqlite, MapStore& postgres, int num_rounds) {
  const double file_one = Rate(sqlite, "one-", 1, num_rounds), one = Rate(postgres, "one-", 1, num_rounds);
  const double file_all = Rate(sqlite, "all-", 8, num_rounds), all = Rate(postgres, "all-", 8, num_rounds);
  std::printf("commits/s of 1 map and of 8: SQLite %.0f, %.0f; PostgreSQL %.0f, %.0f: %.2f x\n", file_one, file_all,
              one, all, all / one);
}

/// How long each tile takes that is read by itself, ms.
std::vector<double> ReadPages(const MapSnapshot& map) {
  std::vector<double> times_ms;
  for (const auto& submap : map.submaps()) {
    for (const TileEntry& tile : submap->blocks().tiles()) {
      times_ms.push_back(TimeOf_ms([&] { (void)tile.tile->entries(); }));
    }
  }
  return times_ms;
}

void Reads(const Open& open_sqlite, const Open& open_postgres) {
  double whole_ms[2] = {}, opened_ms[2] = {}, pages_ms[2] = {}, point_ms[2] = {}, get_ms[2] = {};
  double megabytes = 0;
  for (int side = 0; side < 2; ++side) {
    const Open& open = side == 0 ? open_sqlite : open_postgres;
    auto whole = open(false);
    std::vector<double> loads, gets;
    for (int n = 0; n < 5; ++n) loads.push_back(TimeOf_ms([&] { Require(whole->LoadMap("bench").status()); }));
    for (int n = 0; n < 300; ++n) gets.push_back(TimeOf_ms([&] { Require(whole->GetMap("bench").status()); }));
    megabytes = static_cast<double>(whole->GetMap("bench")->blob_bytes) / 1e6;
    whole = nullptr;  // a file has one owner at a time
    const auto paged = open(true);
    std::shared_ptr<const MapSnapshot> map;
    opened_ms[side] = TimeOf_ms([&] { map = paged->LoadMap("bench").value(); });
    std::vector<double> points;
    pages_ms[side] = TimeOf_ms([&] { points = ReadPages(*map); });
    whole_ms[side] = Quantile(loads, .5);
    get_ms[side] = Quantile(gets, .5);
    point_ms[side] = Quantile(points, .5);
  }
  std::printf("whole map of %.1f MB: SQLite %.1f ms, PostgreSQL %.1f: %.2f x\n", megabytes, whole_ms[0], whole_ms[1],
              whole_ms[1] / whole_ms[0]);
  std::printf("opened with paging: %.1f, %.1f ms; all tiles one by one: %.1f, %.1f ms: %.2f x\n", opened_ms[0],
              opened_ms[1], pages_ms[0], pages_ms[1], pages_ms[1] / pages_ms[0]);
  std::printf("a tile read and decoded, p50 ms: %.3f, %.3f: %.2f x; GetMap %.3f, %.3f: %.2f x\n", point_ms[0],
              point_ms[1], point_ms[1] / point_ms[0], get_ms[0], get_ms[1], get_ms[1] / get_ms[0]);
}

void Blobs(const std::string& url, const std::string& schema, const std::filesystem::path& file) {
  const testing::BlobReads files = testing::ReadSqliteBlobs(file), tables = testing::ReadPostgresBlobs(url, schema);
  const double by_key_us = files.one_by_one_us;
  std::printf(
      "a blob, us: SQLite by key %.1f; PostgreSQL by map %.1f: %.2f x, by 64 keys %.1f: %.2f x, by key %.1f: %.2f x\n",
      by_key_us, tables.by_map_us, tables.by_map_us / by_key_us, tables.by_64_us, tables.by_64_us / by_key_us,
      tables.one_by_one_us, tables.one_by_one_us / by_key_us);
}

int Run(const std::string& url, const std::filesystem::path& folder, int num_rounds) {
  const auto file = folder / ("bench-" + std::to_string(DrawHistoryId()) + ".db");
  const std::string schema = "bench_" + std::to_string(DrawHistoryId());
  const Open open_sqlite = [&file](bool pages_tiles) {
    auto opened = OpenSqliteStore(file.string(), {.pages_tiles = pages_tiles});
    Require(opened.status());
    return std::move(opened).value();
  };
  const Open open_postgres = [&](bool pages_tiles) {
    auto opened = OpenPostgresStore(url, {.schema = schema, .pages_tiles = pages_tiles});
    Require(opened.status());
    return std::move(opened).value();
  };
  {
    const auto sqlite = open_sqlite(false), postgres = open_postgres(false);
    Counters counters(url, schema);
    Commits(*sqlite, *postgres, counters, num_rounds);
    EightMaps(*sqlite, *postgres, std::max(1, num_rounds / 4));
  }
  std::printf("round trips a commit: %d\n", testing::CountTripsOfCommits(url, schema));
  Reads(open_sqlite, open_postgres);
  Blobs(url, schema, file);
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
