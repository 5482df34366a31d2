// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/query_stream.h"

#include <chrono>
#include <string>

#include "server/app/etag.h"
#include "server/grpc/query_answers.h"
#include "server/wire/types/resource_names.h"
#include "server/wire/types/status_conversion.h"

namespace dhpmap {
namespace {

Status ShuttingDown() { return Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN"); }

Status NoQuery() { return InvalidArgument("the message holds no query").WithViolation("query", "is required"); }

}  // namespace

void QueryStreams::StopAll() {
  const MutexLock lock(mutex_);
  is_stopped_ = true;
  for (QueryStream* stream : streams_) stream->Stop(ShuttingDown());
}

bool QueryStreams::Add(QueryStream* stream) {
  const MutexLock lock(mutex_);
  if (!is_stopped_) streams_.insert(stream);
  return !is_stopped_;
}

void QueryStreams::Remove(QueryStream* stream) {
  const MutexLock lock(mutex_);
  streams_.erase(stream);
}

QueryStream* QueryStream::Start(const ServiceContext& context, QueryStreams& streams) {
  auto* stream = new QueryStream(context, streams);
  if (streams.Add(stream)) {
    stream->Read();
  } else {
    const MutexLock lock(stream->mutex_);
    stream->End(ShuttingDown());
  }
  return stream;
}

void QueryStream::Stop(const Status& reason) {
  const MutexLock lock(mutex_);
  if (is_over_) return;
  reason_ = reason;
  if (is_reading_) End(reason);  // what it reads now comes too late
}

void QueryStream::Read() {
  const MutexLock lock(mutex_);
  if (is_over_) return;
  if (!reason_.ok()) return End(reason_);
  is_reading_ = true;
  StartRead(&request_);
}

/// Who asks again at once, for what there is no room for, has each question in memory until it is refused: it is not
/// read, and so stays with the client, until there is room for one like the last.
void QueryStream::ReadLater() {
  constexpr std::chrono::milliseconds kPause{100};
  pause_ = std::make_unique<grpc::Alarm>();
  pause_->Set(std::chrono::system_clock::now() + kPause, [this](bool) {
    const Status posted = RunGuarded([this] {
      context_.lanes.quick.Post([this] { ReadIfThereIsRoom(); });
      return Status::Ok();
    });
    if (!posted.ok()) Read();
  });
}

void QueryStream::ReadIfThereIsRoom() {
  const bool has_room = share_.Resize(last_bytes_);
  share_.Release();
  if (has_room || stop_.stop_requested() || IsToEnd()) Read();
  else ReadLater();
}

bool QueryStream::IsToEnd() {
  const MutexLock lock(mutex_);
  return !reason_.ok();
}

void QueryStream::End(const Status& status) {
  if (is_over_) return;
  is_over_ = true;
  record_.End(status);
  Finish(ToGrpc(status));
}

void QueryStream::OnReadDone(bool ok) {
  {
    const MutexLock lock(mutex_);
    is_reading_ = false;
    if (is_over_) return;
    if (!ok) return End(Status::Ok());  // the client has no more
  }
  response_.Clear();
  response_.set_number(request_.number());
  Handle();
}

void QueryStream::Handle() {
  switch (request_.query_case()) {
    case v1::QueryStreamRequest::kQueryPoints:
      return Handle(request_.query_points(), *response_.mutable_query_points());
    case v1::QueryStreamRequest::kQueryDistances:
      return Handle(request_.query_distances(), *response_.mutable_query_distances());
    case v1::QueryStreamRequest::kCastRays: return Handle(request_.cast_rays(), *response_.mutable_cast_rays());
    case v1::QueryStreamRequest::kGetOccupancySlice:
      return Handle(request_.get_occupancy_slice(), *response_.mutable_get_occupancy_slice());
    case v1::QueryStreamRequest::kSearchSubmaps:
      return Handle(request_.search_submaps(), *response_.mutable_search_submaps());
    case v1::QueryStreamRequest::kListRelations:
      return Handle(request_.list_relations(), *response_.mutable_list_relations());
    case v1::QueryStreamRequest::kCheckCollisions:
      return Handle(request_.check_collisions(), *response_.mutable_check_collisions());
    case v1::QueryStreamRequest::kCheckTrajectory:
      return Handle(request_.check_trajectory(), *response_.mutable_check_trajectory());
    case v1::QueryStreamRequest::kPin: return AnswerInLane(true, request_.pin().map(), [this] { return HandlePin(); });
    case v1::QueryStreamRequest::QUERY_NOT_SET: return Answer(NoQuery());
  }
  Answer(NoQuery());
}

template <typename Request, typename Response>
void QueryStream::Handle(const Request& request, Response& response) {
  const QueryEffort effort = EffortOf(request);
  const bool can_fit = effort.answer_bytes <= context_.options.inflight->limit_bytes();
  if (!share_.Resize(request_.ByteSizeLong() + (can_fit && !effort.is_quick ? effort.answer_bytes : 0))) {
    return Answer(TooManyBytes());
  }
  AnswerInLane(effort.is_quick, request.map(), [this, is_quick = effort.is_quick, &request, &response]() -> Status {
    DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request.map(), "map"));
    DHPMAP_ASSIGN_OR_RETURN(auto view, pin_.Of(map));
    if (view == nullptr) {
      DHPMAP_ASSIGN_OR_RETURN(view, context_.registry.ViewOf(map));
    }
    if (MinRevision(request) > view->snapshot().revision()) {
      return FailedPrecondition("the map, or what is pinned of it, is at an earlier revision")
          .WithViolation("options.min_revision", "is not reached: a stream does not wait for it");
    }
    DHPMAP_RETURN_IF_ERROR(CheckNotLost(MinRevision(request), *context_.registry.LostRevisionsOf(map),
                                        view->snapshot().info(), "options.min_revision"));
    if (is_quick) return AnswerFromMap(context_, view, request, response, stop_.get_token());
    return WhileThereIsRoom(context_, view->shared_snapshot(), stop_.get_token(), [&](const std::stop_token& ended) {
      return AnswerFromMap(context_, view, request, response, ended);
    });
  });
}

void QueryStream::AnswerInLane(bool is_quick, std::string_view opens, const std::function<Status()>& work) {
  const auto task = std::make_shared<LaneTask>([this, is_quick, work] {
    const Status status = RunGuarded(work);
    if (is_quick) return Answer(status);
    context_.lanes.answers.Post([this, status] { Answer(status); });
  });
  if ((is_quick ? QuickLane(context_, opens) : context_.lanes.bulk).TryPost(task)) return;
  task->GiveUp();
  Answer(TooBusy());
}

Status QueryStream::HandlePin() {
  const std::string& name = request_.pin().map();
  if (name.empty()) {
    pin_.Release();
    response_.mutable_pin();
    return Status::Ok();
  }
  DHPMAP_ASSIGN_OR_RETURN(std::string map, ParseMapName(name, "pin.map"));
  DHPMAP_ASSIGN_OR_RETURN(auto view, context_.registry.ViewOf(map));
  response_.mutable_pin()->set_revision(view->snapshot().revision());
  pin_.Hold(std::move(map), std::move(view));
  return Status::Ok();
}

void QueryStream::Answer(const Status& status) {
  last_bytes_ = request_.ByteSizeLong();
  request_.clear_query();  // it is answered, and may be large
  const Status outcome = status.ok() && !share_.Resize(2 * response_.ByteSizeLong()) ? TooManyBytes() : status;
  if (!outcome.ok()) {
    response_.clear_answer();
    share_.Release();
    *response_.mutable_error() = ToProto(outcome);
  }
  has_had_no_room_ = outcome.reason() == TooManyBytes().reason();
  const MutexLock lock(mutex_);
  StartWrite(&response_);
}

void QueryStream::OnWriteDone(bool ok) {
  share_.Release();
  response_.clear_answer();
  if (ok) return has_had_no_room_ ? ReadLater() : Read();
  const MutexLock lock(mutex_);
  End(Cancelled("the client went away"));
}

void QueryStream::OnDone() {
  streams_.Remove(this);
  delete this;
}

}  // namespace dhpmap
