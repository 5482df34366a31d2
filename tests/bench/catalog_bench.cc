// SPDX-License-Identifier: BSD-3-Clause
// dhpmap_catalog_bench DB MAPS: makes that many small maps in an empty store, a file or postgresql://..., and measures
// how long it takes to open it, to list a page of 100 at several places, and to summarise a map. Not a test.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "storage/postgres_store.h"
#include "storage/sqlite_store.h"
#include "tests/unit/storage/bench_timing.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

using testing::Quantile;
using testing::Require;
using testing::TimeOf_ms;

constexpr std::size_t kPage = 100;

std::unique_ptr<MapStore> OpenStore(const std::string& db) {
  return IsPostgresUrl(db) ? Require(OpenPostgresStore(db)) : Require(OpenSqliteStore(db));
}

std::string NameOf(int number) { return std::string("m").append(std::to_string(100'000 + number)); }

/// On some threads, as their commits are flushed together.
void MakeMaps(MapStore& store, int num_maps) {
  constexpr std::uint32_t kThreads = 6;
  std::atomic<int> next = 0;
  std::vector<std::thread> threads;
  for (std::uint32_t seed = 1; seed <= kThreads; ++seed) {
    threads.emplace_back([&, seed] {
      testing::MapGenerator generator(seed);
      for (int n = next++; n < num_maps; n = next++) {
        Require(store.CreateMap(*Map(generator.Info(NameOf(n))).Publish(1)));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

void MeasurePages(MapStore& store, int num_maps) {
  constexpr int kTimes = 50;
  std::vector<double> all_ms;
  for (const int percent : {0, 25, 50, 75, 99}) {
    std::vector<double> times_ms;
    const std::string after = percent == 0 ? "" : NameOf(static_cast<int>(std::int64_t{num_maps} * percent / 100) - 1);
    for (int n = 0; n < kTimes; ++n) {
      times_ms.push_back(TimeOf_ms([&] { Require(store.ListMaps(after, kPage)); }));
    }
    std::printf("a page of %zu at %d %%: p50 %.2f ms\n", kPage, percent, Quantile(times_ms, .5));
    all_ms.insert(all_ms.end(), times_ms.begin(), times_ms.end());
  }
  std::printf("a page of %zu: p50 %.2f ms, p99 %.2f ms\n", kPage, Quantile(all_ms, .5), Quantile(all_ms, .99));
}

void MeasureSummaries(MapStore& store, int num_maps) {
  std::vector<double> times_ms;
  for (int n = 0; n < 500; ++n) {
    const std::string name = NameOf(static_cast<int>(std::int64_t{n} * 7919 % num_maps));
    times_ms.push_back(TimeOf_ms([&] { Require(store.GetMap(name)); }));
  }
  std::printf("summary of a map: p50 %.3f ms, p99 %.3f ms\n", Quantile(times_ms, .5), Quantile(times_ms, .99));
}

int Run(const std::string& db, int num_maps) {
  auto store = OpenStore(db);
  const double made_ms = TimeOf_ms([&] { MakeMaps(*store, num_maps); });
  std::printf("%d maps made in %.1f s\n", num_maps, made_ms / 1000);
  std::vector<double> opened_ms;
  for (int n = 0; n < 5; ++n) {
    store = nullptr;
    opened_ms.push_back(TimeOf_ms([&] { store = OpenStore(db); }));
  }
  std::printf("store opened: p50 %.1f ms\n", Quantile(opened_ms, .5));
  MeasurePages(*store, num_maps);
  MeasureSummaries(*store, num_maps);
  return 0;
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) {
  if (argc != 3 || std::atoi(argv[2]) < 1) {
    std::fprintf(stderr, "usage: dhpmap_catalog_bench DB MAPS\n");
    return 2;
  }
  return dhpmap::Run(argv[1], std::atoi(argv[2]));
}
