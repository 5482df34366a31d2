// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/reflection_service.h"

#include <grpcpp/support/server_callback.h>

#include <utility>

#include "grpc/reflection/v1/reflection.grpc.pb.h"
#include "grpc/reflection/v1alpha/reflection.grpc.pb.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/reflection_answers.h"
#include "server/grpc/request_message.h"

namespace dhpmap {

namespace reflection_v1 = grpc::reflection::v1;
namespace reflection_v1alpha = grpc::reflection::v1alpha;

namespace {

/// A request is a name, and its answer repeats it.
constexpr std::size_t kMostAsked_bytes = 64u << 10;

Status TooMuchAsked(std::size_t num_bytes) {
  return ResourceExhausted("the message has " + std::to_string(num_bytes) + " bytes, more than " +
                           std::to_string(kMostAsked_bytes))
      .WithReason("BODY_TOO_LARGE");
}

using ServiceNames = std::shared_ptr<const std::vector<std::string>>;

/// A client's stream of questions. Both versions have the same wire format. The next question is read once the previous
/// answer is being written; between them only the stream itself takes memory. A question that is too large, malformed,
/// or does not fit into the budget ends the stream. Deletes itself when the call is over.
class ReflectionStream final
    : public grpc::ServerBidiReactor<grpc::ByteBuffer, reflection_v1::ServerReflectionResponse>,
      public OpenStream {
 public:
  static ReflectionStream* Start(const ServiceContext& context, OpenStreams& streams, ServiceNames services) {
    auto* stream = new ReflectionStream(context, streams, std::move(services));
    if (streams.Add(stream)) {
      stream->Read();
    } else {
      const MutexLock lock(stream->mutex_);
      stream->End(ShuttingDown());
    }
    return stream;
  }

  /// Reads no more, and ends with `reason` once what was read is answered.
  void Stop(const Status& reason) override DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    if (is_over_) return;
    reason_ = reason;
    if (is_reading_) End(reason);  // the present read is ignored
  }

  void OnReadDone(bool ok) override {
    {
      const MutexLock lock(mutex_);
      is_reading_ = false;
      if (is_over_) return;
      if (!ok) return End(Status::Ok());  // the client has half-closed
    }
    const Status taken = RunGuarded([this] { return Take(); });
    if (!taken.ok()) Fail(taken);
  }
  void OnWriteDone(bool ok) override {
    LetGo();
    if (ok) return Read();
    Fail(Cancelled("the client went away"));
  }
  void OnDone() override {
    streams_.Remove(this);
    delete this;
  }

 private:
  ReflectionStream(const ServiceContext& context, OpenStreams& streams, ServiceNames services)
      : context_(context),
        streams_(streams),
        services_(std::move(services)),
        record_(context, "ServerReflection/ServerReflectionInfo"),
        share_(&BudgetHere(*context.options.inflight)) {}

  void Read() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    if (is_over_) return;
    if (!reason_.ok()) return End(reason_);
    is_reading_ = true;
    StartRead(&incoming_);
  }

  void End(const Status& status) DHPMAP_REQUIRES(mutex_) {
    if (is_over_) return;
    is_over_ = true;
    record_.End(status);
    Finish(ToGrpc(status));
  }

  /// Ends the stream if there is no question or no answer; never during a read.
  void Fail(const Status& status) DHPMAP_EXCLUDES(mutex_) {
    LetGo();
    const MutexLock lock(mutex_);
    End(status);
  }

  void LetGo() {
    incoming_.Clear();
    response_ = {};  // Clear() would keep its memory
    share_.Release();
  }

  /// Parses what was read, if it fits into the budget, and answers it.
  Status Take() {
    if (incoming_.Length() > kMostAsked_bytes) return TooMuchAsked(incoming_.Length());
    DHPMAP_RETURN_IF_ERROR(ParseWithin(*context_.options.inflight, LayoutOf<reflection_v1::ServerReflectionRequest>(),
                                       incoming_, *response_.mutable_original_request(),
                                       [this](std::size_t num_bytes) { return share_.Resize(num_bytes); }));
    const auto task = std::make_shared<LaneTask>([this] { Answer(); });
    if (context_.lanes.quick.TryPost(task)) return Status::Ok();
    task->GiveUp();
    return TooBusy();
  }

  void Answer() {
    const Status status = RunGuarded([this] {
      AnswerReflection(*services_, response_);
      // As a message and as bytes.
      const bool has_room = share_.Resize(share_.bytes() + 2 * response_.ByteSizeLong());
      return has_room ? Status::Ok() : TooManyBytes();
    });
    if (!status.ok()) return Fail(status);
    const MutexLock lock(mutex_);
    StartWrite(&response_);
  }

  const ServiceContext& context_;
  OpenStreams& streams_;
  const ServiceNames services_;
  CallRecord record_;

  // Used by gRPC while it reads or writes, else by the task that answers.
  ByteShare share_;  ///< of both messages below; released last
  grpc::ByteBuffer incoming_;
  reflection_v1::ServerReflectionResponse response_;  ///< includes the request

  Mutex mutex_;
  bool is_reading_ DHPMAP_GUARDED_BY(mutex_) = false;
  bool is_over_ DHPMAP_GUARDED_BY(mutex_) = false;
  Status reason_ DHPMAP_GUARDED_BY(mutex_);  ///< not OK: reading has ended
};

template <typename Service, typename Request>
class ReflectionService final : public CountedService<Service> {
 public:
  using Call = typename CountedService<Service>::Context;

  ReflectionService(const ServiceContext& context, OpenStreams& streams, ServiceNames services)
      : CountedService<Service>(context), context_(context), streams_(streams), services_(std::move(services)) {
    this->template TakeStream<Request>(&ReflectionService::BeginStream);
  }

  grpc::ServerBidiReactor<grpc::ByteBuffer, reflection_v1::ServerReflectionResponse>* BeginStream(Call*) {
    return ReflectionStream::Start(context_, streams_, services_);
  }

 private:
  const ServiceContext& context_;
  OpenStreams& streams_;
  const ServiceNames services_;
};

}  // namespace

std::vector<std::unique_ptr<grpc::Service>> MakeReflectionServices(const ServiceContext& context, OpenStreams& streams,
                                                                   std::vector<std::string> services) {
  using V1 = reflection_v1::ServerReflection;
  using V1Alpha = reflection_v1alpha::ServerReflection;
  services.emplace_back(V1::service_full_name());
  services.emplace_back(V1Alpha::service_full_name());
  const auto names = std::make_shared<const std::vector<std::string>>(std::move(services));
  std::vector<std::unique_ptr<grpc::Service>> made;
  made.push_back(
      std::make_unique<ReflectionService<V1, reflection_v1::ServerReflectionRequest>>(context, streams, names));
  made.push_back(std::make_unique<ReflectionService<V1Alpha, reflection_v1alpha::ServerReflectionRequest>>(
      context, streams, names));
  return made;
}

}  // namespace dhpmap
