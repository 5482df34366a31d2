// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/connection_acceptor.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/base/this_thread.h"
#include "server/net/descriptor.h"
#include "server/net/listening.h"
#include "server/net/open_sockets.h"
#include "server/net/reserve_descriptor.h"

namespace dhpmap::net {
namespace {

/// Wait while the system lacks memory or descriptors even for a refusal.
constexpr int kRetry_ms = 50;
/// Descriptors to leave for map files and others' connections; at most a quarter of the limit.
constexpr rlim_t kLeftToOthers = 32;
/// Connections to accept before the stop signal is checked again.
constexpr int kAtATime = 64;

/// Descriptors are assigned from the lowest, so a high number means that few are left.
bool IsOneOfTheLast(const Descriptor& socket) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return false;
  return static_cast<rlim_t>(socket.get()) >= limit.rlim_cur - std::min(kLeftToOthers, limit.rlim_cur / 4);
}

}  // namespace

struct ConnectionAcceptor::Impl {
  Impl(Listening listening, int most)
      : listeners(std::move(listening.sockets)),
        port(listening.port),
        path(std::move(listening.path)),
        stop(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
        open(most) {}

  void Run();
  /// Accepts some of the pending connections.
  void AcceptFrom(const Descriptor& listener);

  std::vector<Descriptor> listeners;
  const int port;
  std::string path;       // file of a unix: address
  const Descriptor stop;  // readable when the thread must end
  OpenSockets open;
  ReserveDescriptor reserve;
  std::function<void(int)> take;
  std::thread thread;
};

void ConnectionAcceptor::Impl::Run() {
  NameThisThread("accept");
  (void)TakeTurns(Turns::kShort);
  std::vector<pollfd> waiting;
  for (const Descriptor& listener : listeners)
    waiting.push_back({.fd = listener.get(), .events = POLLIN, .revents = 0});
  waiting.push_back({.fd = stop.get(), .events = POLLIN, .revents = 0});
  while (true) {
    if (::poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kRetry_ms));
      continue;
    }
    if (waiting.back().revents != 0) return;
    for (const Descriptor& listener : listeners) AcceptFrom(listener);
  }
}

void ConnectionAcceptor::Impl::AcceptFrom(const Descriptor& listener) {
  for (int i = 0; i < kAtATime; ++i) {
    Descriptor socket(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (socket.get() >= 0) {
      if (!IsOneOfTheLast(socket) && open.Add(socket.get())) take(socket.Release());
      continue;
    }
    switch (errno) {
      case EAGAIN: return;
      case EMFILE:
      case ENFILE:
        if (reserve.Use()) {
          const bool is_refused = Descriptor(::accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC)).get() >= 0;
          reserve.Fill();
          if (!is_refused) return;  // nothing is pending: EMFILE takes precedence
          break;
        }
        [[fallthrough]];
      case ENOBUFS:
      case ENOMEM:
        (void)reserve.Fill();
        std::this_thread::sleep_for(std::chrono::milliseconds(kRetry_ms));
        return;
      case ECONNABORTED:  // closed before it was accepted
      case EINTR: break;
      default:  // a network error; retried if a connection still waits
        return;
    }
  }
}

Result<std::unique_ptr<ConnectionAcceptor>> ConnectionAcceptor::Listen(const AcceptorOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(Listening listening,
                          options.sockets.empty() ? ListenOn(options.address) : ListenOnInherited(options.sockets));
  auto impl = std::make_unique<Impl>(std::move(listening), options.max_connections);
  if (impl->stop.get() < 0)
    return Unavailable(std::string("no file descriptor to begin with: ") + std::strerror(errno));
  return std::unique_ptr<ConnectionAcceptor>(new ConnectionAcceptor(std::move(impl)));
}

ConnectionAcceptor::ConnectionAcceptor(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

ConnectionAcceptor::~ConnectionAcceptor() { Stop(); }

int ConnectionAcceptor::port() const { return impl_->port; }

void ConnectionAcceptor::Start(std::function<void(int socket)> take) {
  impl_->take = std::move(take);
  impl_->thread = std::thread([impl = impl_.get()] { impl->Run(); });
}

void ConnectionAcceptor::Stop() {
  if (impl_->thread.joinable()) {
    ::eventfd_write(impl_->stop.get(), 1);
    impl_->thread.join();
  }
  impl_->listeners.clear();
  if (!impl_->path.empty()) ::unlink(std::exchange(impl_->path, {}).c_str());
}

}  // namespace dhpmap::net
