// SPDX-License-Identifier: BSD-3-Clause
// dhpmap_many_tiles_bench DB TILES: makes a map of that many tiles in a store, a file or postgresql://..., and measures
// how long it takes, and how much memory, to open it, to read its tiles, to clone an object of a quarter of them, to
// export and to delete the map. Not a test.
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "mapping/map/map.h"
#include "storage/postgres/connection.h"
#include "storage/postgres_store.h"
#include "storage/sqlite_store.h"
#include "tests/bench/many_tiles.h"
#include "tests/bench/own_process.h"
#include "tests/unit/storage/bench_timing.h"

namespace dhpmap::bench {
namespace {

using testing::Quantile;
using testing::Require;
using testing::TimeOf_ms;

std::unique_ptr<MapStore> OpenPaged(const std::string& db) {
  if (IsPostgresUrl(db)) return Require(OpenPostgresStore(db, {.pages_tiles = true, .answer_s = 600}));
  return Require(OpenSqliteStore(db, {.pages_tiles = true}));
}

/// Prints what it took; memory is this process's own, at most.
void Measure(const char* what, const std::function<void()>& work) {
  malloc_trim(0);  // what earlier work has left is not counted
  const AnonymousPeak peak;
  const double took_ms = TimeOf_ms(work);
  std::printf("%s: %.2f s, %.0f MiB\n", what, took_ms / 1000, static_cast<double>(peak.bytes()) / (1 << 20));
  std::fflush(stdout);
}

/// Tiles spread over the map, one by one. Their blocks go again as soon as they are read.
void ReadSome(const MapSnapshot& map, std::int64_t num_tiles) {
  constexpr std::int64_t kSample = 20'000;
  const std::int64_t stride = std::max<std::int64_t>(1, num_tiles / kSample);
  std::vector<double> times_ms;
  std::int64_t number = 0;
  for (const auto& submap : map.submaps()) {
    for (const TileEntry& entry : submap->blocks().tiles()) {
      if (number++ % stride != 0) continue;
      times_ms.push_back(TimeOf_ms([&] { (void)entry.tile->entries(); }));
    }
  }
  std::printf("a tile of %zu: p50 %.3f ms, p99 %.3f ms\n", times_ms.size(), Quantile(times_ms, .5),
              Quantile(times_ms, .99));
}

void CloneObject(MapStore& store, const std::shared_ptr<const MapSnapshot>& state) {
  Map map(state);
  const StateMarks before(*map.published());
  if (map.Clone(SubmapId(1)) == nullptr) std::exit(1);
  Require(store.Commit(before, *map.Publish(10), Durability::kFull));
}

void ExportMap(MapStore& store) {
  const auto file = Require(store.ExportMap(kManyTilesName, {}));
  std::int64_t size_bytes = 0;
  for (std::string part = "x"; !part.empty(); size_bytes += static_cast<std::int64_t>(part.size())) {
    part = Require(file->Read(256 << 10));
  }
  std::printf("map file: %.0f MB\n", static_cast<double>(size_bytes) / 1e6);
}

/// Until the rows of the removed map are gone, too.
void WaitUntilSwept(const std::string& url) {
  static const std::string text = "SELECT count(*)::bigint FROM removed_maps";
  postgres::Connection connection = Require(postgres::Connection::Open({.url = url}));
  while (true) {
    postgres::Answer answer = Require(connection.Query({&text}, "count the removed maps"));
    if (answer.Next() && answer.Int() == 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

int Run(const std::string& db, std::int64_t num_tiles) {
  auto store = OpenPaged(db);
  Measure("made", [&] { Require(MakeManyTiles(*store, num_tiles)); });
  store = nullptr;  // a file has one owner at a time
  store = OpenPaged(db);
  std::shared_ptr<const MapSnapshot> map;
  Measure("opened", [&] { map = Require(store->LoadMap(kManyTilesName)); });
  Measure("directory", [&] {  // it is read when first asked for
    for (const auto& submap : map->submaps()) (void)submap->blocks().tiles();
  });
  Measure("paged", [&] { ReadSome(*map, num_tiles); });
  Measure("cloned", [&] { CloneObject(*store, map); });
  map = nullptr;
  Measure("exported", [&] { ExportMap(*store); });
  Measure("deleted", [&] { Require(store->DeleteMap(kManyTilesName)); });
  if (IsPostgresUrl(db)) Measure("swept", [&] { WaitUntilSwept(db); });
  return 0;
}

}  // namespace
}  // namespace dhpmap::bench

int main(int argc, char** argv) {
  if (argc != 3 || std::atoll(argv[2]) < dhpmap::bench::kManyTilesObjects) {
    std::fprintf(stderr, "usage: dhpmap_many_tiles_bench DB TILES\n");
    return 2;
  }
  return dhpmap::bench::Run(argv[1], std::atoll(argv[2]));
}
