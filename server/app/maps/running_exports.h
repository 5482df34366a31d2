// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/store.h"

namespace dhpmap {

/// Kind of an export.
enum class ExportKind { kMapFile, kBackup };

/// The last three are final; kLeft: the client stopped reading.
enum class ExportStage { kPreparing, kSending, kSent, kLeft, kFailed };

struct ExportProgress {
  std::int64_t id = 0;  ///< unique while the server runs
  ExportKind kind = ExportKind::kMapFile;
  ExportStage stage = ExportStage::kPreparing;
  std::int64_t done_bytes = 0;   ///< read for sending
  std::int64_t total_bytes = 0;  ///< 0 while it is being prepared
  double elapsed_s = 0;          ///< from the request to its end
};

/// Changes of a map's exports.
struct ExportNews {
  /// The newest kMaxTold that have ended since, in order of their ends; then the oldest kMaxTold running ones, in order
  /// of their starts.
  std::vector<ExportProgress> exports;
  std::size_t num_running = 0;  ///< all running ones
  bool has_changed = false;     ///< one has started, begun sending, or ended since
  std::uint64_t number = 0;     ///< for the next call
};

/// Running exports and the ends of recent ones, for watchers. Changes are numbered, so a watcher is a number, not a
/// queue. Byte counts are not changes, but watchers can poll them. Bounded by the number of concurrent exports and
/// kMaxEnded. Thread-safe.
class RunningExports : public std::enable_shared_from_this<RunningExports> {
 public:
  using Clock = std::chrono::steady_clock;
  using Opened = Result<std::unique_ptr<StoreBackup>>;
  static constexpr std::size_t kMaxTold = 8, kMaxEnded = 64;

  /// Heap only: exports may outlive it.
  static std::shared_ptr<RunningExports> Create() { return std::shared_ptr<RunningExports>(new RunningExports()); }

  /// The file from open(), as a running export of `map` (empty: of all maps) until it fails, is read to its end, or is
  /// released.
  Opened Open(ExportKind kind, const std::string& map, const std::function<Opened()>& open) DHPMAP_EXCLUDES(mutex_);

  /// Number of changes so far, over all maps. Takes no lock.
  [[nodiscard]] std::uint64_t number() const { return number_.load(std::memory_order_acquire); }
  /// Changes for a map, and for exports of all maps, after the earlier number `since`.
  [[nodiscard]] ExportNews Of(const std::string& map, std::uint64_t since) const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Export {
    std::string map;
    ExportProgress progress;  ///< elapsed_s only at its end
    Clock::time_point begin;
    std::uint64_t changed = 0;  ///< number of its last change
  };
  class File;

  RunningExports() = default;
  std::int64_t Begin(ExportKind kind, const std::string& map) DHPMAP_EXCLUDES(mutex_);
  void BeginSending(std::int64_t id, std::int64_t total_bytes) DHPMAP_EXCLUDES(mutex_);
  void AddBytes(std::int64_t id, std::size_t num_bytes) DHPMAP_EXCLUDES(mutex_);
  /// No effect on an ended export. `is_kept`: for watchers.
  void End(std::int64_t id, ExportStage stage, bool is_kept = true) DHPMAP_EXCLUDES(mutex_);
  void Note(Export& changed) DHPMAP_REQUIRES(mutex_);

  mutable Mutex mutex_;
  std::map<std::int64_t, Export> running_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<Export> ended_ DHPMAP_GUARDED_BY(mutex_);
  std::int64_t next_id_ DHPMAP_GUARDED_BY(mutex_) = 1;
  std::atomic<std::uint64_t> number_ = 0;  ///< written under the mutex
};

}  // namespace dhpmap
