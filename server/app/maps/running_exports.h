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

/// What goes out.
enum class ExportKind { kMapFile, kBackup };

/// How far: the last three are ends, of which kLeft is that nobody reads on.
enum class ExportStage { kPreparing, kSending, kSent, kLeft, kFailed };

struct ExportProgress {
  std::int64_t id = 0;  ///< of this export, by which it is known while the server runs
  ExportKind kind = ExportKind::kMapFile;
  ExportStage stage = ExportStage::kPreparing;
  std::int64_t done_bytes = 0;   ///< that were read to be sent
  std::int64_t total_bytes = 0;  ///< 0 while it is prepared
  double elapsed_s = 0;          ///< since it was asked for, until its end
};

/// What there is to tell of the exports of a map.
struct ExportNews {
  /// That ended since, the newest kMaxTold, in the order of their ends; then those under way, the oldest kMaxTold, in
  /// the order of their beginnings.
  std::vector<ExportProgress> exports;
  std::size_t num_running = 0;  ///< under way, told or not
  bool has_changed = false;     ///< one has begun, is sent from now on, or has ended since
  std::uint64_t number = 0;     ///< to ask on from
};

/// The exports under way, and the ends of the last ones: what those who follow a map are told. They are numbered by
/// their news, so that who follows is a number and no queue; bytes are no news, and are there for who looks. What is
/// kept is bounded by the exports that there may be at once, and kMaxEnded. Thread-safe.
class RunningExports : public std::enable_shared_from_this<RunningExports> {
 public:
  using Clock = std::chrono::steady_clock;
  using Opened = Result<std::unique_ptr<StoreBackup>>;
  static constexpr std::size_t kMaxTold = 8, kMaxEnded = 64;

  /// Not on the stack: exports may outlive it.
  static std::shared_ptr<RunningExports> Create() { return std::shared_ptr<RunningExports>(new RunningExports()); }

  /// What open() makes, as an export of `map` (empty: of all maps) that is under way from now until it fails, or the
  /// file is read to its end or let go of.
  Opened Open(ExportKind kind, const std::string& map, const std::function<Opened()>& open) DHPMAP_EXCLUDES(mutex_);

  /// How many news there were, of all maps. Takes no lock.
  [[nodiscard]] std::uint64_t number() const { return number_.load(std::memory_order_acquire); }
  /// Of a map, and of what is of all maps, after `since`, an earlier number.
  [[nodiscard]] ExportNews Of(const std::string& map, std::uint64_t since) const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Export {
    std::string map;
    ExportProgress progress;  ///< elapsed_s only at its end
    Clock::time_point begin;
    std::uint64_t changed = 0;  ///< number of its last news
  };
  class File;

  RunningExports() = default;
  std::int64_t Begin(ExportKind kind, const std::string& map) DHPMAP_EXCLUDES(mutex_);
  void BeginSending(std::int64_t id, std::int64_t total_bytes) DHPMAP_EXCLUDES(mutex_);
  void AddBytes(std::int64_t id, std::size_t num_bytes) DHPMAP_EXCLUDES(mutex_);
  /// Without effect on what has ended. `is_kept`: for those who follow.
  void End(std::int64_t id, ExportStage stage, bool is_kept = true) DHPMAP_EXCLUDES(mutex_);
  void Note(Export& changed) DHPMAP_REQUIRES(mutex_);

  mutable Mutex mutex_;
  std::map<std::int64_t, Export> running_ DHPMAP_GUARDED_BY(mutex_);
  std::deque<Export> ended_ DHPMAP_GUARDED_BY(mutex_);
  std::int64_t next_id_ DHPMAP_GUARDED_BY(mutex_) = 1;
  std::atomic<std::uint64_t> number_ = 0;  ///< written under the mutex
};

}  // namespace dhpmap
