// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/server_callback.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "dhpmap/v1/watch_service.pb.h"
#include "mapping/base/mutex.h"
#include "server/app/maps/running_exports.h"
#include "server/app/open_map/lazy_thread.h"
#include "server/app/open_map/open_map.h"
#include "server/app/watch/change_feed.h"
#include "server/app/watch/watch_position.h"
#include "server/base/byte_budget.h"
#include "server/grpc/call_runner.h"
#include "server/wire/watch_conversion.h"

namespace dhpmap {

class WatchStream;

/// The streams that watch maps. A shutdown ends them. While there are any, one thread makes each send a sign of life
/// from time to time. Thread-safe.
class WatchStreams {
 public:
  ~WatchStreams() { beat_.Join(); }

  /// Ends every stream with UNAVAILABLE after its current write, and every later one.
  void StopAll() DHPMAP_EXCLUDES(mutex_);

 private:
  friend class WatchStream;
  static constexpr std::chrono::milliseconds kBeat{250};

  /// UNAVAILABLE after StopAll; RESOURCE_EXHAUSTED if the system has no thread.
  Status Add(WatchStream* stream) DHPMAP_EXCLUDES(mutex_);
  void Remove(WatchStream* stream) DHPMAP_EXCLUDES(mutex_);
  void BeatLoop() DHPMAP_EXCLUDES(mutex_);

  Mutex mutex_;
  CondVar wake_;
  std::set<WatchStream*> streams_ DHPMAP_GUARDED_BY(mutex_);
  bool is_stopped_ DHPMAP_GUARDED_BY(mutex_) = false;
  LazyThread beat_;  // started and retired under the mutex, joined at the end
};

/// A client that watches a map: a position in the store's history. It uses no thread while nothing changes, and holds
/// one message at a time. Deletes itself when the call is over.
class WatchStream final : public grpc::ServerWriteReactor<v1::WatchMapResponse> {
 public:
  static WatchStream* Start(const ServiceContext& context, WatchStreams& streams, const v1::WatchMapRequest& request);

  /// Ends it with `reason` after its current write.
  void Stop(const Status& reason) DHPMAP_EXCLUDES(mutex_);
  /// Called from time to time: sends a message if one is due.
  void OnBeat(std::chrono::steady_clock::time_point now) DHPMAP_EXCLUDES(mutex_);

  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  using Clock = std::chrono::steady_clock;
  /// How often progress of FinishMapping or of an export is sent.
  static constexpr Clock::duration kWorkProgressAfter = std::chrono::seconds(1);
  /// Least time between two messages about exports.
  static constexpr Clock::duration kExportsApart = std::chrono::milliseconds(200);

  WatchStream(const ServiceContext& context, WatchStreams& streams, const v1::WatchMapRequest& request)
      : context_(context),
        streams_(streams),
        request_(request),
        record_(context, "WatchService/WatchMap"),
        share_(&BudgetHere(*context.options.inflight)) {}

  /// There may be news: takes the turn, or leaves a note for the thread that holds it.
  void Wake() DHPMAP_EXCLUDES(mutex_);
  void TakeTurn() DHPMAP_REQUIRES(mutex_);

  // These run on the lane, in the thread that holds the turn.
  void Begin();
  Status Prepare();
  void Step();
  /// Fills the next message; false: there are none now.
  Result<bool> FillNext();
  bool FillChange();
  bool FillProgress();
  ExportNews AskExports() DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] bool IsTimeToSay(Clock::time_point now) const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] Clock::duration WorkProgressAfter() const { return std::min(progress_after_, kWorkProgressAfter); }
  Result<bool> ReadPage();
  bool TakeShare();
  void Write();
  /// Gives the turn back; false if there is news.
  bool GiveTurnBack() DHPMAP_EXCLUDES(mutex_);
  void End(const Status& status) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] Status WhyStop() const DHPMAP_EXCLUDES(mutex_);

  const ServiceContext& context_;
  WatchStreams& streams_;
  const v1::WatchMapRequest& request_;  ///< gRPC keeps it until OnDone
  CallRecord record_;
  ByteShare share_;  ///< of the present message, and of the page while it is kept
  std::unique_ptr<ChangeFeed::Follower> follower_;

  // Used by the thread that holds the turn.
  MapInfo map_;  ///< name, history and label set only
  ChangeFilter filter_;
  Clock::duration progress_after_{};
  WatchPosition position_;  ///< all changes up to here are sent
  ChangeList page_;
  std::size_t next_in_page_ = 0;
  ChangeMessages messages_;  ///< of the change that is being sent
  std::int64_t change_end_ = 0;
  std::size_t told_bytes_ = 0;             ///< of that change, in memory
  std::optional<FinishStage> told_stage_;  ///< of FinishMapping, in the last message; empty: it is not running
  bool has_told_exports_ = false;          ///< the last progress message named a running export
  Clock::time_point exports_told_{};       ///< when exports were last reported
  std::int64_t last_said_ = -1;            ///< revision in the last message
  v1::WatchMapResponse response_;

  mutable Mutex mutex_;
  bool has_turn_ DHPMAP_GUARDED_BY(mutex_) = true;  ///< the lane has it, or gRPC while it writes
  bool has_news_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_over_ DHPMAP_GUARDED_BY(mutex_) = false;
  Status stop_ DHPMAP_GUARDED_BY(mutex_);  ///< not OK: the status to end with
  Clock::time_point say_by_ DHPMAP_GUARDED_BY(mutex_) = Clock::time_point::max();
  std::uint64_t exports_asked_ DHPMAP_GUARDED_BY(mutex_) = 0;  ///< number of the last export news that was read
};

}  // namespace dhpmap
