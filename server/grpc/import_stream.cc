// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/import_stream.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "server/grpc/passing_time.h"
#include "server/grpc/request_message.h"
#include "server/wire/map_conversion.h"

namespace dhpmap {
namespace {

Status GoneAway() { return Cancelled("the client went away"); }

Status Silent(double seconds) {
  return {StatusCode::kDeadlineExceeded,
          "the file comes too slowly, " + std::to_string(seconds) + " s behind 16 KiB/s: what had come is let go"};
}

Status OtherMap() {
  return InvalidArgument("one stream brings one map")
      .WithReason("MAP_CHANGED")
      .WithViolation("map_id", "must be empty, or as in the first message");
}

}  // namespace

ImportStream* ImportStream::Start(const ServiceContext& context, Caller caller, v1::ImportMapResponse* response) {
  auto* stream = new ImportStream(context, std::move(caller), response);
  stream->self_.reset(stream);
  {
    const MutexLock lock(stream->mutex_);
    stream->Watch(
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(context.options.import_idle_s)));
  }
  stream->Read();
  return stream;
}

void ImportStream::Read() {
  const MutexLock lock(mutex_);
  if (is_over_) return;
  is_reading_ = true;
  lag_.Wait(Clock::now());
  StartRead(&arrived_);
}

void ImportStream::Watch(Clock::duration after) {
  // A new alarm each time: the one that has just fired is still in use.
  alarm_ = std::make_unique<grpc::Alarm>();
  alarm_->Set(GrpcTimeIn(after), [stream = std::weak_ptr(self_)](bool has_fired) {
    const auto self = stream.lock();
    if (has_fired && self != nullptr) self->OnAlarm();
  });
}

void ImportStream::OnAlarm() {
  const double idle_s = context_.options.import_idle_s;
  const auto idle = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(idle_s));
  {
    const MutexLock lock(mutex_);
    if (is_over_) return;
    if (!is_reading_) return Watch(idle);
    const Clock::duration behind = lag_.WhileWaiting(Clock::now());
    if (behind < idle) return Watch(std::max<Clock::duration>(idle - behind, std::chrono::milliseconds(1)));
    is_over_ = true;  // the present read is ignored
  }
  LetGo(Silent(idle_s));
}

void ImportStream::OnReadDone(bool ok) {
  {
    const MutexLock lock(mutex_);
    is_reading_ = false;
    if (is_over_) return;
    lag_.Hear(ok ? arrived_.Length() : 0, Clock::now());
  }
  if (stop_.stop_requested()) return End(GoneAway());
  if (!ok) {  // the upload is complete, or the client is gone, which OnCancel handles
    context_.lanes.bulk.Post([self = self_] { self->Prepare(); });
    return;
  }
  if (const Status taken = RunGuarded([this] { return TakeMessage(); }); !taken.ok()) return End(taken);
  const auto take = std::make_shared<LaneTask>([self = self_] {
    const Status status = RunGuarded([&] { return self->TakePart(); });
    self->context_.lanes.answers.Post([self, status] {
      if (status.ok()) self->Read();
      else self->End(status);
    });
  });
  if (incoming_ != nullptr) return context_.lanes.bulk.Post(take);  // one task per stream, and few streams are admitted
  if (context_.lanes.bulk.TryPost(take)) return;
  take->GiveUp();
  End(TooBusy());
}

Status ImportStream::TakeMessage() {
  request_ = v1::ImportMapRequest();
  return ParseWithin(share_.budget(), LayoutOf<v1::ImportMapRequest>(), arrived_, request_,
                     [this](std::size_t num_bytes) { return share_.Resize(std::max(kKept_bytes, num_bytes)); });
}

Status ImportStream::TakePart() {
  if (stop_.stop_requested()) return GoneAway();
  if (incoming_ == nullptr) {
    DHPMAP_RETURN_IF_ERROR(caller_.Check(request_));
    DHPMAP_ASSIGN_OR_RETURN(making_, context_.quota.Begin(caller_));
    map_id_ = request_.map_id();
    ImportRequest import = ImportRequestFromProto(request_);
    import.check_name = [caller = caller_](const std::string& name) { return caller.CheckMap(name);
  };
  DHPMAP_ASSIGN_OR_RETURN(incoming_, context_.registry.BeginImport(std::move(import)));
}
else if (!request_.map_id().empty() && request_.map_id() != map_id_) {
  return OtherMap();
}
return incoming_->Write(request_.data());
}  // namespace dhpmap

void ImportStream::Prepare() {
  const Status status = RunGuarded([this]() -> Status {
    if (incoming_ == nullptr) {
      return InvalidArgument("nothing was sent").WithReason("BAD_MAP").WithViolation("data", "is required");
    }
    if (stop_.stop_requested()) return GoneAway();
    return incoming_->Prepare(stop_.get_token());
  });
  if (status.ok()) return context_.lanes.quick.Post([self = self_] { self->Show(); });
  context_.lanes.answers.Post([self = self_, status] { self->End(status); });
}

void ImportStream::Show() {
  End(RunGuarded([this]() -> Status {
    if (stop_.stop_requested()) return GoneAway();
    DHPMAP_ASSIGN_OR_RETURN(const MapSummary map, incoming_->Show());
    if (making_ != nullptr) making_->Done(map);
    *response_->mutable_map() = ToProto(map);
    response_->set_revision(map.info.revision);
    return Status::Ok();
  }));
}

void ImportStream::OnCancel() { stop_.request_stop(); }

void ImportStream::End(const Status& status) {
  {
    const MutexLock lock(mutex_);
    if (std::exchange(is_over_, true)) return;
  }
  LetGo(status);
}

void ImportStream::LetGo(const Status& status) {
  context_.lanes.bulk.Post([self = self_, status] {
    self->incoming_.reset();
    self->making_.reset();
    self->context_.lanes.answers.Post([self, status] {
      self->record_.End(status);
      self->Finish(ToGrpc(status));
    });
  });
}

void ImportStream::OnDone() {
  std::unique_ptr<grpc::Alarm> alarm;
  {
    const MutexLock lock(mutex_);
    alarm = std::move(alarm_);
  }
  alarm.reset();
  const auto last = std::move(self_);
}

}  // namespace dhpmap
