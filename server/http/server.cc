// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/server.h"

#include <algorithm>
#include <set>

#include "mapping/base/mutex.h"
#include "server/http/listener.h"
#include "server/http/session.h"

namespace dhpmap::http {
namespace {

constexpr std::chrono::seconds kAbortTimeout{5};

std::string HostOf(const std::string& address) {
  const auto authority = SplitAuthority(address);
  return authority ? std::string(authority->host) : std::string();
}

/// The open sessions. Thread-safe.
class SessionSet {
 public:
  /// Returns the number of sessions, including this one.
  std::size_t Add(const std::shared_ptr<Session>& session) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    sessions_.insert(session);
    if (is_draining_) session->Post([session] { session->Drain(); });
    return sessions_.size();
  }
  void Remove(Session* session) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    sessions_.erase(session->shared_from_this());
    if (sessions_.empty()) empty_.NotifyAll();
  }
  void Drain() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    is_draining_ = true;
    for (const auto& session : sessions_) session->Post([session] { session->Drain(); });
  }
  void Abort() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    for (const auto& session : sessions_) session->Post([session] { session->Abort(); });
  }
  /// Closes the session that has been idle longest. False if none is idle.
  bool CloseIdlest() DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    std::shared_ptr<Session> idlest;
    auto oldest = std::chrono::steady_clock::time_point::max();
    for (const auto& session : sessions_) {
      const auto since = session->idle_since();
      if (!since || *since >= oldest) continue;
      oldest = *since;
      idlest = session;
    }
    if (!idlest) return false;
    idlest->Post([idlest] { idlest->CloseIfIdle(); });
    return true;
  }
  bool WaitUntilEmpty(std::chrono::duration<double> timeout) DHPMAP_EXCLUDES(mutex_) {
    const MutexLock lock(mutex_);
    return empty_.WaitFor(mutex_, std::chrono::duration_cast<CondVar::Clock::duration>(timeout),
                          [this]() DHPMAP_REQUIRES(mutex_) { return sessions_.empty(); });
  }

 private:
  Mutex mutex_;
  CondVar empty_;
  std::set<std::shared_ptr<Session>> sessions_ DHPMAP_GUARDED_BY(mutex_);
  bool is_draining_ DHPMAP_GUARDED_BY(mutex_) = false;
};

}  // namespace

struct Server::Impl {
  Impl(const Handler& answering, const ServerOptions& options)
      : handler(answering),
        names(HostOf(options.address), options.allowed_hosts),
        max_connections(static_cast<std::size_t>(std::max(options.max_connections, 1))) {}

  void TakeIn(std::shared_ptr<Connection> connection) {
    auto session = std::make_shared<Session>(std::move(connection), handler, names,
                                             [this](Session* closed) { sessions.Remove(closed); });
    const bool is_too_many = sessions.Add(session) > max_connections;
    session->Start(is_too_many && !sessions.CloseIdlest());
  }

  const Handler& handler;
  const HostNames names;
  const std::size_t max_connections;
  SessionSet sessions;
  std::unique_ptr<Listener> listener;
};

Result<std::unique_ptr<Server>> Server::Start(const ServerOptions& options, const Handler& handler) {
  auto impl = std::make_unique<Impl>(handler, options);
  const ListenerOptions listener_options{.address = options.address,
                                         .sockets = options.sockets,
                                         .tls = options.tls,
                                         .max_connections = options.max_connections,
                                         .on_refused = options.on_refused,
                                         .num_threads = std::max(options.num_threads, 1),
                                         .idle_timeout = options.idle_timeout,
                                         .head_timeout = options.head_timeout};
  DHPMAP_ASSIGN_OR_RETURN(
      impl->listener,
      Listener::Start(
          listener_options,
          {.on_connection =
               [impl = impl.get()](std::shared_ptr<Connection> connection) { impl->TakeIn(std::move(connection)); },
           .on_no_descriptors = [impl = impl.get()] { return impl->sessions.CloseIdlest(); }}));
  return std::unique_ptr<Server>(new Server(std::move(impl)));
}

Server::Server(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Server::~Server() = default;

int Server::port() const { return impl_->listener->port(); }

bool Server::Shutdown(std::chrono::duration<double> grace) {
  impl_->listener->StopAccepting();
  impl_->sessions.Drain();
  if (impl_->sessions.WaitUntilEmpty(grace)) return true;
  impl_->sessions.Abort();
  return impl_->sessions.WaitUntilEmpty(kAbortTimeout);
}

}  // namespace dhpmap::http
