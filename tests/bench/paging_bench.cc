// SPDX-License-Identifier: BSD-3-Clause
// Queries of a map larger than its budget of memory, as a server makes them, against the same of the map read whole.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "mapping/map/history_id.h"
#include "mapping/paging/tile_page.h"
#include "mapping/paging/tile_spill.h"
#include "server/app/maps/map_registry.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "tests/bench/bench.h"
#include "tests/bench/large_map.h"
#include "tests/bench/own_process.h"

namespace dhpmap::bench {
namespace {

using PagingClock = std::chrono::steady_clock;

constexpr double kMemoryBeside_mb = 100;  ///< that a process may have beside its budget
constexpr int kNumRandomPoints = 20'000, kPointsAView = 100;
constexpr int kWalkedRooms = 100, kStepsARoom = 32, kPointsAStep = 200;
constexpr double kSight_m = 2;  ///< of points around the one who walks
constexpr std::size_t kTilesAView = 64;

double PagingSecondsSince(PagingClock::time_point begin) {
  return std::chrono::duration<double>(PagingClock::now() - begin).count();
}

/// A checksum of what was read, in the order in which it was.
class ReadSum {
 public:
  void Add(std::uint64_t word) {
    sum_ = (std::rotl(sum_, 23) ^ word) * 0x9E3779B97F4A7C15u;
    sum_ ^= sum_ >> 29;
  }
  void Add(float value) { Add(std::uint64_t{std::bit_cast<std::uint32_t>(value)}); }
  void Add(Color color) { Add(std::uint64_t{color.r} << 16 | std::uint64_t{color.g} << 8 | color.b); }
  void Add(const PointInfo& point) {
    Add(std::uint64_t{point.is_observed} << 1 | std::uint64_t{point.is_free});
    if (!point.is_observed) return;
    Add(std::uint64_t{point.submap.value} << 32 | point.class_id.value);
    for (const float value : {point.distance_m, point.weight, point.class_confidence, point.instance_confidence})
      Add(value);
    Add(point.color);
  }
  void Add(const BlockEntry& block) {
    for (const std::int32_t axis : {block.index.x, block.index.y, block.index.z})
      Add(std::uint64_t{static_cast<std::uint32_t>(axis)});
    for (int linear = 0; linear < kBlockVoxels; ++linear) {
      const auto i = static_cast<std::size_t>(linear);
      if (block.tsdf != nullptr && block.tsdf->IsObserved(linear)) {
        Add(std::uint64_t{std::bit_cast<std::uint32_t>(block.tsdf->distance_m[i])} << 32 |
            std::bit_cast<std::uint32_t>(block.tsdf->weight[i]));
        Add(block.tsdf->color[i]);
      }
      if (block.labels == nullptr) continue;
      const BestLabel best = block.labels->BestClass(linear);
      if (best.count > 0) Add(std::uint64_t{best.id} << 32 | best.count);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 1;
};

/// Asks as clients do: for a state of the map, then some of it, then for the state anew. What is held is not let go of.
class LargeMapReader {
 public:
  LargeMapReader(MapRegistry& registry, int num_rooms) : registry_(registry), num_rooms_(num_rooms) {}

  Status Ask(ReadSum& sum) {
    DHPMAP_RETURN_IF_ERROR(Renew());
    sum.Add(view_->lookup().At(RoomOrigin_m(0) + Eigen::Vector3d(kRoomSide_m / 2, kRoomSide_m / 2, kFloorHeight_m)));
    return Status::Ok();
  }
  Status AskAtRandom(ReadSum& sum) {
    std::mt19937_64 random(1);
    for (int n = 0; n < kNumRandomPoints; ++n) {
      if (n % kPointsAView == 0) DHPMAP_RETURN_IF_ERROR(Renew());
      const int room = static_cast<int>(random() % static_cast<std::uint64_t>(num_rooms_));
      const Eigen::Vector3d size_m(kRoomSide_m, kRoomSide_m, kRoomHeight_m);
      sum.Add(view_->lookup().At(RoomOrigin_m(room) + size_m.cwiseProduct(Cube(random))));
    }
    return Status::Ok();
  }
  Status Walk(ReadSum& sum) {
    std::mt19937_64 random(2);
    const Eigen::Vector3d middle_m(kRoomSide_m / 2, kRoomSide_m / 2, kRoomHeight_m / 2);
    for (int room = 0; room + 1 < std::min(num_rooms_, kWalkedRooms); ++room) {
      const Eigen::Vector3d from_m = RoomOrigin_m(room) + middle_m, to_m = RoomOrigin_m(room + 1) + middle_m;
      for (int step = 0; step < kStepsARoom; ++step) {
        DHPMAP_RETURN_IF_ERROR(Renew());
        const Eigen::Vector3d at_m = from_m + (to_m - from_m) * step / kStepsARoom;
        for (int n = 0; n < kPointsAStep; ++n) {
          const Eigen::Vector3d around_m = 2 * kSight_m * (Cube(random) - Eigen::Vector3d::Constant(0.5));
          sum.Add(view_->lookup().At(at_m + around_m));
        }
      }
    }
    return Status::Ok();
  }
  Status Scan(ReadSum& sum) {
    DHPMAP_RETURN_IF_ERROR(Renew());
    for (std::size_t s = 0; s < view_->snapshot().submaps().size(); ++s) {
      for (std::size_t begin = 0; begin < TilesOf(s).size(); begin += kTilesAView) {
        const std::size_t end = std::min(begin + kTilesAView, TilesOf(s).size());
        for (std::size_t t = begin; t < end; ++t) {
          for (const BlockEntry& block : TilesOf(s)[t].tile->entries()) sum.Add(block);
        }
        DHPMAP_RETURN_IF_ERROR(Renew());
      }
    }
    return Status::Ok();
  }

 private:
  /// The newest state of the map, which is the same, but for what was let go of meanwhile.
  Status Renew() {
    view_.reset();
    DHPMAP_ASSIGN_OR_RETURN(view_, registry_.ViewOf(kLargeMapName));
    return Status::Ok();
  }
  [[nodiscard]] std::span<const TileEntry> TilesOf(std::size_t submap) const {
    return view_->snapshot().submaps()[submap]->blocks().tiles();
  }
  /// A point of the unit cube; the same everywhere, as distributions of the standard library need not be.
  static Eigen::Vector3d Cube(std::mt19937_64& random) {
    Eigen::Vector3d point;
    for (double& axis : point) axis = static_cast<double>(random() >> 11) * 0x1p-53;
    return point;
  }

  MapRegistry& registry_;
  const int num_rooms_;
  std::shared_ptr<const MapView> view_;
};

/// What is asked of the map, in this order.
struct PagingPhase {
  const char* name;
  Status (LargeMapReader::*ask)(ReadSum&);
};
constexpr PagingPhase kPhases[] = {{"first", &LargeMapReader::Ask},
                                   {"random", &LargeMapReader::AskAtRandom},
                                   {"walk", &LargeMapReader::Walk},
                                   {"scan", &LargeMapReader::Scan}};

/// Of one budget. The process has nothing else in memory.
Result<std::string> MeasureBudget(const std::string& path, std::int64_t budget_mib, int num_rooms) {
  const AnonymousPeak peak;
  const auto begin = PagingClock::now();
  DHPMAP_ASSIGN_OR_RETURN(const auto store, OpenSqliteStore(path, {.pages_tiles = budget_mib > 0}));
  OpenMapOptions options;
  options.mapping.num_threads = 1;
  options.pages.budget_bytes = budget_mib << 20;
  if (budget_mib > 0) {
    DHPMAP_ASSIGN_OR_RETURN(options.pages.spill, OpenTileSpill(std::filesystem::path(path).parent_path().string()));
  }
  DHPMAP_ASSIGN_OR_RETURN(const auto registry, MapRegistry::Open(*store, std::move(options), {.idle_close_s = 0}));
  nlohmann::json told = {{"budget_mib", budget_mib}, {"open_s", PagingSecondsSince(begin)}};
  LargeMapReader reader(*registry, num_rooms);
  for (const PagingPhase& phase : kPhases) {
    ReadSum sum;
    const auto phase_begin = PagingClock::now();
    DHPMAP_RETURN_IF_ERROR((reader.*phase.ask)(sum));
    told["seconds"][phase.name] = PagingSecondsSince(phase_begin);
    told["checksums"][phase.name] = sum.value();
  }
  const PageCounts pages = CountPages();
  told["tiles_read"] = pages.num_reads;
  told["tiles_let_go"] = pages.num_evicted;
  told["anonymous_peak_bytes"] = std::max(peak.bytes(), AnonymousBytes());
  return told.dump();
}

Result<std::string> MakeAndTell(const std::string& path, double disk_mib) {
  const auto begin = PagingClock::now();
  DHPMAP_ASSIGN_OR_RETURN(const LargeMap made, MakeLargeMap(path, disk_mib));
  return nlohmann::json{{"rooms", made.num_rooms},
                        {"submaps", made.num_submaps},
                        {"tsdf_blocks", made.num_tsdf_blocks},
                        {"label_blocks", made.num_label_blocks},
                        {"blob_bytes", made.blob_bytes},
                        {"seconds", PagingSecondsSince(begin)}}
      .dump();
}

/// What the map takes when it is read as a whole, about.
double BytesInMemory(const nlohmann::json& map) {
  constexpr double kBeside = 1.15;            // tables, the allocator's own
  constexpr double kLabelPlane_bytes = 1792;  // three blocks in four have seen one class, see LabelBlock
  return kBeside * (map["tsdf_blocks"].get<double>() * sizeof(TsdfBlock) +
                    map["label_blocks"].get<double>() * sizeof(LabelBlock) +
                    map["label_blocks"].get<double>() * kLabelPlane_bytes);
}

/// The largest first, with which the others are compared: 0, for all of the map, where that fits into memory. Without
/// those that this machine does not have. Tells what is left out.
std::vector<std::int64_t> MeasurableBudgets(const PagingBenchOptions& options, double map_bytes) {
  const double available_bytes = 0.9 * static_cast<double>(AvailableBytes());
  std::vector<std::int64_t> budgets_mib = options.budgets_mib;
  std::sort(budgets_mib.rbegin(), budgets_mib.rend());
  if (map_bytes < available_bytes) {
    budgets_mib.insert(budgets_mib.begin(), 0);
    return budgets_mib;
  }
  std::fprintf(stderr, "not compared with the map that is all in memory: it takes %.1f GB, and there are %.1f\n",
               map_bytes / 1e9, available_bytes / 1e9);
  const auto is_too_large = [&](std::int64_t budget_mib) {
    const double budget_bytes = static_cast<double>(budget_mib << 20) + kMemoryBeside_mb * 1e6;
    if (budget_bytes < available_bytes) return false;
    std::fprintf(stderr, "left out, as it is more than there is: %lld MiB\n", static_cast<long long>(budget_mib));
    return true;
  };
  std::erase_if(budgets_mib, is_too_large);
  return budgets_mib;
}

/// Adds to each run whether it kept to its budget and whether it answered as the first, which had most.
void Judge(nlohmann::json& runs) {
  for (nlohmann::json& run : runs) {
    const auto budget_bytes = static_cast<double>(run["budget_mib"].get<std::int64_t>() << 20);
    if (budget_bytes > 0) {
      run["is_within_budget"] = run["anonymous_peak_bytes"].get<double>() <= budget_bytes + kMemoryBeside_mb * 1e6;
    }
    run["has_same_answers"] = run["checksums"] == runs.front()["checksums"];
  }
}

const char* Verdict(const nlohmann::json& run, const char* key) {
  return !run.contains(key) ? "-" : run[key].get<bool>() ? "pass" : "FAIL";
}

void PrintPagingTable(const nlohmann::json& map, const nlohmann::json& runs) {
  const double num_blocks = std::max(map["tsdf_blocks"].get<double>(), 1.0), bytes = map["blob_bytes"].get<double>();
  std::printf(
      "%d rooms, %lld submaps, %.0f blocks, %.1f MB of blobs (%.2f bytes an allocated voxel), about %.1f GB in memory; "
      "made in %.0f s\n",
      map["rooms"].get<int>(), static_cast<long long>(map["submaps"].get<std::int64_t>()), num_blocks, bytes / 1e6,
      bytes / (num_blocks * kBlockVoxels), BytesInMemory(map) / 1e9, map["seconds"].get<double>());
  std::printf("%10s %9s %9s %9s %9s %9s %10s %10s %9s %7s %8s\n", "budget MiB", "open ms", "first ms", "random s",
              "walk s", "scan s", "tiles read", "let go", "peak MB", "memory", "answers");
  for (const nlohmann::json& run : runs) {
    const nlohmann::json& seconds = run["seconds"];
    const auto budget_mib = run["budget_mib"].get<std::int64_t>();
    const double open_s = run["open_s"].get<double>();
    std::printf("%10s %9.1f %9.1f %9.2f %9.2f %9.2f %10llu %10llu %9.1f %7s %8s\n",
                budget_mib == 0 ? "all" : std::to_string(budget_mib).c_str(), 1e3 * open_s,
                1e3 * (open_s + seconds["first"].get<double>()), seconds["random"].get<double>(),
                seconds["walk"].get<double>(), seconds["scan"].get<double>(),
                static_cast<unsigned long long>(run["tiles_read"].get<std::uint64_t>()),
                static_cast<unsigned long long>(run["tiles_let_go"].get<std::uint64_t>()),
                run["anonymous_peak_bytes"].get<double>() / 1e6, Verdict(run, "is_within_budget"),
                Verdict(run, "has_same_answers"));
  }
}

/// A folder that goes with its end.
struct PagingFolder {
  explicit PagingFolder(const std::string& parent)
      : path(std::filesystem::path(parent) / ("paging-bench-" + std::to_string(DrawHistoryId()))) {
    std::filesystem::create_directories(path);
  }
  ~PagingFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  PagingFolder(const PagingFolder&) = delete;
  PagingFolder& operator=(const PagingFolder&) = delete;
  std::filesystem::path path;
};

}  // namespace

Status RunPagingBench(const PagingBenchOptions& options) {
  const PagingFolder folder(options.scratch);
  const std::string path = (folder.path / "maps.db").string();
  DHPMAP_ASSIGN_OR_RETURN(const std::string made, InOwnProcess([&] { return MakeAndTell(path, options.disk_mib); }));
  const nlohmann::json map = nlohmann::json::parse(made);
  const std::vector<std::int64_t> budgets_mib = MeasurableBudgets(options, BytesInMemory(map));
  if (budgets_mib.empty()) return ResourceExhausted("this machine has less memory than the smallest budget");
  nlohmann::json runs = nlohmann::json::array();
  for (const std::int64_t budget_mib : budgets_mib) {
    DHPMAP_ASSIGN_OR_RETURN(const std::string told,
                            InOwnProcess([&] { return MeasureBudget(path, budget_mib, map["rooms"].get<int>()); }));
    runs.push_back(nlohmann::json::parse(told));
  }
  Judge(runs);
  if (options.json) {
    std::printf(
        "%s\n",
        nlohmann::json{{"map", map}, {"is_compared_with_all_in_memory", budgets_mib.front() == 0}, {"runs", runs}}
            .dump(2)
            .c_str());
  } else {
    PrintPagingTable(map, runs);
  }
  const bool are_same =
      std::all_of(runs.begin(), runs.end(), [](const auto& run) { return run["has_same_answers"] == true; });
  return are_same ? Status::Ok() : Internal("answers depend on the budget");
}

}  // namespace dhpmap::bench
