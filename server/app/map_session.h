// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "mapping/pipeline/map_builder.h"
#include "server/app/commit_worker.h"
#include "server/app/map_view.h"

namespace dhpmap {

struct SessionOptions {
  int num_threads = 0;  ///< of fusion; 0 = one a core
  // Fused frames become visible to queries after so many of them, or so long after the first of them.
  int publish_frames = 10;
  double publish_s = 0.2;
  // They go to the store after so many, or so long after the first.
  int commit_frames = 50;
  double commit_s = 2.0;
  double commit_retry_s = 5.0;           ///< between attempts while the store refuses
  std::size_t max_pending_edits = 256;   ///< waiting for the writer; more are answered RESOURCE_EXHAUSTED
  std::function<std::int64_t()> now_ns;  ///< UTC; empty = the system's clock
  std::function<void(double seconds, const Status& status)> on_commit;  ///< on the commit thread; may be empty
  std::function<void(const RefinementReport&)> on_refinement;           ///< on the writer thread; may be empty
};

/// What became of a frame.
struct FrameOutcome {
  Result<FrameReport> report;  ///< or why the frame was refused: then it changed nothing
  std::int64_t revision = 0;   ///< last published
  bool is_committed = false;   ///< everything up to this frame is in the store
  Status commit_status;        ///< why the store is behind, if the last commit failed
};

/// A state that holds an edit, and the submap that was edited (or made).
struct EditOutcome {
  std::shared_ptr<const MapView> view;
  SubmapId submap;
};

/// The finished state, and what refining it did.
struct FinishOutcome {
  std::shared_ptr<const MapView> view;
  RefinementReport refinement;
};

/// One open map: its writer thread owns the MapBuilder and works through frames and edits in the order they came; its
/// CommitWorker brings what the writer publishes into the store. Readers take View() and never wait for either.
/// Thread-safe. Callbacks run on the session's threads and must be quick; each runs exactly once. Whoever lets go of
/// the last reference must have called Stop() if that may happen in a callback.
class MapSession {
 public:
  /// `snapshot` is the state the store holds. The store outlives the session.
  MapSession(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, SessionOptions options);
  /// Stop().
  ~MapSession();
  MapSession(const MapSession&) = delete;
  MapSession& operator=(const MapSession&) = delete;

  /// The last published state.
  [[nodiscard]] std::shared_ptr<const MapView> View() const;

  /// Reserves the map for one feeder of frames; ABORTED if there is one already, NOT_FOUND if the map is being deleted.
  Status BeginFeed();
  void EndFeed();

  /// Fuses a frame. An error in its place is passed on to `done` in its turn, so that answers keep the order of the
  /// calls. The feeder limits how many are under way.
  void Integrate(Result<PanopticFrame> frame, std::function<void(FrameOutcome)> done);

  /// Runs `change` on the map between two frames, after publishing what was fused so far; an error from it must have
  /// left the map as it was. `done` hears of success once the change is in the store with a full sync. If the store
  /// fails, the change stays in memory and goes with the next commit that succeeds.
  void Edit(std::function<Result<SubmapId>(Map&)> change, std::function<void(Result<EditOutcome>)> done);

  /// Publishes and commits everything that was handed in before.
  void Flush(std::function<void(const Status&)> done);

  /// MapBuilder::Finish, then a commit with a full sync.
  void Finish(std::function<void(Result<FinishOutcome>)> done);

  /// Removes the map from the store and refuses all further work with NOT_FOUND. FAILED_PRECONDITION while somebody
  /// feeds frames. Blocks for the time of the deletion.
  Status DeleteFromStore();

  /// Ends the job in hand, refuses those that wait and all later ones with UNAVAILABLE, commits with a full sync, and
  /// joins the threads. Returns the outcome of that commit.
  Status Stop();

 private:
  struct Job {
    std::function<void()> run;
    std::function<void(const Status&)> refuse;
    bool is_edit = false;
  };
  using TimePoint = std::chrono::steady_clock::time_point;

  void Post(Job job);
  void WriterLoop();
  void RunOne(std::unique_lock<std::mutex>& lock);
  void DoBatchesThatAreDue();
  FrameOutcome IntegrateNow(Result<PanopticFrame> frame);
  std::shared_ptr<const MapView> Publish();
  void RequestCommit(Durability durability, CommitWorker::Done done = {});

  const SessionOptions options_;
  CommitWorker commits_;

  // Writer thread only.
  MapBuilder builder_;
  int num_unpublished_ = 0;  // frames
  int num_uncommitted_ = 0;
  TimePoint publish_due_;
  TimePoint commit_due_;

  mutable std::mutex view_mutex_;
  std::shared_ptr<const MapView> view_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  // Guarded by mutex_.
  std::deque<Job> jobs_;
  std::size_t num_pending_edits_ = 0;
  bool is_fed_ = false;
  Status refusal_;  // not OK: no more work is taken
  bool stopping_ = false;

  std::mutex stop_mutex_;
  std::thread writer_;
};

}  // namespace dhpmap
