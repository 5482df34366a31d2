// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/integrate_stream.h"

#include <utility>

#include "server/grpc/resource_names.h"
#include "server/ingest/frame_conversion.h"

namespace dhpmap {
namespace {

Status ShuttingDown() { return Unavailable("the server is shutting down").WithReason("SHUTTING_DOWN"); }

v1::IntegrateFramesResponse AckOf(std::int64_t sequence, const FrameOutcome& outcome) {
  v1::IntegrateFramesResponse ack;
  ack.set_sequence(sequence);
  ack.set_revision(outcome.revision);
  ack.set_committed(outcome.is_committed);
  ack.set_commit_error_code(static_cast<int>(outcome.commit_status.code()));
  ack.set_commit_error_message(outcome.commit_status.message());
  if (!outcome.report.ok()) {
    const Status& status = outcome.report.status();
    ack.set_error_code(static_cast<int>(status.code()));
    ack.set_error_message(status.message());
    for (const FieldViolation& violation : status.violations()) {
      ack.mutable_error_message()->append("; " + violation.field + ": " + violation.description);
    }
    ack.set_error_reason(status.reason());
    return ack;
  }
  const FrameReport& report = *outcome.report;
  ack.set_num_points(report.num_points);
  ack.set_num_unknown_points(report.num_unknown_points);
  ack.set_num_segments(report.num_segments);
  ack.set_num_matched(report.num_matched);
  ack.set_num_created(report.num_created);
  ack.set_fuse_s(report.total_s());
  return ack;
}

}  // namespace

void IntegrateStreams::StopAll() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
  for (IntegrateStream* stream : streams_) stream->Stop();
}

bool IntegrateStreams::Add(IntegrateStream* stream) {
  const std::lock_guard lock(mutex_);
  if (!is_stopped_) streams_.insert(stream);
  return !is_stopped_;
}

void IntegrateStreams::Remove(IntegrateStream* stream) {
  const std::lock_guard lock(mutex_);
  streams_.erase(stream);
}

IntegrateStream* IntegrateStream::Start(const ServiceContext& context, IntegrateStreams& streams) {
  auto* stream = new IntegrateStream(context, streams);
  stream->self_.reset(stream);
  if (!streams.Add(stream)) {
    stream->End(ShuttingDown());
    return stream;
  }
  const std::lock_guard lock(stream->mutex_);
  stream->ReadIfThereIsRoom();
  return stream;
}

void IntegrateStream::Stop() {
  const std::lock_guard lock(mutex_);
  EndReading(ShuttingDown());
}

void IntegrateStream::OnReadDone(bool ok) {
  {
    const std::lock_guard lock(mutex_);
    if (!ok || has_ended_reading_) {
      is_reading_ = false;
      EndReading(Status::Ok());
      return;
    }
    is_handling_ = true;
  }
  context_.pool.Post([self = self_] {
    const Status status = RunGuarded([&self] {
      self->HandleRequest();
      return Status::Ok();
    });
    const std::lock_guard lock(self->mutex_);
    self->is_reading_ = self->is_handling_ = false;
    if (!status.ok()) self->EndReading(status);
    self->ReadIfThereIsRoom();
    self->EndIfAllIsAcknowledged();
  });
}

void IntegrateStream::HandleRequest() {
  const Status open = OpenMap();
  if (!open.ok()) {
    const std::lock_guard lock(mutex_);
    EndReading(open);
    return;
  }
  std::shared_ptr<MapSession> session;
  {
    const std::lock_guard lock(mutex_);
    if (has_ended_reading_) return;
    ++num_in_flight_;
    session = session_;
  }
  Result<PanopticFrame> frame =
      request_.has_frame()
          ? FrameFromProto(request_.frame())
          : InvalidArgument("the message has no frame").WithReason("BAD_FRAME").WithViolation("frame", "is required");
  session->Integrate(std::move(frame), [self = self_, sequence = request_.sequence()](const FrameOutcome& outcome) {
    self->OnFrameDone(sequence, outcome);
  });
}

Status IntegrateStream::OpenMap() {
  if (session_ == nullptr) {  // only this thread writes to it until the stream ends
    DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request_.map(), "map"));
    DHPMAP_ASSIGN_OR_RETURN(auto session, context_.registry.OpenSession(name));
    DHPMAP_RETURN_IF_ERROR(session->BeginFeed());
    const std::lock_guard lock(mutex_);
    map_name_ = request_.map();
    session_ = std::move(session);
    return Status::Ok();
  }
  if (request_.map().empty() || request_.map() == map_name_) return Status::Ok();
  return InvalidArgument("one stream feeds one map: '" + map_name_ + "', not '" + request_.map().substr(0, 120) + "'")
      .WithReason("MAP_CHANGED")
      .WithViolation("map", "must be '" + map_name_ + "' or empty");
}

void IntegrateStream::OnFrameDone(std::int64_t sequence, const FrameOutcome& outcome) {
  if (context_.observer.on_frame) context_.observer.on_frame(outcome.report.status().code());
  Ack ack = AckOf(sequence, outcome);
  const std::lock_guard lock(mutex_);
  if (is_client_gone_) {
    --num_in_flight_;
    EndIfAllIsAcknowledged();
    return;
  }
  acks_.push_back(std::move(ack));
  if (is_writing_) return;
  is_writing_ = true;
  StartWrite(&acks_.front());
}

void IntegrateStream::OnWriteDone(bool ok) {
  const std::lock_guard lock(mutex_);
  is_writing_ = false;
  if (!ok) is_client_gone_ = true;
  if (is_client_gone_) {
    num_in_flight_ -= static_cast<int>(acks_.size());
    acks_.clear();
    EndReading(Cancelled("the client went away"));
    return;
  }
  acks_.pop_front();
  --num_in_flight_;
  if (!acks_.empty()) {
    is_writing_ = true;
    StartWrite(&acks_.front());
  }
  ReadIfThereIsRoom();
  EndIfAllIsAcknowledged();
}

void IntegrateStream::ReadIfThereIsRoom() {
  if (is_reading_ || has_ended_reading_ || num_in_flight_ >= context_.options.max_frames_in_flight) return;
  is_reading_ = true;
  StartRead(&request_);
}

void IntegrateStream::EndReading(const Status& reason) {
  if (!has_ended_reading_) end_status_ = reason;
  has_ended_reading_ = true;
  EndIfAllIsAcknowledged();
}

void IntegrateStream::EndIfAllIsAcknowledged() {
  if (!has_ended_reading_ || is_handling_ || num_in_flight_ > 0 || is_ending_) return;
  is_ending_ = true;
  // Not from here: the session may answer at once, and End takes the lock.
  context_.pool.Post([self = self_] {
    std::shared_ptr<MapSession> session;
    {
      const std::lock_guard lock(self->mutex_);
      session = self->session_;
    }
    if (session == nullptr) return self->End(Status::Ok());
    session->Flush([self](const Status& committed) { self->End(committed); });
  });
}

void IntegrateStream::End(const Status& committed) {
  std::shared_ptr<MapSession> session;
  Status status;
  {
    const std::lock_guard lock(mutex_);
    session = std::exchange(session_, nullptr);
    status = end_status_.ok() ? committed : end_status_;
  }
  if (session) session->EndFeed();  // before the client knows, so that it may start anew at once
  record_.End(status);
  Finish(ToGrpc(status));
}

void IntegrateStream::OnDone() {
  streams_.Remove(this);
  const auto last = std::move(self_);  // frees this, unless a callback still holds it
}

}  // namespace dhpmap
