// SPDX-License-Identifier: BSD-3-Clause
#include "server/rest/gateway.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>

#include "server/rest/dispatcher.h"
#include "server/rest/http_server.h"
#include "server/rest/http_session.h"

namespace dhpmap {
namespace {

using rest::HttpSession;

constexpr std::chrono::seconds kCancelTimeout{5};

/// The open sessions. Thread-safe.
class SessionSet {
 public:
  void Add(const std::shared_ptr<HttpSession>& session) {
    const std::lock_guard lock(mutex_);
    sessions_.insert(session);
    if (draining_) session->Post([session] { session->Drain(); });
  }
  void Remove(HttpSession* session) {
    const std::lock_guard lock(mutex_);
    sessions_.erase(session->shared_from_this());
    if (sessions_.empty()) empty_.notify_all();
  }
  void Drain() {
    const std::lock_guard lock(mutex_);
    draining_ = true;
    for (const auto& session : sessions_) session->Post([session] { session->Drain(); });
  }
  void Abort() {
    const std::lock_guard lock(mutex_);
    for (const auto& session : sessions_) session->Post([session] { session->Abort(); });
  }
  bool WaitUntilEmpty(std::chrono::duration<double> timeout) {
    std::unique_lock lock(mutex_);
    return empty_.wait_for(lock, timeout, [this] { return sessions_.empty(); });
  }

 private:
  std::mutex mutex_;
  std::condition_variable empty_;
  std::set<std::shared_ptr<HttpSession>> sessions_;
  bool draining_ = false;
};

}  // namespace

struct Gateway::Impl {
  Impl(std::shared_ptr<grpc::Channel> channel, rest::HttpRuleRouter router, GatewayHooks hooks, std::size_t max_body)
      : caller(std::move(channel)), dispatcher(std::move(router), &caller, std::move(hooks), max_body) {}

  rest::RpcCaller caller;
  rest::Dispatcher dispatcher;
  SessionSet sessions;
  std::unique_ptr<rest::HttpServer> server;
  std::mutex shutdown_mutex;
  bool is_shut_down = false;
  bool is_stuck = false;  // something still refers to us
};

Result<std::unique_ptr<Gateway>> Gateway::Start(const GatewayOptions& options, std::shared_ptr<grpc::Channel> channel,
                                                GatewayHooks hooks) {
  DHPMAP_ASSIGN_OR_RETURN(rest::HttpRuleRouter router, rest::HttpRuleRouter::FromLinkedServices());
  auto impl = std::make_unique<Impl>(std::move(channel), std::move(router), std::move(hooks), options.max_body_bytes);
  DHPMAP_ASSIGN_OR_RETURN(impl->server,
                          rest::HttpServer::Start(options.address, std::max(options.num_threads, 1),
                                                  [impl = impl.get()](std::shared_ptr<rest::Connection> connection) {
                                                    auto session = std::make_shared<HttpSession>(
                                                        std::move(connection), impl->dispatcher,
                                                        [impl](HttpSession* closed) { impl->sessions.Remove(closed); });
                                                    impl->sessions.Add(session);
                                                    session->Start();
                                                  }));
  return std::unique_ptr<Gateway>(new Gateway(std::move(impl)));
}

Gateway::Gateway(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Gateway::~Gateway() {
  Shutdown(0);
  if (impl_->is_stuck) (void)impl_.release();  // a leak at the end of a server is better than a crash
}

int Gateway::port() const { return impl_->server->port(); }

void Gateway::Shutdown(double grace_s) {
  const std::lock_guard lock(impl_->shutdown_mutex);
  if (impl_->is_shut_down) return;
  impl_->is_shut_down = true;
  impl_->server->StopAccepting();
  impl_->sessions.Drain();
  if (!impl_->sessions.WaitUntilEmpty(std::chrono::duration<double>(grace_s))) {
    impl_->sessions.Abort();
    impl_->is_stuck = !impl_->sessions.WaitUntilEmpty(kCancelTimeout);
  }
  // Cancelled calls end at once on this side, but their last words still come through our threads.
  if (!impl_->caller.WaitUntilIdle(kCancelTimeout)) impl_->is_stuck = true;
}

}  // namespace dhpmap
