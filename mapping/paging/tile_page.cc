// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/paging/tile_page.h"

#include <array>
#include <atomic>
#include <chrono>
#include <string>
#include <utility>

#include "mapping/base/status_error.h"
#include "mapping/paging/page_reader.h"

namespace dhpmap {
namespace {

struct PageCounters {
  std::atomic<std::uint64_t> num_reads{0}, num_failures{0}, num_evicted{0}, num_spilled{0}, num_unspilled{0};
  std::atomic<std::int64_t> read_ns{0}, resident_bytes{0}, table_bytes{0};
};
PageCounters& Counters() {
  static constinit PageCounters counters;
  return counters;
}

/// About: the page, the BlockTile, its labels, the entry in a table and the marks, with what the allocator adds, but
/// for names that it has of its own.
constexpr std::int64_t kTileTableBytes = 832;

}  // namespace

TilePage::TableBytes::TableBytes(std::size_t name_bytes)
    : bytes_(kTileTableBytes + 2 * static_cast<std::int64_t>(name_bytes)) {  // the marks have them, too
  Counters().table_bytes.fetch_add(bytes_, std::memory_order_relaxed);
}

TilePage::TableBytes::~TableBytes() { Counters().table_bytes.fetch_sub(bytes_, std::memory_order_relaxed); }

TilePage::~TilePage() {
  Counters().resident_bytes.fetch_sub(static_cast<std::int64_t>(BlockBytes()), std::memory_order_relaxed);
}

std::shared_ptr<const TilePage> TilePage::Another() const {
  return std::make_shared<const TilePage>(tile(), source_, names());
}

std::shared_ptr<const TileLoader> TilePage::Evicted() const {
  Counters().num_evicted.fetch_add(1, std::memory_order_relaxed);
  return Another();
}

std::shared_ptr<const TileLoader> TilePage::ReadInPassing() const {
  const PageReader::Passing passing;
  auto page = Another();
  (void)page->blocks();
  return page;
}

Result<std::vector<BlockEntry>> TilePage::ReadNamed() const {
  DHPMAP_ASSIGN_OR_RETURN(std::vector<BlockEntry> blocks, source_->Read(tile()));
  std::array<std::uint64_t, kNumBlockLayers> cells{};
  for (const BlockEntry& block : blocks) {
    const int cell = CellOf(block.index);
    ForEachLayer(
        [&](BlockLayer kind, const auto& layer) {
          if (layer == nullptr) return;
          cells[static_cast<std::size_t>(kind)] |= std::uint64_t{1} << cell;
          // Nobody else has seen it yet.
          const_cast<PartId&>(layer->part_id).Restore(PartIdOf(kind, cell));
        },
        block);
  }
  if (cells == tile().cells) return blocks;
  return DataLoss("tile (" + std::to_string(tile().index.x) + ", " + std::to_string(tile().index.y) + ", " +
                  std::to_string(tile().index.z) + ") has other blocks than were stored")
      .WithReason("DAMAGED_MAP");
}

void TilePage::Load() const {
  try {
    PageReader::Admit();  // first: the page's mutex is not held meanwhile
  } catch (const StatusError&) {
    if (IsRead()) return;  // by somebody else by now
    throw;
  }
  const MutexLock lock(mutex_);
  if (IsRead()) return;  // another thread was first
  const auto begin = std::chrono::steady_clock::now();
  Result<std::vector<BlockEntry>> blocks = ReadNamed();
  const std::chrono::nanoseconds taken = std::chrono::steady_clock::now() - begin;
  Counters().read_ns.fetch_add(taken.count(), std::memory_order_relaxed);
  if (!blocks.ok()) {
    Counters().num_failures.fetch_add(1, std::memory_order_relaxed);
    throw StatusError(blocks.status());
  }
  SetBlocks(std::move(blocks).value());
  const auto num_bytes = static_cast<std::int64_t>(BlockBytes());
  PageReader::Count(num_bytes);
  Counters().num_reads.fetch_add(1, std::memory_order_relaxed);
  Counters().resident_bytes.fetch_add(num_bytes, std::memory_order_relaxed);
}

PageCounts CountPages() {
  const PageCounters& counters = Counters();
  return {.num_reads = counters.num_reads.load(std::memory_order_relaxed),
          .num_hits = TileLoader::NumHits(),
          .num_failures = counters.num_failures.load(std::memory_order_relaxed),
          .num_evicted = counters.num_evicted.load(std::memory_order_relaxed),
          .num_spilled = counters.num_spilled.load(std::memory_order_relaxed),
          .num_unspilled = counters.num_unspilled.load(std::memory_order_relaxed),
          .read_ns = counters.read_ns.load(std::memory_order_relaxed),
          .resident_bytes = counters.resident_bytes.load(std::memory_order_relaxed),
          .table_bytes = counters.table_bytes.load(std::memory_order_relaxed)};
}

void CountSpilled(bool is_written) {
  (is_written ? Counters().num_spilled : Counters().num_unspilled).fetch_add(1, std::memory_order_relaxed);
}

}  // namespace dhpmap
