// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
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
#include "server/app/commit_worker.h"
#include "server/app/feed_seats.h"
#include "server/app/frame_recorder.h"
#include "server/app/kept_states.h"
#include "server/app/lazy_thread.h"
#include "server/app/map_view.h"
#include "server/app/number_reserve.h"
#include "server/app/session_list.h"
#include "server/app/shown_view.h"
#include "server/app/store_lag.h"

namespace dhpmap {

struct SessionOptions {
  int num_threads = 0;                         ///< of fusion; 0 = one a core
  std::shared_ptr<ThreadPool> pool = nullptr;  ///< for fusion, shared with other maps; null: num_threads of its own
  std::shared_ptr<RefinementSlots> refinement_slots =
      nullptr;  ///< shared with other maps; null: it refines when it will
  // Fused frames become visible to queries after so many of them, or so long after the first of them.
  int publish_frames = 10;
  double publish_s = 0.2;
  // They go to the store after so many, or so long after the first.
  int commit_frames = 50;
  double commit_s = 2.0;
  double commit_retry_s = 5.0;  ///< between attempts while the store refuses
  double max_behind_s = 30;     ///< what is fused may be so long not stored; then frames are refused
  double idle_close_s = 600;    ///< a map that nobody uses for so long is closed; 0: never
  /// Of voxels in memory, and of what is known of those on the disk, of all maps of the process together: near it they
  /// are left in the store, or in `spill`, and past states go; 0: no bound. Without `spill` those that were read from
  /// the store count alone, and nothing else can go.
  std::int64_t page_bytes = 0;
  std::shared_ptr<TileSpill> spill = nullptr;  ///< takes what was written since it was read; shared by all maps
  double feed_idle_s = 30;                     ///< a feeder that is silent for so long makes place for others
  std::size_t max_feeds = 16;                  ///< streams that feed a map at once
  RefinementTiming refinement_timing = RefinementTiming::kNeverWait;
  std::size_t surface_bytes = 512u << 20;  ///< of surfaces that are kept for distances, of all maps
  std::size_t max_pending_edits = 256;     ///< waiting for the writer; more are answered RESOURCE_EXHAUSTED
  std::function<std::int64_t()> now_ns;    ///< UTC; empty = the system's clock
  std::function<void(double seconds, const Status& status)> on_commit;  ///< on the commit thread; may be empty
  std::function<void(const RefinementReport&)> on_refinement;           ///< on the writer thread; may be empty
  /// Asked for before the first frame is fused; may be empty, and answer null: then nothing is recorded.
  std::function<std::unique_ptr<FrameRecorder>(const MapInfo& map)> make_recorder;
  std::function<void()> on_stored;     ///< the store has another state of the map; on the commit thread; may be empty
  std::function<void()> on_finishing;  ///< Finishing() answers something else; on any thread; may be empty
  std::size_t max_watchers = 1000;     ///< of all maps
  std::int64_t max_import_bytes = std::int64_t{16} << 30;  ///< of the file of a map that comes in
  int max_imports = 2;                                     ///< maps that come in at once
  std::size_t max_kept_states = 64;                        ///< that were stored last, of each map, to be read again
  std::size_t kept_states_bytes = 256u << 20;              ///< that these take, of all maps
  std::shared_ptr<ByteBudget> kept_budget = nullptr;       ///< of so many, shared with other maps; null: of its own
  /// What is made ready for queries before they see a state; may be empty. May keep one that frames have made from them
  /// for another publish_s, or commit_s if that is less.
  ShownView::Prepare prepare;
};

/// What counts against page_bytes now.
std::int64_t ResidentBytes(const SessionOptions& options);
/// Of page_bytes, from where on voxels are left on the disk: the rest is for what is read meanwhile.
std::int64_t BytesToKeep(const SessionOptions& options);
/// How much of what they have read requests may hold together: see PageReaderLimit.
std::int64_t BytesOfReaders(const SessionOptions& options);

/// What became of a frame.
struct FrameOutcome {
  Result<FrameReport> report;  ///< or why the frame was refused: then it changed nothing
  std::int64_t revision = 0;   ///< last published
  bool is_committed = false;   ///< everything up to this frame is in the store
  Status commit_status;        ///< why the store is behind, if the last commit failed
  FrameCheck check = {};       ///< how the frame fits, refused or not; empty if it was not looked at
  bool is_duplicate = false;   ///< of one that its session had taken before: changed nothing, and the report is empty
  std::optional<std::int64_t> committed_sequence = std::nullopt;  ///< see FeedProgress
};

/// A frame of a feed, as it came.
struct ArrivedFrame {
  std::int64_t sequence = 0;    ///< the client's number
  Result<PanopticFrame> frame;  ///< or why it cannot be used: passed on in its turn, so that answers keep their order
  std::size_t num_bytes = 0;    ///< of the message
  std::string message = {};     ///< itself, if MapSession::IsRecorded
};

/// How far a feed has got.
struct FeedProgress {
  std::int64_t revision = 0;  ///< last published
  /// Of the newest frame that is in the store together with all before it: of the session, or of a feed without one.
  std::optional<std::int64_t> committed_sequence;
  Status commit_status;  ///< why the store is behind, if the last commit failed
};

/// Whether an edit is to be made, or only to be tried: then everything is checked and told, and nothing changes.
enum class EditMode { kMake, kTryOnly };

/// What an edit did to the map.
struct EditMade {
  SubmapId submap;                        ///< that was edited, or made
  EditSummary summary;                    ///< for the log
  std::vector<RegionEvent> cleared = {};  ///< for those who follow the map
};

/// An edit as it is asked for.
struct EditRequest {
  /// On an error, or what it throws, the map is as it was.
  std::function<Result<EditMade>(Map&)> change;
  EditSource source = {};
  EditMode mode = EditMode::kMake;
  /// What is answered, made from the state that has the edit, or, if it is only tried, would have it. Where the request
  /// has an id it is stored with the edit, and is what a repeated request is answered. May be empty.
  std::function<std::string(const MapView&, const EditMade&)> answer = {};
  ArrivedEdit arrived = {};  ///< if MapSession::IsRecorded
};

/// A state that holds an edit (of one that was only tried: the state that it met), and the submap that was edited, or
/// made (none, of a request that was repeated).
struct EditOutcome {
  std::shared_ptr<const MapView> view;
  SubmapId submap;
  std::string answer = {};
};

/// How far MapSession::Finish has come.
enum class FinishStage { kWaiting, kRefining, kStoring };
struct FinishProgress {
  FinishStage stage = FinishStage::kWaiting;
  double elapsed_s = 0;  ///< since it was asked for
};

/// The finished state, and what refining it did.
struct FinishOutcome {
  std::shared_ptr<const MapView> view;
  RefinementReport refinement;
};

/// One open map: its writer thread owns the MapBuilder and works through frames and edits in the order they came; its
/// CommitWorker brings what the writer publishes into the store. Readers take View() and never wait for either.
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
  [[nodiscard]] std::shared_ptr<const MapView> View() const;

  /// The states that were stored last. Never null.
  [[nodiscard]] const std::shared_ptr<KeptStates>& kept_states() const { return kept_states_; }

  /// A turn at feeding the map: see FeedSeats::Take. INVALID_ARGUMENT for a bad name of a session, NOT_FOUND if the map
  /// is being deleted.
  Result<std::shared_ptr<Feed>> BeginFeed(FeedRequest request = {});
  void EndFeed(const std::shared_ptr<Feed>& feed) { seats_.Leave(feed); }
  /// Ends the stream of a session: see FeedSeats::End. Its frames that wait are refused.
  Status EndSession(const std::string& session) { return seats_.End(session); }
  /// See ListSessions.
  [[nodiscard]] std::vector<SessionStatus> Sessions() const;
  [[nodiscard]] std::size_t num_feeds() const { return seats_.Feeds().size(); }

  /// Whether messages are to be kept until their frames are fused, or their edits made.
  [[nodiscard]] bool IsRecorded() const { return options_.make_recorder != nullptr; }

  /// For how long what was fused has not been stored.
  [[nodiscard]] double BehindSeconds() const;

  /// Fuses a frame. UNAVAILABLE, reason STORE_BEHIND, while the store has been
  /// behind for longer than max_behind_s. An error in its place is passed on to `done` in its turn, so that answers
  /// keep the order of the calls. Refused with ABORTED if the feed has lost its place by then; without effect if its
  /// session has taken this or a later sequence. The feeder limits how many are under way, and is answered for each.
  void Integrate(const std::shared_ptr<Feed>& feed, ArrivedFrame arrived, std::function<void(FrameOutcome)> done);
  void Integrate(const std::shared_ptr<Feed>& feed, std::int64_t sequence, Result<PanopticFrame> frame,
                 std::function<void(FrameOutcome)> done) {
    Integrate(feed, ArrivedFrame{.sequence = sequence, .frame = std::move(frame)}, std::move(done));
  }
  /// The same for one who feeds alone, without a name.
  void Integrate(Result<PanopticFrame> frame, std::function<void(FrameOutcome)> done);

  /// Tells how far the feed has got, in turn with its frames.
  void Greet(const std::shared_ptr<Feed>& feed, std::function<void(FeedProgress)> done);
  /// The same at once.
  [[nodiscard]] FeedProgress ProgressOf(const std::shared_ptr<Feed>& feed) const;

  /// Makes an edit on the map between two frames, after publishing and committing what was fused so far; on an error
  /// the map is as it was. The new state is committed with a full sync, together with its entry in the log, before
  /// anybody sees it. If the store fails, the change has not happened: `done` gets the store's error, and nothing of it
  /// is seen or stored later. A request whose id the log has is answered as it was and does nothing; INVALID_ARGUMENT,
  /// reason REQUEST_ID_REUSED, if that was another one.
  void Edit(EditRequest request, std::function<void(Result<EditOutcome>)> done);
  /// Runs `change` on the map between two frames likewise, an edit of which the log says nothing but that it was.
  void Edit(std::function<Result<SubmapId>(Map&)> change, std::function<void(Result<EditOutcome>)> done,
            EditMode mode = EditMode::kMake);

  /// Publishes and commits everything that was handed in before, with a full sync: what a feeder hears at its end is
  /// true after a power cut, too.
  void Flush(std::function<void(const Status&)> done);

  /// MapBuilder::Finish, then a commit with a full sync. CANCELLED, and nothing has happened, once `stop` is requested
  /// while it waits or refines; UNAVAILABLE if the session ends meanwhile. `done` is called once, by the writer, the
  /// commit worker, or who requests the stop.
  void Finish(std::function<void(Result<FinishOutcome>)> done, std::stop_token stop = {});

  /// Of the Finish that was asked for first and is not done; nothing if there is none.
  [[nodiscard]] std::optional<FinishProgress> Finishing() const;

  /// Removes the map from the store and refuses all further work with NOT_FOUND. FAILED_PRECONDITION while somebody
  /// feeds frames, unless that feed is idle: then it ends. Blocks for the time of the deletion.
  Status DeleteFromStore();

  /// Whether somebody else holds a view of the map, be it of an earlier state.
  [[nodiscard]] bool IsViewed() const {
    const auto view = View();
    constexpr auto kOursAndThis = 2;
    return view.use_count() > kOursAndThis || !view->IsOnlyOne();
  }

  /// Has the writer leave voxels in the store again, soon, if those that were read take more than they may. States that
  /// somebody holds keep what they have read. Costs nothing else.
  void KeepPagesInBounds();

  /// Nothing is under way, and everything is in the store: Stop() would lose nothing and refuse nobody, if nobody holds
  /// the session who may still ask for something.
  [[nodiscard]] bool IsAtRest() const;

  /// The frame in hand and those that wait are refused with UNAVAILABLE, and leave the map as it was; so does a
  /// refinement. All else goes on.
  void GiveUpMapping() { end_.request_stop(); }
  [[nodiscard]] bool HasGivenUpMapping() const { return end_.stop_requested(); }

  /// Ends the job in hand (a frame or a refinement is given up), refuses those that wait and all later ones with
  /// UNAVAILABLE, commits with a full sync, and joins the threads. Returns the outcome of that commit.
  Status Stop();

 private:
  struct Job {
    std::function<void()> run;
    std::function<void(const Status&)> refuse;
    bool is_edit = false;
  };
  using TimePoint = std::chrono::steady_clock::time_point;

  /// If it throws, the job neither runs nor is refused.
  void Post(Job job);
  void WriterLoop();
  [[nodiscard]] Job TakeJob() DHPMAP_REQUIRES(mutex_);
  /// Lets go of the mutex while the job runs.
  void RunOne() DHPMAP_REQUIRES(mutex_);
  void RefuseAll() DHPMAP_EXCLUDES(mutex_);
  static Status ShuttingDown();
  void StoreTheRest() DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::optional<TimePoint> BatchDue() const;
  void NoteChange();
  void DoBatchesThatAreDue();
  [[nodiscard]] Status WhyBehind() const;
  struct Arrival;
  FrameOutcome IntegrateNow(Arrival& arrival);
  Result<FrameReport> TakeInTurn(Arrival& arrival, bool& is_duplicate);
  Result<FrameReport> TakeFrame(Arrival& arrival);
  Result<FrameReport> Fuse(Feed* feed, std::int64_t sequence, const PanopticFrame& frame);
  struct FinishCall;
  void SetStage(const std::shared_ptr<FinishCall>& call, FinishStage stage);
  void EndFinish(const std::shared_ptr<FinishCall>& call);
  using FinishDone = std::function<void(Result<FinishOutcome>)>;
  void PostFinish(const std::shared_ptr<FinishCall>& call, FinishDone on_done, std::stop_token stop);
  Status FinishAndStore(const std::shared_ptr<FinishCall>& call, const std::stop_token& stop, const FinishDone& done);
  Result<RefinementReport> FinishNow(const std::stop_token& stop);
  Result<EditOutcome> EditNow(const EditRequest& request);
  Result<EditOutcome> StoreEdit(const EditRequest& request, const EditMade& made,
                                const std::shared_ptr<const MapSnapshot>& before);
  Result<std::optional<EditOutcome>> FindRepeated(const EditSource& source) const;
  void OnStored(const std::shared_ptr<const MapSnapshot>& state);
  [[nodiscard]] bool HasTooManyPages() const;
  void LetGoOfPages();
  std::shared_ptr<const MapView> Publish();
  void PublishPrepared();
  std::shared_ptr<const MapView> MakeView();
  void CommitBatch();
  Status CommitPublished();
  void ReleaseNumbers();
  void RequestCommit(Durability durability, CommitWorker::Done done = {});

  const SessionOptions options_;
  MapStore& store_;
  NumberReserve numbers_;
  const std::shared_ptr<KeptStates> kept_states_;  // before the worker that adds to them
  CommitWorker commits_;
  mutable StoreLag lag_;  // hears of commits when it is asked
  FeedSeats seats_;

  // Writer thread only.
  MapBuilder builder_;
  std::optional<std::unique_ptr<FrameRecorder>> recorder_;  // once there was a frame; null: nothing is recorded
  int num_unpublished_ = 0;                                 // changes: frames, or what finishing did
  int num_uncommitted_ = 0;
  TimePoint publish_due_;
  TimePoint commit_due_;
  TimePoint show_due_;             ///< of a state that waits to be seen
  bool is_batch_waiting_ = false;  ///< until it is seen: then it is committed

  std::atomic<bool> is_asked_for_pages_ = false;   ///< a job that lets go of them waits
  std::atomic<bool> has_kept_pages_ = false;       ///< a state was kept with pages since they were let go of
  std::atomic<std::int64_t> held_page_bytes_ = 0;  ///< what was left of them the last time, if that was too much

  const std::shared_ptr<ShownView> shown_;  // outlived by what prepares

  Mutex stop_mutex_ DHPMAP_ACQUIRED_BEFORE(mutex_);
  mutable Mutex mutex_;
  CondVar wake_;
  std::deque<Job> jobs_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t num_pending_edits_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::deque<std::shared_ptr<FinishCall>> finish_calls_ DHPMAP_GUARDED_BY(mutex_);  ///< in the order of the calls
  Status refusal_ DHPMAP_GUARDED_BY(mutex_);                                        // not OK: no more work is taken
  bool is_running_ DHPMAP_GUARDED_BY(mutex_) = false;                               // a job
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  Status end_outcome_ DHPMAP_GUARDED_BY(mutex_);  // not OK: at the end something could not even be handed to the store
  std::stop_source end_;                          ///< requested with stopping_, for work that asks now and then

  LazyThread writer_;  // started and retired under mutex_, joined under stop_mutex_
};

}  // namespace dhpmap
