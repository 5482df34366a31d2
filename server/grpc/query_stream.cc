// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/query_stream.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <chrono>
#include <cstdint>
#include <string>

#include "proto/types/resource_names.h"
#include "proto/types/status_conversion.h"
#include "server/app/states/etag.h"
#include "server/grpc/check_answer.h"
#include "server/grpc/passing_time.h"
#include "server/grpc/query_answers.h"
#include "server/grpc/read_view.h"
#include "server/grpc/request_message.h"

namespace dhpmap {
namespace {

using WireFormat = google::protobuf::internal::WireFormatLite;

/// An answer is in memory as a message and as bytes while it is written. A small answer counts by its bytes alone,
/// although lists of messages take several times that.
std::size_t BytesOfAnswer(const v1::StreamQueriesResponse& response, const ByteBudget& budget) {
  const std::size_t num_bytes = response.ByteSizeLong();
  return 2 * num_bytes <= budget.free_bytes() ? 2 * num_bytes : num_bytes + response.SpaceUsedLong();
}

/// Reads the number of a message that may be too large to parse: 0 if it has none.
std::int64_t SequenceOf(const grpc::ByteBuffer& bytes) {
  grpc::ByteBuffer shared = bytes;
  grpc::ProtoBufferReader reader(&shared);
  google::protobuf::io::CodedInputStream input(&reader);
  std::uint64_t number = 0;
  while (const std::uint32_t tag = input.ReadTag()) {
    constexpr auto kTag =
        WireFormat::MakeTag(v1::StreamQueriesRequest::kSequenceFieldNumber, WireFormat::WIRETYPE_VARINT);
    if (!(tag == kTag ? input.ReadVarint64(&number) : WireFormat::SkipField(&input, tag))) break;
  }
  return static_cast<std::int64_t>(number);
}

Status NoQuery() { return InvalidArgument("the message holds no query").WithViolation("query", "is required"); }

}  // namespace

QueryStream* QueryStream::Start(const ServiceContext& context, Caller caller, OpenStreams& streams) {
  auto* stream = new QueryStream(context, std::move(caller), streams);
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
  if (is_reading_) End(reason);  // the present read is ignored
}

void QueryStream::Read() {
  const MutexLock lock(mutex_);
  if (is_over_) return;
  if (!reason_.ok()) return End(reason_);
  is_reading_ = true;
  StartRead(&incoming_);
}

/// A client that repeats a refused question at once would fill memory with it each time. So the stream reads on only
/// once a question like the last one fits; its room is reserved. Until then the question stays with the client.
void QueryStream::ReadLater() {
  constexpr std::chrono::milliseconds kPause{100};
  pause_ = std::make_unique<grpc::Alarm>();
  pause_->Set(GrpcTimeIn(kPause), [this](bool) {
    const Status posted = RunGuarded([this] {
      context_.lanes.quick.Post([this] { ReadIfThereIsRoom(); });
      return Status::Ok();
    });
    if (!posted.ok()) Read();
  });
}

void QueryStream::ReadIfThereIsRoom() {
  // The next question may be smaller, so the wait for the last answer's room ends after some pauses.
  constexpr int kMostPausesForAnswer = 10;
  const bool has_room = room_->Take(num_pauses_ < kMostPausesForAnswer ? wanted_bytes_ : question_bytes_);
  ++num_pauses_;
  if (!has_room && !stop_.stop_requested() && !IsToEnd()) return ReadLater();
  if (has_room) GiveRoomBackLater();
  Read();
}

void QueryStream::GiveRoomBackLater() {
  constexpr std::chrono::seconds kKeptForNext{1};
  pause_ = std::make_unique<grpc::Alarm>();
  pause_->Set(GrpcTimeIn(kKeptForNext), [ahead = std::weak_ptr(room_)](bool has_fired) {
    const auto room = ahead.lock();
    if (has_fired && room != nullptr) room->GiveBackUnused();
  });
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
    if (!ok) return End(Status::Ok());  // the client has half-closed
  }
  pause_.reset();  // the reserved room is used now
  response_.Clear();
  const Status taken = RunGuarded([this] { return TakeMessage(); });
  if (taken.ok()) return Handle();
  if (taken.code() != StatusCode::kInvalidArgument) return Answer(taken);
  const MutexLock lock(mutex_);
  End(taken);
}

Status QueryStream::TakeMessage() {
  response_.set_sequence(SequenceOf(incoming_));
  num_pauses_ = 0;
  wanted_bytes_ = question_bytes_ = incoming_.Length();
  DHPMAP_RETURN_IF_ERROR(
      ParseWithin(*budget_, LayoutOf<v1::StreamQueriesRequest>(), incoming_, request_, [this](std::size_t num_bytes) {
        wanted_bytes_ = num_bytes;
        return room_->Use(num_bytes);
      }));
  question_bytes_ = wanted_bytes_;
  return caller_.Check(request_);
}

void QueryStream::Handle() {
  switch (request_.query_case()) {
    case v1::StreamQueriesRequest::kQueryPoints:
      return Handle(request_.query_points(), *response_.mutable_query_points());
    case v1::StreamQueriesRequest::kQueryDistances:
      return Handle(request_.query_distances(), *response_.mutable_query_distances());
    case v1::StreamQueriesRequest::kCastRays: return Handle(request_.cast_rays(), *response_.mutable_cast_rays());
    case v1::StreamQueriesRequest::kQueryOccupancySlice:
      return Handle(request_.query_occupancy_slice(), *response_.mutable_query_occupancy_slice());
    case v1::StreamQueriesRequest::kSearchSubmaps:
      return Handle(request_.search_submaps(), *response_.mutable_search_submaps());
    case v1::StreamQueriesRequest::kQueryRelations:
      return Handle(request_.query_relations(), *response_.mutable_query_relations());
    case v1::StreamQueriesRequest::kCheckCollisions:
      return HandleCheck(request_.check_collisions(), *response_.mutable_check_collisions());
    case v1::StreamQueriesRequest::kCheckTrajectory:
      return HandleCheck(request_.check_trajectory(), *response_.mutable_check_trajectory());
    case v1::StreamQueriesRequest::kPin:
      return AnswerInLane(true, request_.pin().map(), [this] { return HandlePin(); });
    case v1::StreamQueriesRequest::QUERY_NOT_SET: return Answer(NoQuery());
  }
  Answer(NoQuery());
}

template <typename Request, typename Response>
void QueryStream::Handle(const Request& request, Response& response) {
  const QueryEffort effort = EffortOf(request);
  const bool can_fit = effort.answer_bytes <= budget_->limit_bytes();
  wanted_bytes_ = question_bytes_ + (can_fit && !effort.is_quick ? effort.answer_bytes : 0);
  if (!room_->Use(wanted_bytes_)) return Answer(TooManyBytes());
  AnswerInLane(effort.is_quick, request.map(), [this, is_quick = effort.is_quick, &request, &response]() -> Status {
    DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewOf(request));
    if (is_quick) return AnswerFromMap(context_, view, request, response, stop_.get_token());
    return WhileThereIsRoom(context_, view->shared_snapshot(), stop_.get_token(), [&](const std::stop_token& ended) {
      return AnswerFromMap(context_, view, request, response, ended);
    });
  });
}

template <typename Request, typename Response>
void QueryStream::HandleCheck(const Request& request, Response& response) {
  const QueryEffort effort = EffortOf(request);
  const bool can_fit = effort.answer_bytes <= budget_->limit_bytes();
  wanted_bytes_ = question_bytes_ + (can_fit && !effort.is_quick ? effort.answer_bytes : 0);
  if (!room_->Use(wanted_bytes_)) return Answer(TooManyBytes());
  const auto task = std::make_shared<LaneTask>([this, effort, &request, &response] {
    const Status begun = RunGuarded([&]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const auto view, ViewOf(request));
      DHPMAP_ASSIGN_OR_RETURN(auto check, CheckAnswer::Begin(context_, view, request, response));
      const CheckBegins begins = effort.is_quick ? CheckBegins::kQuickly : CheckBegins::kInLane;
      AnswerInPieces(context_, std::move(check), view->shared_snapshot(), begins, stop_.get_token(),
                     [this, num_items = effort.num_items](const Status& status) {
                       if (status.ok() && context_.observer.on_query) context_.observer.on_query(num_items);
                       Answer(status);
                     });
      return Status::Ok();
    });
    if (begun.ok()) return;
    if (effort.is_quick) return Answer(begun);
    context_.lanes.answers.Post([this, begun] { Answer(begun); });
  });
  if ((effort.is_quick ? QuickLane(context_, request.map(), request) : context_.lanes.checks).TryPost(task)) return;
  task->GiveUp();
  Answer(TooBusy());
}

template <typename Request>
Result<std::shared_ptr<const MapView>> QueryStream::ViewOf(const Request& request) {
  DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request.map(), "map"));
  const auto pinned = pin_.Of(map);
  if (!pinned.ok() && request.read_revision() == 0) return pinned.status();
  DHPMAP_ASSIGN_OR_RETURN(auto view, ViewFor(context_, map, request, pinned.ok() ? *pinned : nullptr));
  if (MinRevision(request) > view->snapshot().revision()) {
    return FailedPrecondition("the map, or what is pinned of it, is at an earlier revision")
        .WithViolation("options.min_revision", "is not reached: a stream does not wait for it");
  }
  DHPMAP_RETURN_IF_ERROR(CheckNotLost(MinRevision(request), *context_.registry.LostRevisionsOf(map),
                                      view->snapshot().info(), "options.min_revision"));
  return view;
}

void QueryStream::AnswerInLane(bool is_quick, std::string_view opens, const std::function<Status()>& work) {
  const auto task = std::make_shared<LaneTask>([this, is_quick, work] {
    const Status status = RunGuarded(work);
    if (is_quick) return Answer(status);
    context_.lanes.answers.Post([this, status] { Answer(status); });
  });
  if ((is_quick ? QuickLane(context_, opens, request_) : context_.lanes.bulk).TryPost(task)) return;
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
  DHPMAP_ASSIGN_OR_RETURN(auto view, ViewFor(context_, map, request_.pin()));
  response_.mutable_pin()->set_revision(view->snapshot().revision());
  pin_.Hold(std::move(map), std::move(view));
  return Status::Ok();
}

void QueryStream::Answer(const Status& status) {
  incoming_.Clear();
  request_ = v1::StreamQueriesRequest();  // frees it now; Clear() would keep unknown fields
  const bool has_room = !status.ok() || room_->Use(BytesOfAnswer(response_, *budget_));
  const Status outcome = has_room ? status : TooManyBytes();
  if (!outcome.ok()) {
    response_.clear_answer();
    room_->Release();
    *response_.mutable_error() = ToProto(outcome);
  }
  has_had_no_room_ = outcome.reason() == TooManyBytes().reason();
  const MutexLock lock(mutex_);
  StartWrite(&response_);
}

void QueryStream::OnWriteDone(bool ok) {
  response_.clear_answer();
  room_->Release();
  if (ok) return has_had_no_room_ ? ReadLater() : Read();
  const MutexLock lock(mutex_);
  End(Cancelled("the client went away"));
}

void QueryStream::OnDone() {
  streams_.Remove(this);
  delete this;
}

}  // namespace dhpmap
