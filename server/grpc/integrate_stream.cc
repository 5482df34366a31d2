// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/integrate_stream.h"

#include <grpcpp/support/proto_buffer_writer.h>

#include <functional>
#include <new>
#include <utility>

#include "mapping/base/guarded.h"
#include "proto/types/resource_names.h"
#include "server/grpc/buffer_outline.h"
#include "server/grpc/frame_message.h"
#include "server/grpc/map_quota.h"
#include "server/wire/frame_conversion.h"
#include "server/wire/mapping_conversion.h"

namespace dhpmap {
namespace {

Status ClientGone() { return Cancelled("the client went away"); }

Status NoFrame() {
  return InvalidArgument("the message has no frame").WithReason("BAD_FRAME").WithViolation("frame", "is required");
}

/// Replaces `bytes`. No write may be using them.
void WriteTo(grpc::ByteBuffer& bytes, const v1::IntegrateFramesResponse& answer) {
  grpc::ByteBuffer written;
  {
    const int num_bytes = static_cast<int>(answer.ByteSizeLong());
    grpc::ProtoBufferWriter writer(&written, num_bytes, num_bytes);
    answer.SerializeToZeroCopyStream(&writer);
  }
  bytes.Swap(&written);
}

/// Version 0.1 accepted colons in map names. As parts of paths they would be ambiguous.
Status CheckSessionName(const std::string& session) {
  if (session.find(':') == std::string::npos) return Status::Ok();
  return InvalidArgument("the name of the session is not usable")
      .WithReason("BAD_SESSION")
      .WithViolation("session", "1 to 64 of A-Z a-z 0-9 . _ -");
}

Status Differs(const char* field, const std::string& first, const std::string& now) {
  const std::string wanted = first.empty() ? "empty" : "'" + first + "' or empty";
  return InvalidArgument("one stream feeds one map in one session: " + std::string(field) + " is now '" +
                         now.substr(0, 120) + "'")
      .WithViolation(field, "must be " + wanted + ", as in the first message");
}

}  // namespace

IntegrateStream* IntegrateStream::Start(const ServiceContext& context, Caller caller, IntegrateStreams& streams,
                                        Messages messages) {
  auto* stream = new IntegrateStream(context, std::move(caller), streams, messages);
  stream->self_.reset(stream);
  if (!streams.Add(stream)) {
    stream->End(ShuttingDown());
    return stream;
  }
  const MutexLock lock(stream->mutex_);
  stream->Do(stream->turns_.OnStart());
  return stream;
}

void IntegrateStream::Stop(const Status& reason) {
  {
    const MutexLock lock(mutex_);
    StopReading(reason);
  }
  GiveUpDecoding(reason);  // the stream would not accept it any more
}

void IntegrateStream::OnCancel() {
  {
    const MutexLock lock(mutex_);
    is_cancelled_ = true;
  }
  GiveUpDecoding(ClientGone());
}

void IntegrateStream::OnReadDone(bool ok) {
  {
    const MutexLock lock(mutex_);
    StreamTurns::Todo todo;
    const bool is_to_be_handled = turns_.OnRead(ok, todo);
    Do(todo);
    if (!is_to_be_handled) return;
  }
  num_bytes_ = incoming_.Length();
  has_no_room_ = !arrived_.Resize(num_bytes_);
  bool loads = false;  // only frames of maps that are not open wait for the disk
  const Status parsed = RunGuarded([this, &loads] {
    DHPMAP_RETURN_IF_ERROR(ParseHead());
    loads = is_first_ && context_.registry.MustLoad(MapOfResource(request_.map()));
    return Status::Ok();
  });
  (loads ? context_.lanes.loads : context_.lanes.frames).Post([self = self_, parsed] {
    bool is_decoded_later = false;
    const Status begun = RunGuarded([&] { return parsed.ok() ? self->Begin(is_decoded_later) : parsed; });
    if (!is_decoded_later) self->EndMessage(begun);
  });
}

Status IntegrateStream::ParseHead() {
  auto head = ParseFrameHead(incoming_);
  if (has_no_room_ || !head.ok()) incoming_.Clear();
  if (!head.ok()) return head.status();
  has_frame_ = head->has_frame;
  request_.Swap(&head->message);
  if (!is_first_) request_.clear_take_over();  // has no meaning here, and must not require a permission
  return caller_.Check(request_);
}

Status IntegrateStream::Begin(bool& is_decoded_later) {
  {
    const MutexLock lock(mutex_);
    if (is_cancelled_) return ClientGone();  // load no map for a client that is gone
  }
  DHPMAP_ASSIGN_OR_RETURN(const Place place, PlaceForRequest());
  is_recorded_ = place.map->IsRecorded();
  room_ = std::make_shared<ByteShare>(&streams_.frame_bytes_);
  if (has_frame_ && !has_no_room_) {
    DHPMAP_RETURN_IF_ERROR(DecodeLater());
    is_decoded_later = true;
    return Status::Ok();
  }
  frame_ = has_no_room_ ? TooManyBytes() : NoFrame();
  HandleRequest();
  return Status::Ok();
}

Status IntegrateStream::DecodeLater() {
  const auto task = std::make_shared<LaneTask>([self = self_] {
    Status decoded = RunGuarded([&self] { return self->DecodeMessage(); });
    self->context_.lanes.frames.Post([self, decoded] {
      self->EndMessage(RunGuarded([&self, &decoded] {
        if (decoded.ok()) self->HandleRequest();
        return decoded;
      }));
    });
  });
  {
    const MutexLock lock(mutex_);
    if (is_cancelled_ || turns_.has_stopped()) return ClientGone();  // the first reason counts
    decoding_ = task;
  }
  context_.lanes.decoding.Post(task);
  return Status::Ok();
}

void IntegrateStream::EndMessage(const Status& status) {
  ForgetMessage();
  const MutexLock lock(mutex_);
  decoding_.reset();
  if (!status.ok()) StopReading(status);
  Do(turns_.OnHandled());
}

void IntegrateStream::GiveUpDecoding(const Status& why) {
  std::shared_ptr<LaneTask> task;
  {
    const MutexLock lock(mutex_);
    task = decoding_;
  }
  if (task != nullptr && task->GiveUp()) EndMessage(why);
}

void IntegrateStream::HandleRequest() {
  const auto place = PlaceForRequest();
  const std::int64_t sequence = request_.sequence();
  // Allocate before the frame is counted, because a counted frame must be answered.
  std::function<void(const FrameOutcome&)> done = [self = self_, sequence, room = room_](const FrameOutcome& outcome) {
    room->Release();
    self->OnFrameDone(sequence, outcome);
  };
  {
    const MutexLock lock(mutex_);
    if (!place.ok()) return StopReading(place.status());
    if (!turns_.OnAccepted()) return;
    if (messages_ == Messages::kOne) StopReading(Status::Ok());
  }
  const bool is_first = std::exchange(is_first_, false);
  if (is_first && !has_frame_ && !request_.session().empty()) {
    return place->map->Greet(place->feed, [self = self_, sequence](const FeedProgress& progress) {
      self->Answer(AnswerOf(sequence, progress));
    });
  }
  place->map->Integrate(place->feed, TakeFrame(), std::move(done));
}

Status IntegrateStream::DecodeMessage() {
  DHPMAP_RETURN_IF_ERROR(Parse());
  frame_ = Guarded<Result<PanopticFrame>>([this] { return DecodeFrame(); });
  request_.clear_frame();  // on this thread, since freeing a large table takes long
  (void)arrived_.Resize(incoming_.Length());
  return Status::Ok();
}

Status IntegrateStream::Parse() {
  DHPMAP_ASSIGN_OR_RETURN(const MessageOutline outline, OutlineOf(LayoutOf<v1::IntegrateFramesRequest>(), incoming_));
  // Some messages take many times their wire size: check before parsing.
  const std::size_t message_bytes = outline.message_bytes;
  has_no_room_ = !arrived_.Resize(num_bytes_ + message_bytes);
  if (!has_no_room_) {
    DHPMAP_ASSIGN_OR_RETURN(request_, ParseFrameMessage(incoming_));
  }
  if (is_recorded_ && !has_no_room_) return Status::Ok();
  incoming_.Clear();
  (void)arrived_.Resize(has_no_room_ ? 0 : message_bytes);
  return Status::Ok();
}

Result<PanopticFrame> IntegrateStream::DecodeFrame() {
  if (!has_no_room_) has_no_room_ = !room_->Resize(DecodedBytes(request_.frame()));
  if (has_no_room_) return TooManyBytes();
  return FrameFromProto(request_.frame());
}

ArrivedFrame IntegrateStream::TakeFrame() {
  std::string message;
  auto frame = Guarded<Result<PanopticFrame>>([&]() -> Result<PanopticFrame> {
    const bool is_kept = is_recorded_ && !has_no_room_;
    if (is_kept && !room_->Resize(room_->bytes() + num_bytes_)) return TooManyBytes();
    if (is_kept) message = TextOf(incoming_);
    return std::move(*frame_);
  });
  const std::int64_t sequence = request_.sequence();
  ForgetMessage();
  return {.sequence = sequence, .frame = std::move(frame), .num_bytes = num_bytes_, .message = std::move(message)};
}

void IntegrateStream::ForgetMessage() {
  incoming_.Clear();
  request_ = v1::IntegrateFramesRequest();  // Clear() would keep the strings' memory
  frame_.reset();
  room_.reset();
  arrived_.Release();
}

Result<IntegrateStream::Place> IntegrateStream::PlaceForRequest() {
  {
    const MutexLock lock(mutex_);
    if (place_) {
      DHPMAP_RETURN_IF_ERROR(CheckSamePlace());
      return *place_;
    }
  }
  return TakePlace();
}

Status IntegrateStream::CheckSamePlace() const {
  const std::string &map = request_.map(), &session = request_.session();
  if (!map.empty() && map != map_name_) return Differs("map", map_name_, map).WithReason("MAP_CHANGED");
  if (!session.empty() && session != place_->feed->session()) {
    return Differs("session", place_->feed->session(), session).WithReason("BAD_SESSION");
  }
  return Status::Ok();
}

Result<IntegrateStream::Place> IntegrateStream::TakePlace() {
  DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request_.map(), "map"));
  DHPMAP_RETURN_IF_ERROR(CheckSessionName(request_.session()));
  DHPMAP_ASSIGN_OR_RETURN(auto map, context_.registry.GetOpen(name));
  DHPMAP_RETURN_IF_ERROR(context_.quota.CheckFeed(map->View()->snapshot().info()));
  DHPMAP_ASSIGN_OR_RETURN(auto feed,
                          map->BeginFeed({.session = request_.session(),
                                          .take_over = request_.take_over(),
                                          .implausible = request_.refuse_implausible() ? ImplausibleFrames::kRefuse
                                                                                       : ImplausibleFrames::kFuse,
                                          .on_evicted = [self = self_](const Status& why) { self->Stop(why); }}));
  const MutexLock lock(mutex_);  // no other thread sets it: the stream handles one message at a time
  map_name_ = request_.map();
  place_ = Place{.map = std::move(map), .feed = std::move(feed)};
  return *place_;
}

void IntegrateStream::OnFrameDone(std::int64_t sequence, const FrameOutcome& outcome) {
  if (context_.observer.on_frame) context_.observer.on_frame(outcome.report.status().code());
  TellSafely([&] { LogOurFault("a frame", outcome.report.status()); });
  if (messages_ == Messages::kOne) {
    const MutexLock lock(mutex_);
    if (end_status_.ok()) end_status_ = InWireTerms(outcome.report.status());
  }
  Ack ack;
  TellSafely([&] { ack = AckOf(sequence, outcome); });
  if (ack.outcome() == v1::IntegrateFramesResponse::FRAME_OUTCOME_UNSPECIFIED) {
    // No memory for the full answer. The feeder counts answers, so it gets a short one.
    ack.set_sequence(sequence);
    ack.set_outcome(!outcome.report.ok()   ? v1::IntegrateFramesResponse::REFUSED
                    : outcome.is_duplicate ? v1::IntegrateFramesResponse::DUPLICATE
                                           : v1::IntegrateFramesResponse::FUSED);
  }
  Answer(std::move(ack));
}

void IntegrateStream::Answer(Ack ack) {
  const MutexLock lock(mutex_);
  if (IsLastAnswer()) {
    last_ = std::move(ack);
    is_kept_ = true;
    return Do(turns_.OnSettled());
  }
  last_.set_sequence(ack.sequence());
  try {
    acks_.push_back(std::move(ack));
  } catch (const std::bad_alloc&) {  // end the stream, since an answer is missing
    StopReading(OutOfMemory());
    return Do(turns_.OnSettled());
  }
  StreamTurns::Todo todo;
  if (!turns_.OnAcknowledged(todo)) acks_.pop_back();
  Do(todo);
}

bool IntegrateStream::IsLastAnswer() const {
  if (messages_ == Messages::kOne) return true;
  return turns_.IsAtLastFrame() && end_status_.ok() && place_->feed->session().empty();
}

void IntegrateStream::OnWriteDone(bool ok) {
  MutexLock lock(mutex_);
  if (turns_.is_over()) {  // the last answer is written
    const Status status = end_status_;
    lock.Unlock();
    return Finish(ToGrpc(status));
  }
  acks_.pop_front();
  const int num_waiting = static_cast<int>(acks_.size());
  if (!ok) {
    acks_.clear();
    if (!turns_.has_stopped()) end_status_ = ClientGone();
  }
  Do(turns_.OnWritten(ok, num_waiting));
}

void IntegrateStream::StopReading(const Status& reason) {
  if (!turns_.has_stopped()) end_status_ = reason;
  Do(turns_.OnStop());
}

void IntegrateStream::Do(StreamTurns::Todo todo) {
  if (todo.read) StartRead(&incoming_);
  if (todo.write) {
    WriteTo(outgoing_, acks_.front());
    StartWrite(&outgoing_);
  }
  // On a lane: the session may answer at once, and End takes the lock.
  if (todo.end) context_.lanes.frames.Post([self = self_] { self->CommitAndEnd(); });
}

void IntegrateStream::CommitAndEnd() {
  std::shared_ptr<OpenMap> map;
  {
    const MutexLock lock(mutex_);
    if (place_) map = place_->map;
  }
  if (map == nullptr) return End(Status::Ok());
  const Status asked = Guarded<Status>([&] {
    map->Flush([self = self_](const Status& committed) { self->End(committed); });
    return Status::Ok();
  });
  if (!asked.ok()) End(asked);
}

void IntegrateStream::End(const Status& committed) {
  std::optional<Place> place;
  Status status;
  bool is_owed = false;
  {
    const MutexLock lock(mutex_);
    place = std::exchange(place_, std::nullopt);
    if (end_status_.ok()) end_status_ = committed;
    status = end_status_;
    conclusion_ = last_;
    const bool is_heard = place && turns_.outlet() != StreamTurns::Outlet::kBroken;
    is_owed = is_heard &&
              (status.ok() ? is_kept_ || !place->feed->session().empty() : is_kept_ && messages_ == Messages::kAny);
  }
  if (place) {
    SetProgress(place->map->ProgressOf(place->feed), conclusion_);
    if (status.ok()) conclusion_.set_committed(true);
    place->map->EndFeed(place->feed);  // before the client knows, so that it may start again at once
  }
  record_.End(status);
  if (!is_owed) return Finish(ToGrpc(status));
  WriteTo(outgoing_, conclusion_);
  if (status.ok()) return StartWriteAndFinish(&outgoing_, grpc::WriteOptions(), grpc::Status::OK);
  StartWrite(&outgoing_);  // with an error gRPC would drop it; OnWriteDone finishes
}

void IntegrateStream::OnDone() {
  streams_.Remove(this);
  const auto last = std::move(self_);  // frees this, unless a callback still holds it
}

}  // namespace dhpmap
