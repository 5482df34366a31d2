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
#include "server/app/session/batches.h"
#include "server/app/session/committer.h"
#include "server/app/session/frame_intake.h"
#include "server/app/session/map_editor.h"
#include "server/app/session/map_finisher.h"
#include "server/app/session/map_recording.h"
#include "server/app/session/map_writer.h"
#include "server/app/session/page_evictor.h"
#include "server/app/session/publisher.h"
#include "server/app/session/writer_queue.h"
#include "server/app/states/kept_states.h"

namespace dhpmap {

/// How frames are fused and refined.
struct MappingOptions {
  int num_threads = 0;                         ///< of fusion; 0 = one a core
  std::shared_ptr<ThreadPool> pool = nullptr;  ///< for fusion, shared with other maps; null: num_threads of its own
  /// Shared with other maps; null: it refines when it will.
  std::shared_ptr<RefinementSlots> refinement_slots = nullptr;
  RefinementTiming refinement_timing = RefinementTiming::kNeverWait;
  std::function<void(const RefinementReport&)> on_refinement = {};  ///< on the writer thread; may be empty
};

/// Which past states are kept to be read again.
struct HistoryOptions {
  std::size_t max_states = 64;                   ///< that were stored last
  std::size_t bytes = 256u << 20;                ///< that these take, of all maps
  std::shared_ptr<ByteBudget> budget = nullptr;  ///< of so many, shared with other maps; null: of its own
};

struct SessionOptions {
  MappingOptions mapping = {};
  PublishOptions publish = {};
  CommitOptions commit = {};
  PageOptions pages = {};
  FeedOptions feeds = {};
  HistoryOptions history = {};
  std::size_t max_pending_edits = 256;      ///< waiting for the writer; more are answered RESOURCE_EXHAUSTED
  UtcClock now_ns = {};                     ///< empty: the system's clock
  MakeRecorder make_recorder = {};          ///< may be empty: nothing is recorded
  std::function<void()> on_finishing = {};  ///< Finishing() answers something else; on any thread; may be empty
};

/// One open map, composed of its parts: jobs on the WriterQueue's thread change the map of the MapBuilder; the
/// Publisher makes it visible, the Committer brings it into the store on a thread of its own, and Batches say when.
/// FrameIntake, MapEditor, MapFinisher and PageEvictor make the jobs. Readers take View() and wait for none of these.
/// Thread-safe. Callbacks run on the session's threads and must be quick; each runs exactly once, and what it throws is
/// dropped. What goes wrong by an exception is answered RESOURCE_EXHAUSTED, reason OUT_OF_MEMORY, or INTERNAL, and the
/// threads go on; a call that throws itself has had no effect, and its callback never runs. Whoever lets go of the last
/// reference must have called Stop() if that may happen in a callback.
class MapSession {
 public:
  /// `snapshot` is the state the store holds. The store outlives the session.
  MapSession(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, SessionOptions options);
  /// Stop().
  ~MapSession();
  MapSession(const MapSession&) = delete;
  MapSession& operator=(const MapSession&) = delete;

  /// The state that is seen: see ShownView.
  [[nodiscard]] std::shared_ptr<const MapView> View() const { return publisher_.Visible(); }

  /// The states that were stored last. Never null.
  [[nodiscard]] const std::shared_ptr<KeptStates>& kept_states() const { return kept_states_; }

  /// A turn at feeding the map: see FeedSeats::Take. INVALID_ARGUMENT for a bad name of a session, NOT_FOUND if the map
  /// is being deleted.
  Result<std::shared_ptr<Feed>> BeginFeed(FeedRequest request = {}) { return intake_.BeginFeed(std::move(request)); }
  void EndFeed(const std::shared_ptr<Feed>& feed) { intake_.seats().Leave(feed); }
  /// Ends the stream of a session: see FeedSeats::End. Its frames that wait are refused.
  Status EndSession(const std::string& session) { return intake_.seats().End(session); }
  /// See ListSessions.
  [[nodiscard]] std::vector<SessionStatus> Sessions() const { return intake_.Sessions(); }
  [[nodiscard]] std::size_t num_feeds() const { return intake_.seats().Feeds().size(); }

  /// Whether messages are to be kept until their frames are fused, or their edits made.
  [[nodiscard]] bool IsRecorded() const { return recording_.is_wanted(); }

  /// For how long what was fused has not been stored.
  [[nodiscard]] double BehindSeconds() const { return committer_.BehindSeconds(); }

  /// Fuses a frame. UNAVAILABLE, reason STORE_BEHIND, while the store has been
  /// behind for longer than max_behind_s. An error in its place is passed on to `done` in its turn, so that answers
  /// keep the order of the calls. Refused with ABORTED if the feed has lost its place by then; without effect if its
  /// session has taken this or a later sequence. The feeder limits how many are under way, and is answered for each.
  void Integrate(const std::shared_ptr<Feed>& feed, ArrivedFrame arrived, std::function<void(FrameOutcome)> done) {
    intake_.Integrate(feed, std::move(arrived), std::move(done));
  }
  void Integrate(const std::shared_ptr<Feed>& feed, std::int64_t sequence, Result<PanopticFrame> frame,
                 std::function<void(FrameOutcome)> done) {
    Integrate(feed, ArrivedFrame{.sequence = sequence, .frame = std::move(frame)}, std::move(done));
  }
  /// The same for one who feeds alone, without a name.
  void Integrate(Result<PanopticFrame> frame, std::function<void(FrameOutcome)> done) {
    Integrate(nullptr, 0, std::move(frame), std::move(done));
  }

  /// Tells how far the feed has got, in turn with its frames.
  void Greet(const std::shared_ptr<Feed>& feed, std::function<void(FeedProgress)> done) {
    intake_.Greet(feed, std::move(done));
  }
  /// The same at once.
  [[nodiscard]] FeedProgress ProgressOf(const std::shared_ptr<Feed>& feed) const { return intake_.ProgressOf(feed); }

  /// Makes an edit on the map between two frames, after publishing and committing what was fused so far; on an error
  /// the map is as it was. The new state is committed with a full sync, together with its entry in the log, before
  /// anybody sees it. If the store fails, the change has not happened: `done` gets the store's error, and nothing of it
  /// is seen or stored later. A request whose id the log has is answered as it was and does nothing; INVALID_ARGUMENT,
  /// reason REQUEST_ID_REUSED, if that was another one.
  void Edit(EditRequest request, std::function<void(Result<EditOutcome>)> done) {
    editor_.Edit(std::move(request), std::move(done));
  }
  /// Runs `change` on the map between two frames likewise, an edit of which the log says nothing but that it was.
  void Edit(std::function<Result<SubmapId>(Map&)> change, std::function<void(Result<EditOutcome>)> done,
            EditMode mode = EditMode::kMake);

  /// Publishes and commits everything that was handed in before, with a full sync: what a feeder hears at its end is
  /// true after a power cut, too.
  void Flush(std::function<void(const Status&)> done);

  /// MapBuilder::Finish, then a commit with a full sync. CANCELLED, and nothing has happened, once `stop` is requested
  /// while it waits or refines; UNAVAILABLE if the session ends meanwhile. `done` is called once, by the writer, the
  /// commit worker, or who requests the stop.
  void Finish(std::function<void(Result<FinishOutcome>)> done, std::stop_token stop = {}) {
    finisher_.Finish(std::move(done), std::move(stop));
  }

  /// Of the Finish that was asked for first and is not done; nothing if there is none.
  [[nodiscard]] std::optional<FinishProgress> Finishing() const { return finisher_.Progress(); }

  /// Removes the map from the store and refuses all further work with NOT_FOUND. FAILED_PRECONDITION while somebody
  /// feeds frames, unless that feed is idle: then it ends. Blocks for the time of the deletion.
  Status DeleteFromStore();

  /// Whether somebody else holds a view of the map, be it of an earlier state.
  [[nodiscard]] bool IsViewed() const;

  /// Has the writer leave voxels in the store again, soon, if those that were read take more than they may. States that
  /// somebody holds keep what they have read. Costs nothing else.
  void KeepPagesInBounds() { evictor_.EvictSoon(); }

  /// Nothing is under way, and everything is in the store: Stop() would lose nothing and refuse nobody, if nobody holds
  /// the session who may still ask for something.
  [[nodiscard]] bool IsAtRest() const;

  /// The frame in hand and those that wait are refused with UNAVAILABLE, and leave the map as it was; so does a
  /// refinement. All else goes on.
  void GiveUpMapping() { give_up_.request_stop(); }
  [[nodiscard]] bool HasGivenUpMapping() const { return give_up_.stop_requested(); }

  /// Ends the job in hand (a frame or a refinement is given up), refuses those that wait and all later ones with
  /// UNAVAILABLE, commits with a full sync, and joins the threads. Returns the outcome of that commit.
  Status Stop() DHPMAP_EXCLUDES(stop_mutex_);

 private:
  MapSession(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, const SessionOptions& options,
             UtcClock now_ns);
  [[nodiscard]] WriterChores Chores();
  void OnStored(const std::shared_ptr<const MapSnapshot>& state);

  // Each uses only those above it, but for callbacks from the two threads, which begin with the first job.
  std::stop_source give_up_;
  const std::shared_ptr<KeptStates> kept_states_;
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

  Mutex stop_mutex_;  ///< held while threads end: of two callers of Stop the second waits, too
  Status
      end_outcome_;  ///< not OK: at the end something could not even be handed to the store. Writer thread, then Stop
};

}  // namespace dhpmap
