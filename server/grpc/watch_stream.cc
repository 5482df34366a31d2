// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/watch_stream.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "mapping/base/this_thread.h"
#include "proto/types/resource_names.h"
#include "server/grpc/open_streams.h"
#include "server/wire/mapping_conversion.h"

namespace dhpmap {
namespace {

Status MapIsGone(const std::string& name) {
  return NotFound("map '" + name + "' has been deleted").WithReason("MAP_NOT_FOUND");
}

}  // namespace

Status WatchStreams::Add(WatchStream* stream) {
  const MutexLock lock(mutex_);
  if (is_stopped_) return ShuttingDown();
  DHPMAP_RETURN_IF_ERROR(beat_.Start([this] { BeatLoop(); }));
  streams_.insert(stream);
  return Status::Ok();
}

void WatchStreams::Remove(WatchStream* stream) {
  const MutexLock lock(mutex_);
  streams_.erase(stream);
}

void WatchStreams::StopAll() {
  {
    const MutexLock lock(mutex_);
    is_stopped_ = true;
    for (WatchStream* stream : streams_) stream->Stop(ShuttingDown());
  }
  wake_.NotifyAll();
}

void WatchStreams::BeatLoop() {
  NameThisThread("watch-beat");
  const MutexLock lock(mutex_);
  while (!wake_.WaitFor(mutex_, kBeat, [this]() DHPMAP_REQUIRES(mutex_) { return is_stopped_; }) && !streams_.empty()) {
    const auto now = std::chrono::steady_clock::now();
    for (WatchStream* stream : streams_) stream->OnBeat(now);
  }
  beat_.Retire();
}

WatchStream* WatchStream::Start(const ServiceContext& context, WatchStreams& streams,
                                const v1::WatchMapRequest& request) {
  auto* stream = new WatchStream(context, streams, request);
  context.lanes.watch.Post([stream] { stream->Begin(); });
  return stream;
}

void WatchStream::TakeTurn() {
  has_turn_ = true;
  has_news_ = false;
  context_.lanes.watch.Post([this] { Step(); });
}

void WatchStream::Wake() {
  const MutexLock lock(mutex_);
  if (is_over_) return;
  if (has_turn_) has_news_ = true;
  else TakeTurn();
}

void WatchStream::OnBeat(Clock::time_point now) {
  const MutexLock lock(mutex_);
  if (is_over_ || has_turn_) return;
  if (now >= say_by_ || context_.registry.exports().number() != exports_asked_) TakeTurn();
}

void WatchStream::Stop(const Status& reason) {
  const MutexLock lock(mutex_);
  if (is_over_ || !stop_.ok()) return;
  stop_ = reason;
  if (!has_turn_) TakeTurn();
}

void WatchStream::OnCancel() { Stop(Cancelled("the client went away")); }

void WatchStream::OnWriteDone(bool ok) {
  share_.Release();
  if (!ok) return End(Cancelled("the client went away"));
  const MutexLock lock(mutex_);
  TakeTurn();
}

void WatchStream::OnDone() {
  streams_.Remove(this);
  follower_.reset();
  delete this;
}

Status WatchStream::WhyStop() const {
  const MutexLock lock(mutex_);
  return stop_;
}

void WatchStream::End(const Status& status) {
  {
    const MutexLock lock(mutex_);
    if (is_over_) return;
    is_over_ = true;
  }
  record_.End(status);
  Finish(ToGrpc(status));
}

void WatchStream::Begin() {
  const Status status = RunGuarded([this] { return Prepare(); });
  if (!status.ok()) return End(status);
  response_.mutable_progress();  // the starting position
  Write();
}

Status WatchStream::Prepare() {
  DHPMAP_RETURN_IF_ERROR(streams_.Add(this));
  DHPMAP_RETURN_IF_ERROR(WhyStop());
  DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request_.map(), "map"));
  DHPMAP_ASSIGN_OR_RETURN(const WatchStart start, WatchStartFromProto(request_));
  DHPMAP_ASSIGN_OR_RETURN(const double progress_s, ProgressSecondsFromProto(request_));
  progress_after_ = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(progress_s));
  DHPMAP_ASSIGN_OR_RETURN(const MapSummary summary, context_.registry.Get(name));
  map_.name = name;
  map_.history_id = summary.info.history_id;
  map_.label_set = summary.info.label_set;
  DHPMAP_ASSIGN_OR_RETURN(filter_, ChangeFilterFromProto(request_.filter(), *map_.label_set));
  DHPMAP_ASSIGN_OR_RETURN(const auto position,
                          PositionBefore(start, summary.info, *context_.registry.LostRevisionsOf(name)));
  DHPMAP_ASSIGN_OR_RETURN(follower_, context_.registry.changes().Follow(name, [this] { Wake(); }));
  position_ = {map_.history_id, position ? position->revision : std::numeric_limits<std::int64_t>::max()};
  DHPMAP_RETURN_IF_ERROR(ReadPage().status());  // fails if the store no longer keeps that position
  if (!position) position_.revision = page_.revision;
  const MutexLock lock(mutex_);
  exports_asked_ = context_.registry.exports().number();  // a new watcher does not receive exports that ended before
  return Status::Ok();
}

void WatchStream::Step() {
  Status status = WhyStop();
  bool has_next = false;
  do {
    if (status.ok()) {
      status = RunGuarded([&]() -> Status {
        DHPMAP_ASSIGN_OR_RETURN(has_next, FillNext());
        return Status::Ok();
      });
    }
    if (!status.ok()) return End(status);
  } while (!has_next && !GiveTurnBack());
  if (has_next) Write();
}

bool WatchStream::GiveTurnBack() {
  const MutexLock lock(mutex_);
  if (std::exchange(has_news_, false) || !stop_.ok()) return false;
  has_turn_ = false;
  return true;
}

Result<bool> WatchStream::FillNext() {
  DHPMAP_RETURN_IF_ERROR(WhyStop());
  response_.Clear();
  while (true) {
    if (FillChange()) return true;
    DHPMAP_ASSIGN_OR_RETURN(const bool has_more, ReadPage());
    if (!has_more) return FillProgress();
  }
}

/// Fills the next message of the page, if there is one.
bool WatchStream::FillChange() {
  while (!messages_.has_next()) {
    messages_ = {};
    if (next_in_page_ == page_.changes.size()) return false;
    auto change = std::move(page_.changes[next_in_page_++]);
    change_end_ = change->last_revision;
    told_bytes_ = BytesOf(*change);
    messages_ = ChangeMessages(std::move(change), filter_);
    if (!messages_.has_next()) position_.revision = std::max(position_.revision, change_end_);
  }
  messages_.Next(filter_, map_, *response_.mutable_change());
  if (messages_.has_next()) return true;
  messages_ = {};
  position_.revision = std::max(position_.revision, change_end_);
  return true;
}

/// Whether the store has more changes.
Result<bool> WatchStream::ReadPage() {
  next_in_page_ = 0;
  page_.changes.clear();
  DHPMAP_ASSIGN_OR_RETURN(page_, context_.registry.changes().Read(map_.name, position_.revision));
  if (page_.history_id != map_.history_id) return MapIsGone(map_.name);  // a new map has this name
  const bool is_at_end = page_.changes.empty() && !page_.has_more;
  if (is_at_end) position_.revision = std::max(position_.revision, page_.revision);
  return !page_.changes.empty();
}

/// News of exports since the last call.
ExportNews WatchStream::AskExports() {
  const MutexLock lock(mutex_);
  ExportNews news = context_.registry.exports().Of(map_.name, exports_asked_);
  exports_asked_ = news.number;
  return news;
}

/// Fills a message if one is due, or if FinishMapping or an export has reached another stage or ended. Clients may
/// start exports often, so news of several exports is combined.
bool WatchStream::FillProgress() {
  const auto now = Clock::now();
  const auto finishing = context_.registry.FinishingOf(map_.name);
  const auto stage = finishing ? std::optional(finishing->stage) : std::nullopt;
  bool is_due = stage != told_stage_ || IsTimeToSay(now);
  if (!is_due && now < exports_told_ + kExportsApart) return false;
  const ExportNews exports = AskExports();
  const bool is_exporting = exports.num_running > 0;
  const bool has_export_news = exports.has_changed || is_exporting != has_told_exports_;
  is_due = is_due || has_export_news || (is_exporting && now >= exports_told_ + WorkProgressAfter());
  if (!is_due) return false;
  const bool is_of_exports = has_export_news || is_exporting;
  const bool is_of_work = finishing || told_stage_ || is_of_exports;
  told_stage_ = stage;
  has_told_exports_ = is_exporting;
  if (!is_of_work && position_.revision == last_said_) response_.mutable_heartbeat();
  else response_.mutable_progress();
  if (finishing) *response_.mutable_progress()->mutable_finishing() = ToProto(*finishing);
  if (!is_of_exports) return true;
  SetExports(exports, *response_.mutable_progress());
  exports_told_ = now;
  return true;
}

bool WatchStream::IsTimeToSay(Clock::time_point now) const {
  const MutexLock lock(mutex_);
  return now >= say_by_;
}

/// Counts all that the stream holds while its message is unsent, since a slow client holds it that long. The rest of
/// the page is dropped if it does not fit, and read again later.
bool WatchStream::TakeShare() {
  std::size_t own_bytes = 2 * response_.ByteSizeLong();
  if (messages_.has_next()) own_bytes += told_bytes_;
  std::size_t page_bytes = 0;
  for (std::size_t i = next_in_page_; i < page_.changes.size(); ++i) page_bytes += BytesOf(*page_.changes[i]);
  if (share_.Resize(own_bytes + page_bytes)) return true;
  page_.changes.clear();
  next_in_page_ = 0;
  return share_.Resize(own_bytes);
}

void WatchStream::Write() {
  if (response_.has_progress()) response_.mutable_progress()->set_revision(position_.revision);
  response_.set_position(PositionText(position_));
  last_said_ = position_.revision;
  if (!TakeShare()) return End(TooManyBytes());
  {
    const MutexLock lock(mutex_);
    const bool is_of_work = told_stage_ || has_told_exports_;
    say_by_ = Clock::now() + (is_of_work ? WorkProgressAfter() : progress_after_);
  }
  StartWrite(&response_);
}

}  // namespace dhpmap
