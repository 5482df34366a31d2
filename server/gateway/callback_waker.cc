// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/callback_waker.h"

#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/security/credentials.h>

#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#include "mapping/base/mutex.h"

namespace dhpmap::gateway {
namespace {

/// Runs a function on destruction.
class AtEnd {
 public:
  explicit AtEnd(std::function<void()> run) : run_(std::move(run)) {}
  ~AtEnd() { run_(); }
  AtEnd(const AtEnd&) = delete;
  AtEnd& operator=(const AtEnd&) = delete;

 private:
  std::function<void()> run_;
};

/// A call that fails at once without network; its end is the event. The last member destroyed reports it, so nothing of
/// a call remains on gRPC's threads when the waker is destroyed.
struct Nudge {
  explicit Nudge(std::function<void()> run) : at_end(std::move(run)) {}

  AtEnd at_end;
  grpc::ClientContext context;
  grpc::Slice nothing;
  grpc::ByteBuffer request{&nothing, 1};
  grpc::ByteBuffer response;
};

}  // namespace

struct CallbackWaker::Impl {
  explicit Impl(std::chrono::milliseconds time)
      : period(time), stub(grpc::CreateChannel("", nullptr)), thread([this] { Run(); }) {}

  void Run() {
    MutexLock lock(mutex);
    while (!changed.WaitFor(mutex, period, [this]() DHPMAP_REQUIRES(mutex) { return stopping; })) {
      is_running = true;
      lock.Unlock();
      auto nudge = std::make_shared<Nudge>([this] { Ended(); });
      stub.UnaryCall(&nudge->context, "/none", {}, &nudge->request, &nudge->response, [nudge](const grpc::Status&) {});
      nudge.reset();
      lock.Lock();
      changed.Wait(mutex, [this]() DHPMAP_REQUIRES(mutex) { return !is_running; });
    }
  }

  void Ended() {
    const MutexLock lock(mutex);
    is_running = false;
    ++num_events;
    changed.NotifyAll();
  }

  const std::chrono::milliseconds period;
  grpc::GenericStub stub;  // on a channel without a server
  Mutex mutex;
  CondVar changed;
  bool stopping DHPMAP_GUARDED_BY(mutex) = false;
  bool is_running DHPMAP_GUARDED_BY(mutex) = false;
  std::int64_t num_events DHPMAP_GUARDED_BY(mutex) = 0;
  std::thread thread;
};

CallbackWaker::CallbackWaker(std::chrono::milliseconds period) : impl_(std::make_unique<Impl>(period)) {}

CallbackWaker::~CallbackWaker() {
  {
    const MutexLock lock(impl_->mutex);
    impl_->stopping = true;
    impl_->changed.NotifyAll();
  }
  impl_->thread.join();
}

std::int64_t CallbackWaker::num_events() const {
  const MutexLock lock(impl_->mutex);
  return impl_->num_events;
}

}  // namespace dhpmap::gateway
