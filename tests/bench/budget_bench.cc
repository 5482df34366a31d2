// SPDX-License-Identifier: BSD-3-Clause
// A data set mapped with budgets of memory for its voxels: that the map does not depend on them, and what they cost.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "clients/datasets/dataset.h"
#include "clients/datasets/open_dataset.h"
#include "clients/evaluator/experiment.h"
#include "mapping/base/memory_count.h"
#include "mapping/map/history_id.h"
#include "mapping/paging/tile_page.h"
#include "mapping/paging/tile_spill.h"
#include "server/app/maps/map_registry.h"
#include "storage/sqlite_store.h"
#include "storage/store.h"
#include "tests/bench/bench.h"
#include "tests/bench/frames.h"
#include "tests/bench/own_process.h"

namespace dhpmap::bench {
namespace {

using Clock = std::chrono::steady_clock;
constexpr char kMapName[] = "budget";

double SecondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Of all that a state has of voxels, the order of submaps, tiles and blocks left aside where the map leaves it open.
class StateSum {
 public:
  void Add(const MapSnapshot& state) {
    for (const auto& submap : state.submaps()) {
      std::uint64_t of_submap = 0;
      for (const TileEntry& entry : submap->blocks().tiles()) {
        for (const BlockEntry& block : entry.tile->entries()) of_submap += SumOf(block);
      }
      sum_ = Mix(sum_ ^ submap->id().value) + of_submap;
    }
  }
  [[nodiscard]] std::uint64_t value() const { return sum_; }

 private:
  static std::uint64_t Mix(std::uint64_t word) {
    word = (word ^ word >> 30) * 0xBF58476D1CE4E5B9u;
    word = (word ^ word >> 27) * 0x94D049BB133111EBu;
    return word ^ word >> 31;
  }
  static std::uint64_t SumOf(const BlockEntry& block) {
    std::uint64_t sum = Mix(static_cast<std::uint32_t>(block.index.x));
    sum = Mix(sum ^ static_cast<std::uint32_t>(block.index.y));
    sum = Mix(sum ^ static_cast<std::uint32_t>(block.index.z));
    for (int i = 0; i < kBlockVoxels; ++i) {
      const auto v = static_cast<std::size_t>(i);
      if (block.tsdf != nullptr && block.tsdf->IsObserved(i)) {
        sum = Mix((sum ^ std::bit_cast<std::uint32_t>(block.tsdf->distance_m[v])) + v);
        sum = Mix(sum ^ std::bit_cast<std::uint32_t>(block.tsdf->weight[v]));
        const Color color = block.tsdf->color[v];
        sum = Mix(sum ^ (std::uint64_t{color.r} << 16 | std::uint64_t{color.g} << 8 | color.b));
      }
      if (block.labels == nullptr) continue;
      const LabelHistograms seen = block.labels->Get(i);
      for (const LabelCount& c : seen.classes) sum = Mix(sum ^ (std::uint64_t{c.id} << 32 | c.count));
      for (const InstanceCount& c : seen.instances) sum = Mix(sum ^ (std::uint64_t{c.id.code()} << 32 | c.count));
      sum = Mix(sum ^ std::uint64_t{block.labels->IsConcluded(i)});
    }
    return sum;
  }
  std::uint64_t sum_ = 1;
};

template <typename Answer, typename Call>
Answer WaitFor(Call&& call) {
  std::promise<Answer> promise;
  call([&promise](const Answer& answer) { promise.set_value(answer); });
  return promise.get_future().get();
}

Result<std::string> MapWithin(const BudgetBenchOptions& options, const std::string& folder, std::int64_t budget_mib) {
  DHPMAP_ASSIGN_OR_RETURN(const auto dataset, OpenDataset(options.directory, kAnyFormat, LabelSource::kPredicted));
  MapInfo info;
  info.name = kMapName;
  DHPMAP_ASSIGN_OR_RETURN(info.config, evaluator::ConfigFor(dataset->preset(), {}));
  DHPMAP_ASSIGN_OR_RETURN(LabelSet labels, LabelSet::Create(dataset->label_classes()));
  info.label_set = std::make_shared<const LabelSet>(std::move(labels));
  const std::string path = folder + "/" + std::to_string(budget_mib) + ".db";
  DHPMAP_ASSIGN_OR_RETURN(const auto store, OpenSqliteStore(path, {.pages_tiles = budget_mib > 0}));
  OpenMapOptions session_options;
  session_options.mapping.refinement_timing = RefinementTiming::kReproducible;
  session_options.commit.max_behind_s = 1e9;
  session_options.pages.budget_bytes = budget_mib << 20;
  if (budget_mib > 0) {
    DHPMAP_ASSIGN_OR_RETURN(session_options.pages.spill, OpenTileSpill(folder));
  }
  DHPMAP_ASSIGN_OR_RETURN(const auto registry,
                          MapRegistry::Open(*store, std::move(session_options), {.idle_close_s = 0}));
  DHPMAP_RETURN_IF_ERROR(registry->Create(std::move(info)).status());
  DHPMAP_ASSIGN_OR_RETURN(const auto session, registry->GetOpen(kMapName));
  double fused_s = 0;
  std::size_t most_block_bytes = 0, num_frames = 0;
  const std::size_t wanted = options.num_frames == 0 ? dataset->num_frames() : options.num_frames;
  for (std::size_t i = 0; i < std::min(wanted, dataset->num_frames()); ++i) {
    DHPMAP_ASSIGN_OR_RETURN(const DatasetFrame read, dataset->Read(i));
    Result<PanopticFrame> frame = DecodeFrame(read, dataset->has_persistent_ids());
    if (!frame.ok()) continue;
    const auto begin = Clock::now();
    const auto outcome = WaitFor<Result<FrameReport>>([&](auto done) {
      session->Integrate(std::move(frame), [done](const FrameOutcome& fused) { done(fused.report); });
    });
    if (!outcome.ok()) return outcome.status();
    fused_s += SecondsSince(begin);
    most_block_bytes = std::max(most_block_bytes, CountOf(MemoryKind::kBlocks).now_bytes());
    ++num_frames;
  }
  const auto finish_begin = Clock::now();
  DHPMAP_RETURN_IF_ERROR(WaitFor<Status>(
      [&](auto done) { session->Finish([done](const Result<FinishOutcome>& finished) { done(finished.status()); }); }));
  const double finish_s = SecondsSince(finish_begin);
  StateSum sum;
  sum.Add(session->View()->snapshot());
  const PageCounts pages = CountPages();
  return nlohmann::json{{"budget_mib", budget_mib},
                        {"frames", num_frames},
                        {"submaps", session->View()->snapshot().submaps().size()},
                        {"ms_a_frame", 1e3 * fused_s / static_cast<double>(std::max<std::size_t>(num_frames, 1))},
                        {"finish_s", finish_s},
                        {"tiles_read", pages.num_reads},
                        {"tiles_let_go", pages.num_evicted},
                        {"most_block_bytes", most_block_bytes},
                        {"sum", sum.value()}}
      .dump();
}

void PrintTable(const nlohmann::json& runs) {
  std::printf("%10s %7s %8s %11s %9s %11s %9s %14s %9s\n", "budget MiB", "frames", "submaps", "ms a frame", "finish s",
              "tiles read", "let go", "voxels, MB", "same map");
  for (const nlohmann::json& run : runs) {
    const auto budget_mib = run["budget_mib"].get<std::int64_t>();
    std::printf("%10s %7llu %8llu %11.2f %9.2f %11llu %9llu %14.1f %9s\n",
                budget_mib == 0 ? "all" : std::to_string(budget_mib).c_str(),
                static_cast<unsigned long long>(run["frames"].get<std::uint64_t>()),
                static_cast<unsigned long long>(run["submaps"].get<std::uint64_t>()), run["ms_a_frame"].get<double>(),
                run["finish_s"].get<double>(), static_cast<unsigned long long>(run["tiles_read"].get<std::uint64_t>()),
                static_cast<unsigned long long>(run["tiles_let_go"].get<std::uint64_t>()),
                run["most_block_bytes"].get<double>() / 1e6, run["sum"] == runs.front()["sum"] ? "yes" : "NO");
  }
}

}  // namespace

Status RunBudgetBench(const BudgetBenchOptions& options) {
  const auto folder = std::filesystem::path(options.scratch) / ("budget-bench-" + std::to_string(DrawHistoryId()));
  std::filesystem::create_directories(folder);
  nlohmann::json runs = nlohmann::json::array();
  Status status;
  std::vector<std::int64_t> budgets_mib = {0};
  budgets_mib.insert(budgets_mib.end(), options.budgets_mib.begin(), options.budgets_mib.end());
  for (const std::int64_t budget_mib : budgets_mib) {
    const auto told = InOwnProcess([&] { return MapWithin(options, folder.string(), budget_mib); });
    status = told.status();
    if (!status.ok()) break;
    runs.push_back(nlohmann::json::parse(*told));
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  DHPMAP_RETURN_IF_ERROR(status);
  PrintTable(runs);
  const bool are_same =
      std::all_of(runs.begin(), runs.end(), [&](const auto& run) { return run["sum"] == runs[0]["sum"]; });
  return are_same ? Status::Ok() : Internal("the map depends on the budget");
}

}  // namespace dhpmap::bench
