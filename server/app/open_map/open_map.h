// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/pipeline/map_builder.h"
#include "mapping/pipeline/refinement_slots.h"
#include "server/app/open_map/batches.h"
#include "server/app/open_map/committer.h"
#include "server/app/open_map/frame_intake.h"
#include "server/app/open_map/map_editor.h"
#include "server/app/open_map/map_finisher.h"
#include "server/app/open_map/map_recording.h"
#include "server/app/open_map/map_writer.h"
#include "server/app/open_map/page_evictor.h"
#include "server/app/open_map/publisher.h"
#include "server/app/open_map/writer_queue.h"
#include "server/app/states/snapshot_history.h"

namespace dhpmap {

/// Options of fusion and refinement.
struct MappingOptions {
  int num_threads = 0;                         ///< of fusion; 0 = one per core
  std::shared_ptr<ThreadPool> pool = nullptr;  ///< for fusion, shared with other maps; null: num_threads of its own
  /// Shared with other maps; null: unlimited.
  std::shared_ptr<RefinementSlots> refinement_slots = nullptr;
  RefinementTiming refinement_timing = RefinementTiming::kNeverWait;
  std::function<void(const RefinementReport&)> on_refinement = {};  ///< on the writer thread; may be empty
};

/// Which past states stay readable.
struct HistoryOptions {
  std::size_t max_states = 64;                   ///< number of last stored states
  std::size_t bytes = 256u << 20;                ///< limit of their memory, over all maps
  std::shared_ptr<ByteBudget> budget = nullptr;  ///< a budget of that size, shared with other maps; null: its own
};

struct OpenMapOptions {
  MappingOptions mapping = {};
  PublishOptions publish = {};
  CommitOptions commit = {};
  PageOptions pages = {};
  FeedOptions feeds = {};
  HistoryOptions history = {};
  std::size_t max_pending_edits = 256;      ///< queued edits; more are refused with RESOURCE_EXHAUSTED
  UtcClock now_ns = {};                     ///< empty: the system's clock
  MakeRecorder make_recorder = {};          ///< may be empty: nothing is recorded
  std::function<void()> on_finishing = {};  ///< Finishing() has changed; on any thread; may be empty
};

/// One open map, composed of its parts. Jobs on the WriterQueue's thread change the map of the MapBuilder; the
/// Publisher makes it visible, the Committer stores it on another thread, and Batches schedules both. FrameIntake,
/// MapEditor, MapFinisher and PageEvictor create the jobs. Readers call View() and never wait for these.
///
/// Thread-safe. Callbacks run on the map's threads and must be quick; each runs exactly once, and its exceptions are
/// dropped. Exceptions inside are answered with RESOURCE_EXHAUSTED, reason OUT_OF_MEMORY, or INTERNAL, and the threads
/// continue. A call that throws has had no effect, and its callback never runs. Call Stop() before releasing the last
/// reference if that may happen in a callback.
class OpenMap {
 public:
  /// `snapshot` is the stored state. The store outlives this.
  OpenMap(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, OpenMapOptions options);
  /// Calls Stop().
  ~OpenMap();
  OpenMap(const OpenMap&) = delete;
  OpenMap& operator=(const OpenMap&) = delete;

  /// The visible state: see VisibleSnapshot.
  [[nodiscard]] std::shared_ptr<const MapView> View() const { return publisher_.Visible(); }

  /// The last stored states. Never null.
  [[nodiscard]] const std::shared_ptr<SnapshotHistory>& history() const { return history_; }

  /// Starts a feed of the map: see FeedSeats::Take. INVALID_ARGUMENT for a bad session name, NOT_FOUND if the map is
  /// being deleted.
  Result<std::shared_ptr<Feed>> BeginFeed(FeedRequest request = {}) { return intake_.BeginFeed(std::move(request)); }
  void EndFeed(const std::shared_ptr<Feed>& feed) { intake_.seats().Leave(feed); }
  /// Ends the stream of a feed session: see FeedSeats::End. Its queued frames are refused.
  Status EndSession(const std::string& session) { return intake_.seats().End(session); }
  /// See ListSessions.
  [[nodiscard]] std::vector<SessionStatus> Sessions() const { return intake_.Sessions(); }
  [[nodiscard]] std::size_t num_feeds() const { return intake_.seats().Feeds().size(); }

  /// Whether to keep messages until their frames are fused, or their edits made.
  [[nodiscard]] bool IsRecorded() const { return recording_.is_wanted(); }

  /// Age of the oldest unstored frame.
  [[nodiscard]] double BehindSeconds() const { return committer_.BehindSeconds(); }

  /// Fuses a frame. UNAVAILABLE, reason STORE_BEHIND, while unstored frames are older than max_behind_s. An error in
  /// place of a frame is passed to `done` in its turn, so that answers keep the order of the calls. ABORTED if the feed
  /// has been replaced by then; no effect if its session has taken this or a later sequence. The caller limits its
  /// in-flight frames and gets an answer for each.
  void Integrate(const std::shared_ptr<Feed>& feed, ArrivedFrame arrived, std::function<void(FrameOutcome)> done) {
    intake_.Integrate(feed, std::move(arrived), std::move(done));
  }
  void Integrate(const std::shared_ptr<Feed>& feed, std::int64_t sequence, Result<PanopticFrame> frame,
                 std::function<void(FrameOutcome)> done) {
    Integrate(feed, ArrivedFrame{.sequence = sequence, .frame = std::move(frame)}, std::move(done));
  }
  /// The same for a single, unnamed feed.
  void Integrate(Result<PanopticFrame> frame, std::function<void(FrameOutcome)> done) {
    Integrate(nullptr, 0, std::move(frame), std::move(done));
  }

  /// Reports the feed's progress, in turn with its frames.
  void Greet(const std::shared_ptr<Feed>& feed, std::function<void(FeedProgress)> done) {
    intake_.Greet(feed, std::move(done));
  }
  /// The same immediately.
  [[nodiscard]] FeedProgress ProgressOf(const std::shared_ptr<Feed>& feed) const { return intake_.ProgressOf(feed); }

  /// Edits the map between two frames, after publishing and committing all fused frames; on an error the map is
  /// unchanged. The new state and its log entry are committed with a full sync before they become visible. If the store
  /// fails, the edit has not happened: `done` gets the store's error, and nothing of it becomes visible or stored
  /// later. A request id in the log returns the earlier answer without effect; INVALID_ARGUMENT, reason
  /// REQUEST_ID_REUSED, if that was a different request.
  void Edit(EditRequest request, std::function<void(Result<EditOutcome>)> done) {
    editor_.Edit(std::move(request), std::move(done));
  }
  /// Runs `change` on the map in the same way, as an edit with an empty log entry.
  void Edit(std::function<Result<SubmapId>(Map&)> change, std::function<void(Result<EditOutcome>)> done,
            EditMode mode = EditMode::kMake);

  /// Publishes and commits everything submitted before, with a full sync, so that a feed's last acknowledgement
  /// survives a power cut.
  void Flush(std::function<void(const Status&)> done);

  /// MapBuilder::Finish, then a commit with a full sync. CANCELLED, without effect, after a `stop` request while it
  /// waits or refines; UNAVAILABLE if the map is closed meanwhile. `done` is called once, by the writer, the commit
  /// worker, or the thread that requests the stop.
  void Finish(std::function<void(Result<FinishOutcome>)> done, std::stop_token stop = {}) {
    finisher_.Finish(std::move(done), std::move(stop));
  }

  /// Of the oldest running Finish; nothing if there is none.
  [[nodiscard]] std::optional<FinishProgress> Finishing() const { return finisher_.Progress(); }

  /// Removes the map from the store and refuses all further work with NOT_FOUND. FAILED_PRECONDITION while the map is
  /// fed; idle feeds are ended. Blocks during the deletion.
  Status DeleteFromStore();

  /// Whether a view of the map, of any state, is in use elsewhere.
  [[nodiscard]] bool IsViewed() const;

  /// Asks the writer to evict pages soon if the memory of read ones exceeds its limit. Pinned states keep their pages.
  /// Otherwise free.
  void KeepPagesInBounds() { evictor_.EvictSoon(); }

  /// Nothing is in flight and everything is stored: Stop() would lose or refuse nothing, provided that no one else
  /// holds a reference.
  [[nodiscard]] bool IsAtRest() const;

  /// Refuses the running frame and queued ones with UNAVAILABLE, without changing the map; cancels a refinement. All
  /// else continues.
  void GiveUpMapping() { give_up_.request_stop(); }
  [[nodiscard]] bool HasGivenUpMapping() const { return give_up_.stop_requested(); }

  /// Stops because another process writes the map now, or soon. Feeds end with `why`, and jobs are refused with it.
  Status MoveAway(const Status& why) DHPMAP_EXCLUDES(stop_mutex_);
  /// Not OK: another process has taken or deleted the map; this process stores nothing more of it.
  [[nodiscard]] Status loss() const { return committer_.loss(); }

  /// Ends the running job (cancelling a frame or a refinement), refuses queued and later ones with UNAVAILABLE, commits
  /// with a full sync, and joins the threads. Returns the outcome of that commit.
  Status Stop() DHPMAP_EXCLUDES(stop_mutex_);

 private:
  OpenMap(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, const OpenMapOptions& options, UtcClock now_ns);
  [[nodiscard]] WriterChores Chores();
  void OnStored(const std::shared_ptr<const MapSnapshot>& state);

  // Each part uses only those above it, except in callbacks from the two threads, which start with the first job.
  std::stop_source give_up_;
  const std::shared_ptr<SnapshotHistory> history_;
  Committer committer_;
  MapBuilder builder_;  ///< writer thread only
  Publisher publisher_;
  Batches batches_;  ///< writer thread only
  MapRecording recording_;
  WriterQueue queue_;
  const MapWriter writer_;  ///< all these
  FrameIntake intake_;
  MapEditor editor_;
  MapFinisher finisher_;
  PageEvictor evictor_;

  Mutex stop_mutex_;    ///< held while threads end, so that concurrent callers of Stop wait
  Status end_outcome_;  ///< not OK: the last state could not even be passed to the store. Writer thread, then Stop
};

}  // namespace dhpmap
