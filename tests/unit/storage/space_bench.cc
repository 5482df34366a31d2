// SPDX-License-Identifier: BSD-3-Clause
// How the space of a deleted map goes back to the file system, and what the commits of another map wait for it.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "tests/support/scenes.h"
#include "tests/unit/storage/map_fixtures.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

void Must(const Status& status) {
  if (status.ok()) return;
  std::fprintf(stderr, "%s\n", status.ToString().c_str());
  std::exit(1);
}

double Megabytes(const std::string& path) {
  std::error_code none;
  const auto bytes = fs::file_size(path, none);
  return none ? 0 : static_cast<double>(bytes) / 1e6;
}

/// Commits to one map until it is told to stop, and how long each took.
class Committer {
 public:
  Committer(MapStore& store, testing::MapGenerator& generator)
      : store_(store), generator_(generator), map_(generator.Info("other")) {
    id_ = generator_.AddSubmap(map_, 60).id();
    Must(store_.CreateMap(*map_.Publish(1)));
  }
  void RunUntil(const std::atomic<bool>& is_over) {
    while (!is_over) {
      const auto before = map_.published();
      generator_.AddBlocks(*map_.FindMutable(id_), 10);
      const auto after = map_.Publish(++time_ns_);
      const auto begin = Clock::now();
      Must(store_.Commit(*before, *after, Durability::kNormal));
      times_ms_.push_back(MillisecondsSince(begin));
    }
  }
  /// Of the commits since the last call.
  void Report(const char* when) {
    if (times_ms_.empty()) return;
    std::sort(times_ms_.begin(), times_ms_.end());
    std::printf("commits %s: %zu, median %.1f ms, 99th percentile %.1f, longest %.1f\n", when, times_ms_.size(),
                times_ms_[times_ms_.size() / 2], times_ms_[times_ms_.size() * 99 / 100], times_ms_.back());
    times_ms_.clear();
  }

 private:
  MapStore& store_;
  testing::MapGenerator& generator_;
  Map map_;
  SubmapId id_;
  std::int64_t time_ns_ = 1;
  std::vector<double> times_ms_;
};

/// Runs `body` while the committer commits.
template <typename Body>
void Beside(Committer& committer, Body body) {
  std::atomic<bool> is_over = false;
  std::thread thread([&] { committer.RunUntil(is_over); });
  body();
  is_over = true;
  thread.join();
}

int Run(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: dhpmap_space_bench FOLDER [MB]\n");
    return 2;
  }
  const std::string path = std::string(argv[1]) + "/space_bench.db";
  const double wanted_mb = argc > 2 ? std::atof(argv[2]) : 120;
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(path + suffix);
  auto opened = OpenSqliteStore(path);
  Must(opened.status());
  MapStore& store = **opened;
  testing::MapGenerator generator(9);
  Committer committer(store, generator);

  // Grows commit by commit among the other's, as mapping makes it.
  Map house(generator.Info("house"));
  generator.AddSubmap(house, 60);
  Must(store.CreateMap(*house.Publish(1)));
  Beside(committer, [&] {
    for (std::int64_t n = 2; Megabytes(path) < wanted_mb; ++n) {
      const auto before = house.published();
      for (int i = 0; i < 20; ++i) generator.AddSubmap(house, 60);
      Must(store.Commit(*before, *house.Publish(n), Durability::kNormal));
    }
  });
  committer.Report("while the map grows");
  const double before_mb = Megabytes(path);

  const auto begin = Clock::now();
  double delete_ms = 0;
  Beside(committer, [&] {
    Must(store.DeleteMap("house"));
    delete_ms = MillisecondsSince(begin);
  });
  committer.Report("while it is deleted");
  std::printf("deleted %.1f MB in %.0f ms, log %.1f MB\n", before_mb, delete_ms, Megabytes(path + "-wal"));
  const double log_mb = Megabytes(path + "-wal");
  Beside(committer, [&] {
    while ((Megabytes(path) > 20 || Megabytes(path + "-wal") >= log_mb) && MillisecondsSince(begin) < 100'000) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  committer.Report("while the space goes back");
  std::printf("%.1f MB, log %.1f MB, after %.0f ms\n", Megabytes(path), Megabytes(path + "-wal"),
              MillisecondsSince(begin));
  return 0;
}

}  // namespace
}  // namespace dhpmap

int main(int argc, char** argv) { return dhpmap::Run(argc, argv); }
