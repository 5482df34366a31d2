// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/open_map/open_map.h"

#include <chrono>
#include <utility>

#include "mapping/base/guarded.h"

namespace dhpmap {
namespace {

std::int64_t SystemNow() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

/// The history of a map that starts with the stored state.
std::shared_ptr<SnapshotHistory> KeptFrom(const std::shared_ptr<const MapSnapshot>& stored,
                                          const HistoryOptions& options) {
  auto budget = options.budget ? options.budget : std::make_shared<ByteBudget>(options.bytes);
  auto kept = std::make_shared<SnapshotHistory>(options.max_states, std::move(budget));
  kept->Keep(stored);
  return kept;
}

std::shared_ptr<ThreadPool> PoolOf(const MappingOptions& options) {
  return options.pool ? options.pool : std::make_shared<ThreadPool>(options.num_threads);
}

}  // namespace

OpenMap::OpenMap(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, OpenMapOptions options)
    : OpenMap(std::move(snapshot), store, options, options.now_ns ? options.now_ns : SystemNow) {}

OpenMap::OpenMap(std::shared_ptr<const MapSnapshot> snapshot, MapStore& store, const OpenMapOptions& options,
                 UtcClock now_ns)
    : history_(KeptFrom(snapshot, options.history)),
      committer_(store, snapshot, options.commit,
                 [this](const std::shared_ptr<const MapSnapshot>& state) { OnStored(state); }),
      builder_(std::move(snapshot), PoolOf(options.mapping), options.mapping.refinement_timing,
               options.mapping.refinement_slots),
      publisher_(builder_.map(), committer_, options.publish, options.commit, now_ns),
      batches_(builder_.map(), publisher_, committer_, options.commit.retry_s),
      recording_(options.make_recorder),
      queue_(options.max_pending_edits, Chores()),
      writer_{queue_, builder_, committer_, publisher_, batches_, recording_, std::move(now_ns), give_up_.get_token()},
      intake_(writer_, options.feeds, options.mapping.on_refinement),
      editor_(writer_, store),
      finisher_(writer_, options.mapping.on_refinement, options.on_finishing),
      evictor_(writer_, options.pages, history_) {}

OpenMap::~OpenMap() { (void)Stop(); }

WriterChores OpenMap::Chores() {
  return {.due = [this] { return batches_.Due(); },
          .run =
              [this] {
                batches_.DoThoseDue();
                evictor_.Evict();
              },
          .finish =
              [this] {
                Status outcome = batches_.StoreTheRest();
                if (end_outcome_.ok()) end_outcome_ = std::move(outcome);
              }};
}

/// On the commit thread.
void OpenMap::OnStored(const std::shared_ptr<const MapSnapshot>& state) {
  history_->Keep(state);
  evictor_.OnKept();
}

void OpenMap::Edit(std::function<Result<SubmapId>(Map&)> change, std::function<void(Result<EditOutcome>)> done,
                   EditMode mode) {
  auto make = [change = std::move(change)](Map& map) -> Result<EditMade> {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId submap, change(map));
    return EditMade{.submap = submap, .summary = {}};
  };
  Edit(EditRequest{.change = std::move(make), .mode = mode}, std::move(done));
}

void OpenMap::Flush(std::function<void(const Status&)> done) {
  auto run = [this, done] {
    const Status failed = Guarded<Status>([&] {
      batches_.StoreAll(done);
      return Status::Ok();
    });
    if (!failed.ok()) done(failed);
  };
  queue_.Post({.run = std::move(run), .refuse = std::move(done)});
}

Status OpenMap::DeleteFromStore() {
  DHPMAP_RETURN_IF_ERROR(queue_.refusal());
  Status refusal = NotFound("the map has been deleted").WithReason("MAP_NOT_FOUND");  // now: nothing may fail later
  DHPMAP_RETURN_IF_ERROR(intake_.seats().Close());                                    // no new feed may start meanwhile
  Status status = committer_.DeleteMap();
  if (status.ok()) queue_.Close(std::move(refusal));
  else intake_.seats().Reopen();
  return status;
}

bool OpenMap::IsViewed() const {
  const auto view = View();
  constexpr auto kOursAndThis = 2;
  return view.use_count() > kOursAndThis || !view->IsOnlyOne();
}

bool OpenMap::IsAtRest() const {
  return queue_.IsAtRest() && BehindSeconds() == 0 && committer_.stored_revision() == View()->snapshot().revision();
}

Status OpenMap::MoveAway(const Status& why) {
  queue_.Close(CopyOf(why));
  intake_.seats().MoveAway(why);
  return Stop();
}

Status OpenMap::Stop() {
  const MutexLock stop_lock(stop_mutex_);
  give_up_.request_stop();
  const bool is_deleted = queue_.Stop() == StatusCode::kNotFound;  // another map may have the name by now
  committer_.Stop();
  if (!is_deleted) TellSafely([this] { committer_.ReleaseNumbers(builder_.map().info()); });  // a gap is harmless
  return end_outcome_.ok() ? committer_.last_outcome() : CopyOf(end_outcome_);
}

}  // namespace dhpmap
