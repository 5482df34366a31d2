// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/rpc_call.h"

#include <grpc/support/time.h>
#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/support/byte_buffer.h>

#include "mapping/base/mutex.h"
#include "server/gateway/callback_waker.h"

namespace dhpmap::gateway {
namespace {

using grpc::ByteBuffer;

/// The buffer owns the string; no copy.
ByteBuffer ToBuffer(std::string bytes) {
  auto* owned = new std::string(std::move(bytes));
  const grpc::Slice slice(
      owned->data(), owned->size(), [](void* string) { delete static_cast<std::string*>(string); }, owned);
  return ByteBuffer(&slice, 1);
}

std::string ToBytes(const ByteBuffer& buffer) {
  std::vector<grpc::Slice> slices;
  std::string bytes;
  if (!buffer.Valid() || !buffer.Dump(&slices).ok()) return bytes;
  bytes.reserve(buffer.Length());
  for (const grpc::Slice& slice : slices) bytes.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return bytes;
}

RpcStatus RpcStatusOf(const grpc::Status& status) {
  return {static_cast<int>(status.error_code()), status.error_message(), status.error_details()};
}

class CallCounter {
 public:
  void Add() {
    const MutexLock lock(mutex_);
    ++num_active_;
  }
  void Remove() {
    const MutexLock lock(mutex_);
    if (--num_active_ == 0) idle_.NotifyAll();
  }
  bool WaitUntilIdle(std::chrono::milliseconds timeout) {
    const MutexLock lock(mutex_);
    return idle_.WaitFor(mutex_, timeout, [this]() DHPMAP_REQUIRES(mutex_) { return num_active_ == 0; });
  }

 private:
  Mutex mutex_;
  CondVar idle_;
  int num_active_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

/// Counts itself while it lives. The first member of a call, so destroyed last.
class CountedCall {
 public:
  explicit CountedCall(std::shared_ptr<CallCounter> counter) : counter_(std::move(counter)) { counter_->Add(); }
  ~CountedCall() { counter_->Remove(); }
  CountedCall(const CountedCall&) = delete;
  CountedCall& operator=(const CountedCall&) = delete;

 private:
  std::shared_ptr<CallCounter> counter_;
};

/// By the monotonic clock, independent of changes of the system's clock.
gpr_timespec DeadlineIn(std::chrono::nanoseconds timeout) {
  return gpr_time_add(gpr_now(GPR_CLOCK_MONOTONIC), gpr_time_from_nanos(timeout.count(), GPR_TIMESPAN));
}

void Prepare(const CallOptions& options, grpc::ClientContext* context) {
  for (const auto& [key, value] : options.metadata) context->AddMetadata(key, value);
  if (options.timeout) context->set_deadline(DeadlineIn(*options.timeout));
}

struct GenericUnaryCall final : UnaryCall {
  explicit GenericUnaryCall(std::shared_ptr<CallCounter> counter) : counted(std::move(counter)) {}
  void Cancel() override { context.TryCancel(); }

  CountedCall counted;
  std::shared_ptr<const void> kept;
  grpc::ClientContext context;
  ByteBuffer request;
  ByteBuffer response;
};

class GenericStreamCall final : public StreamCall, public grpc::ClientBidiReactor<ByteBuffer, ByteBuffer> {
 public:
  GenericStreamCall(std::shared_ptr<CallCounter> counter, std::shared_ptr<StreamListener> listener)
      : counted_(std::move(counter)), listener_(std::move(listener)) {}

  /// `self` keeps this alive until gRPC has finished.
  void Start(grpc::GenericStub* stub, const CallOptions& options, std::shared_ptr<GenericStreamCall> self) {
    self_ = std::move(self);
    kept_ = options.kept;
    Prepare(options, &context_);
    stub->PrepareBidiStreamingCall(&context_, options.rpc_path, {}, this);
    AddHold();  // because reads and sends start outside of gRPC's callbacks
    StartCall();
  }

  void Read() override { StartRead(&incoming_); }
  void Send(std::string message) override {
    outgoing_ = ToBuffer(std::move(message));
    StartWrite(&outgoing_);
  }
  void SendEnd() override { StartWritesDone(); }
  void Finish() override { RemoveHold(); }
  void Cancel() override { context_.TryCancel(); }

  void OnReadDone(bool ok) override {
    if (ok) {
      listener_->OnMessage(ToBytes(incoming_));
    } else {
      listener_->OnReadEnd();
    }
  }
  void OnWriteDone(bool ok) override { listener_->OnSent(ok); }
  void OnDone(const grpc::Status& status) override {
    listener_->OnDone(RpcStatusOf(status));
    listener_.reset();
    const auto last = std::move(self_);
  }

 private:
  CountedCall counted_;
  std::shared_ptr<const void> kept_;
  std::shared_ptr<StreamListener> listener_;
  grpc::ClientContext context_;
  ByteBuffer incoming_;
  ByteBuffer outgoing_;
  std::shared_ptr<GenericStreamCall> self_;
};

}  // namespace

struct RpcCaller::Impl {
  explicit Impl(std::shared_ptr<grpc::Channel> channel) : stub(std::move(channel)) {}

  CallbackWaker waker;
  grpc::GenericStub stub;
  std::shared_ptr<CallCounter> counter = std::make_shared<CallCounter>();
};

RpcCaller::RpcCaller(std::shared_ptr<grpc::Channel> channel) : impl_(std::make_unique<Impl>(std::move(channel))) {}
RpcCaller::~RpcCaller() = default;

std::shared_ptr<UnaryCall> RpcCaller::StartUnary(const CallOptions& options, std::string request,
                                                 std::function<void(RpcStatus, std::string)> done) {
  auto call = std::make_shared<GenericUnaryCall>(impl_->counter);
  call->kept = options.kept;
  Prepare(options, &call->context);
  call->request = ToBuffer(std::move(request));
  impl_->stub.UnaryCall(&call->context, options.rpc_path, {}, &call->request, &call->response,
                        [call, done = std::move(done)](const grpc::Status& status) {
                          done(RpcStatusOf(status), status.ok() ? ToBytes(call->response) : std::string());
                        });
  return call;
}

std::shared_ptr<StreamCall> RpcCaller::StartStream(const CallOptions& options,
                                                   std::shared_ptr<StreamListener> listener) {
  auto call = std::make_shared<GenericStreamCall>(impl_->counter, std::move(listener));
  call->Start(&impl_->stub, options, call);
  return call;
}

bool RpcCaller::WaitUntilIdle(std::chrono::milliseconds timeout) { return impl_->counter->WaitUntilIdle(timeout); }

}  // namespace dhpmap::gateway
