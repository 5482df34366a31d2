// SPDX-License-Identifier: BSD-3-Clause
#include "server/rest/callback_waker.h"

#include <grpcpp/client_context.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/generic/generic_stub.h>
#include <grpcpp/security/credentials.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace dhpmap::rest {
namespace {

constexpr std::chrono::milliseconds kPeriod{400};

/// A call that fails at once, without any network: its report is the event.
struct Nudge {
  grpc::ClientContext context;
  grpc::Slice nothing;
  grpc::ByteBuffer request{&nothing, 1};
  grpc::ByteBuffer response;
};

}  // namespace

struct CallbackWaker::Impl {
  Impl() : stub(grpc::CreateChannel("", nullptr)), thread([this] { Run(); }) {}

  void Run() {
    std::unique_lock lock(mutex);
    while (!changed.wait_for(lock, kPeriod, [this] { return stopping; })) {
      ++num_running;
      lock.unlock();
      auto nudge = std::make_shared<Nudge>();
      stub.UnaryCall(&nudge->context, "/none", {}, &nudge->request, &nudge->response,
                     [this, nudge](const grpc::Status&) {
                       const std::lock_guard ended(mutex);
                       --num_running;
                       changed.notify_all();
                     });
      lock.lock();
    }
    changed.wait(lock, [this] { return num_running == 0; });
  }

  grpc::GenericStub stub;  // of a channel that leads nowhere
  std::mutex mutex;
  std::condition_variable changed;
  bool stopping = false;
  int num_running = 0;
  std::thread thread;
};

CallbackWaker::CallbackWaker() : impl_(std::make_unique<Impl>()) {}

CallbackWaker::~CallbackWaker() {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->stopping = true;
    impl_->changed.notify_all();
  }
  impl_->thread.join();
}

}  // namespace dhpmap::rest
