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

/// The streams of those who watch maps: a shutdown ends them, and one thread for all, while there are some, sees to it
/// that each says something from time to time. Thread-safe.
class WatchStreams {
 public:
  ~WatchStreams() { beat_.Join(); }

  /// Ends every stream with UNAVAILABLE once what it writes is written, and those that come later.
  void StopAll() DHPMAP_EXCLUDES(mutex_);

 private:
  friend class WatchStream;
  static constexpr std::chrono::milliseconds kBeat{250};

  /// UNAVAILABLE if it is too late; RESOURCE_EXHAUSTED if the system has no thread.
  Status Add(WatchStream* stream) DHPMAP_EXCLUDES(mutex_);
  void Remove(WatchStream* stream) DHPMAP_EXCLUDES(mutex_);
  void BeatLoop() DHPMAP_EXCLUDES(mutex_);

  Mutex mutex_;
  CondVar wake_;
  std::set<WatchStream*> streams_ DHPMAP_GUARDED_BY(mutex_);
  bool is_stopped_ DHPMAP_GUARDED_BY(mutex_) = false;
  LazyThread beat_;  // started and retired under the mutex, joined at the end
};

/// One client that watches a map: a position in what the store keeps. It has no thread while there is nothing to tell,
/// and of what it tells it holds one message. Deletes itself when the call is over.
class WatchStream final : public grpc::ServerWriteReactor<v1::WatchMapResponse> {
 public:
  static WatchStream* Start(const ServiceContext& context, WatchStreams& streams, const v1::WatchMapRequest& request);

  /// Ends it with `reason` once what it writes is written.
  void Stop(const Status& reason) DHPMAP_EXCLUDES(mutex_);
  /// From time to time: whether something has to be said.
  void OnBeat(std::chrono::steady_clock::time_point now) DHPMAP_EXCLUDES(mutex_);

  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  using Clock = std::chrono::steady_clock;
  /// While FinishMapping or an export is under way.
  static constexpr Clock::duration kWorkProgressAfter = std::chrono::seconds(1);
  /// News of exports are told no more often.
  static constexpr Clock::duration kExportsApart = std::chrono::milliseconds(200);

  WatchStream(const ServiceContext& context, WatchStreams& streams, const v1::WatchMapRequest& request)
      : context_(context),
        streams_(streams),
        request_(request),
        record_(context, "WatchService/WatchMap"),
        share_(&BudgetHere(*context.options.inflight)) {}

  /// There may be something to read: takes the turn, unless somebody has it, who then looks once more.
  void Wake() DHPMAP_EXCLUDES(mutex_);
  void TakeTurn() DHPMAP_REQUIRES(mutex_);

  // By whoever has the turn, on the lane.
  void Begin();
  Status Prepare();
  void Step();
  /// Fills the next message; false: there is none now.
  Result<bool> FillNext();
  bool FillChange();
  bool FillProgress();
  ExportNews AskExports() DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] bool IsTimeToSay(Clock::time_point now) const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] Clock::duration WorkProgressAfter() const { return std::min(progress_after_, kWorkProgressAfter); }
  Result<bool> ReadPage();
  bool TakeShare();
  void Write();
  /// Gives the turn back; false if there are news.
  bool GiveTurnBack() DHPMAP_EXCLUDES(mutex_);
  void End(const Status& status) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] Status WhyStop() const DHPMAP_EXCLUDES(mutex_);

  const ServiceContext& context_;
  WatchStreams& streams_;
  const v1::WatchMapRequest& request_;  ///< gRPC keeps it until OnDone
  CallRecord record_;
  ByteShare share_;  ///< of the message under way, and of the page while that stands
  std::unique_ptr<ChangeFeed::Follower> follower_;

  // Of whoever has the turn.
  MapInfo map_;  ///< name, history and label set alone
  ChangeFilter filter_;
  Clock::duration progress_after_{};
  WatchPosition position_;  ///< everything up to it is told
  ChangeList page_;
  std::size_t next_in_page_ = 0;
  ChangeMessages messages_;  ///< of the change that is being told
  std::int64_t change_end_ = 0;
  std::size_t told_bytes_ = 0;             ///< of it, in memory
  std::optional<FinishStage> told_stage_;  ///< of FinishMapping, in the last message; nothing: it is not under way
  bool has_told_exports_ = false;          ///< that are under way, in the last message of progress
  Clock::time_point exports_told_{};       ///< when that was
  std::int64_t last_said_ = -1;            ///< revision of the position in the last message
  v1::WatchMapResponse response_;

  mutable Mutex mutex_;
  bool has_turn_ DHPMAP_GUARDED_BY(mutex_) = true;  ///< somebody: the lane, or gRPC while it writes
  bool has_news_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_over_ DHPMAP_GUARDED_BY(mutex_) = false;
  Status stop_ DHPMAP_GUARDED_BY(mutex_);  ///< not OK: to end with this
  Clock::time_point say_by_ DHPMAP_GUARDED_BY(mutex_) = Clock::time_point::max();
  std::uint64_t exports_asked_ DHPMAP_GUARDED_BY(mutex_) = 0;  ///< number of the news of exports that were looked at
};

}  // namespace dhpmap
