// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/integrate_stream.h"

#include <functional>
#include <new>
#include <utility>

#include "mapping/base/guarded.h"
#include "server/wire/frame_conversion.h"
#include "server/wire/mapping_conversion.h"
#include "server/wire/types/resource_names.h"

namespace dhpmap {
namespace {

Status ShuttingDown() { return Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN"); }

Status NoFrame() {
  return InvalidArgument("the message has no frame").WithReason("BAD_FRAME").WithViolation("frame", "is required");
}

Status Differs(const char* field, const std::string& first, const std::string& now) {
  const std::string wanted = first.empty() ? "empty" : "'" + first + "' or empty";
  return InvalidArgument("one stream feeds one map in one session: " + std::string(field) + " is now '" +
                         now.substr(0, 120) + "'")
      .WithViolation(field, "must be " + wanted + ", as in the first message");
}

}  // namespace

void IntegrateStreams::StopAll() {
  const MutexLock lock(mutex_);
  is_stopped_ = true;
  for (IntegrateStream* stream : streams_) stream->Stop(ShuttingDown());
}

bool IntegrateStreams::Add(IntegrateStream* stream) {
  const MutexLock lock(mutex_);
  if (!is_stopped_) streams_.insert(stream);
  return !is_stopped_;
}

void IntegrateStreams::Remove(IntegrateStream* stream) {
  const MutexLock lock(mutex_);
  streams_.erase(stream);
}

IntegrateStream* IntegrateStream::Start(const ServiceContext& context, IntegrateStreams& streams, Messages messages) {
  auto* stream = new IntegrateStream(context, streams, messages);
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
  const MutexLock lock(mutex_);
  StopReading(reason);
}

void IntegrateStream::OnReadDone(bool ok) {
  {
    const MutexLock lock(mutex_);
    StreamTurns::Todo todo;
    const bool is_to_be_handled = turns_.OnRead(ok, todo);
    Do(todo);
    if (!is_to_be_handled) return;
  }
  TakeRoomForRequest();
  context_.lanes.frames.Post([self = self_] {
    const Status status = RunGuarded([&self] {
      self->HandleRequest();
      return Status::Ok();
    });
    const MutexLock lock(self->mutex_);
    if (!status.ok()) self->StopReading(status);
    self->Do(self->turns_.OnHandled());
  });
}

void IntegrateStream::HandleRequest() {
  const auto place = PlaceForRequest();
  const std::int64_t sequence = request_.sequence();
  // What may fail for want of memory comes before the frame is counted, whose answer must come.
  const auto share = std::make_shared<ByteShare>(&streams_.frame_bytes_);
  std::function<void(const FrameOutcome&)> done = [self = self_, sequence, share](const FrameOutcome& outcome) {
    share->Release();
    self->OnFrameDone(sequence, outcome);
  };
  {
    const MutexLock lock(mutex_);
    if (!place.ok()) return StopReading(place.status());
    if (!turns_.OnAccepted()) return;
    if (messages_ == Messages::kOne) StopReading(Status::Ok());
  }
  const bool is_first = std::exchange(is_first_, false);
  if (is_first && !request_.has_frame() && !request_.session().empty()) {
    return place->map->Greet(place->feed, [self = self_, sequence](const FeedProgress& progress) {
      self->Answer(AnswerOf(sequence, progress));
    });
  }
  place->map->Integrate(place->feed, Decode(place->map->IsRecorded(), *share), std::move(done));
}

void IntegrateStream::TakeRoomForRequest() {
  num_bytes_ = request_.ByteSizeLong();
  // A row of the table of segments takes several times what it is on the wire. Not asked row by row on gRPC's thread.
  const auto num_rows = static_cast<std::size_t>(request_.frame().segments_size());
  has_no_room_ = !arrived_.Resize(num_bytes_ + num_rows * (sizeof(v1::Segment) + sizeof(void*)));
  if (has_no_room_) request_.clear_frame();
}

ArrivedFrame IntegrateStream::Decode(bool is_recorded, ByteShare& share) {
  std::string message;
  auto frame = Guarded<Result<PanopticFrame>>([&]() -> Result<PanopticFrame> {
    const std::size_t num_decoded_bytes = DecodedBytes(request_.frame()) + (is_recorded ? num_bytes_ : 0);
    if (has_no_room_ || !share.Resize(num_decoded_bytes)) return TooManyBytes();
    if (is_recorded) message = request_.SerializeAsString();
    return request_.has_frame() ? FrameFromProto(request_.frame()) : NoFrame();
  });
  request_.clear_frame();  // it is not kept while the stream waits
  arrived_.Release();
  return {.sequence = request_.sequence(),
          .frame = std::move(frame),
          .num_bytes = num_bytes_,
          .message = std::move(message)};
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
  DHPMAP_ASSIGN_OR_RETURN(auto map, context_.registry.OpenSession(name));
  DHPMAP_ASSIGN_OR_RETURN(auto feed,
                          map->BeginFeed({.session = request_.session(),
                                          .take_over = request_.take_over(),
                                          .on_evicted = [self = self_](const Status& why) { self->Stop(why); }}));
  const MutexLock lock(mutex_);  // nobody else has set it meanwhile: one message is handled at a time
  map_name_ = request_.map();
  place_ = Place{.map = std::move(map), .feed = std::move(feed)};
  return *place_;
}

void IntegrateStream::OnFrameDone(std::int64_t sequence, const FrameOutcome& outcome) {
  if (context_.observer.on_frame) context_.observer.on_frame(outcome.report.status().code());
  if (messages_ == Messages::kOne) {
    const MutexLock lock(mutex_);
    if (end_status_.ok()) end_status_ = InWireTerms(outcome.report.status());
  }
  Ack ack;
  TellSafely([&] { ack = AckOf(sequence, outcome); });
  if (ack.outcome() == v1::FRAME_OUTCOME_UNSPECIFIED) {  // no memory for its words: the feeder counts by the answers
    ack.set_sequence(sequence);
    ack.set_outcome(!outcome.report.ok() ? v1::REFUSED : outcome.is_duplicate ? v1::DUPLICATE : v1::FUSED);
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
  } catch (const std::bad_alloc&) {  // whoever counts on the answers is told that there are no more
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
  if (turns_.is_over()) {  // that was the last answer
    const Status status = end_status_;
    lock.Unlock();
    return Finish(ToGrpc(status));
  }
  acks_.pop_front();
  const int num_waiting = static_cast<int>(acks_.size());
  if (!ok) {
    acks_.clear();
    if (!turns_.has_stopped()) end_status_ = Cancelled("the client went away");
  }
  Do(turns_.OnWritten(ok, num_waiting));
}

void IntegrateStream::StopReading(const Status& reason) {
  if (!turns_.has_stopped()) end_status_ = reason;
  Do(turns_.OnStop());
}

void IntegrateStream::Do(StreamTurns::Todo todo) {
  if (todo.read) StartRead(&request_);
  if (todo.write) StartWrite(&acks_.front());
  // Not from here: the session may answer at once, and End takes the lock.
  if (todo.end) context_.lanes.frames.Post([self = self_] { self->CommitAndEnd(); });
}

void IntegrateStream::CommitAndEnd() {
  std::shared_ptr<MapSession> map;
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
    place->map->EndFeed(place->feed);  // before the client knows, so that it may start anew at once
  }
  record_.End(status);
  if (!is_owed) return Finish(ToGrpc(status));
  if (status.ok()) return StartWriteAndFinish(&conclusion_, grpc::WriteOptions(), grpc::Status::OK);
  StartWrite(&conclusion_);  // with an error gRPC would drop it; OnWriteDone finishes
}

void IntegrateStream::OnDone() {
  streams_.Remove(this);
  const auto last = std::move(self_);  // frees this, unless a callback still holds it
}

}  // namespace dhpmap
