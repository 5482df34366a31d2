// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/connection_acceptor.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
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
#include "server/net/address.h"
#include "server/net/open_sockets.h"
#include "server/net/reserve_descriptor.h"

namespace dhpmap::net {
namespace {

/// While the system has no memory or descriptors even for a refusal.
constexpr int kRetry_ms = 50;
/// Descriptors for the files of maps and for others' connections; of few, a quarter.
constexpr rlim_t kLeftToOthers = 32;
/// Connections; then it looks whether it is to stop.
constexpr int kAtATime = 64;

class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  [[nodiscard]] int get() const { return value_; }
  [[nodiscard]] int Release() { return std::exchange(value_, -1); }

 private:
  int value_;
};

bool Set(const Descriptor& socket, int level, int option, int value) {
  return ::setsockopt(socket.get(), level, option, &value, sizeof value) == 0;
}

/// An IPv6 socket is for IPv6 alone, but for the address that means every one of this machine.
bool IsForBothFamilies(const addrinfo& address) {
  return address.ai_family == AF_INET6 &&
         IN6_IS_ADDR_UNSPECIFIED(&reinterpret_cast<const sockaddr_in6*>(address.ai_addr)->sin6_addr);
}

/// Without a socket, errno says why.
Descriptor ListenOn(const addrinfo& address, bool is_alone) {
  Descriptor socket(::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (socket.get() < 0) return socket;
  Set(socket, SOL_SOCKET, SO_REUSEADDR, 1);
  Set(socket, IPPROTO_TCP, TCP_NODELAY, 1);  // what is accepted has it from here
  if (address.ai_family == AF_INET6) {
    Set(socket, IPPROTO_IPV6, IPV6_V6ONLY, is_alone && IsForBothFamilies(address) ? 0 : 1);
  }
  if (::bind(socket.get(), address.ai_addr, address.ai_addrlen) != 0 || ::listen(socket.get(), SOMAXCONN) != 0) {
    const int error = errno;
    socket = Descriptor();
    errno = error;
  }
  return socket;
}

/// Numbers are given out from below, so a high one says that there are few left.
bool IsOneOfTheLast(const Descriptor& socket) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return false;
  return static_cast<rlim_t>(socket.get()) >= limit.rlim_cur - std::min(kLeftToOthers, limit.rlim_cur / 4);
}

int PortOf(const Descriptor& socket) {
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  if (::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&name), &size) != 0) return 0;
  return ntohs(name.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(name).sin6_port
                                          : reinterpret_cast<const sockaddr_in&>(name).sin_port);
}

Result<std::vector<Descriptor>> ListenOnAll(const std::string& text) {
  DHPMAP_ASSIGN_OR_RETURN(const Address address, SplitAddress(text));
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(address.port);
  const int no_host =
      ::getaddrinfo(address.host.empty() ? nullptr : address.host.c_str(), port.c_str(), &hints, &found);
  if (no_host != 0) return InvalidArgument("'" + text + "' is no address: " + ::gai_strerror(no_host));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, ::freeaddrinfo);
  std::vector<Descriptor> sockets;
  int error = 0;
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    Descriptor socket = ListenOn(*one, found->ai_next == nullptr);
    if (socket.get() >= 0) {
      sockets.push_back(std::move(socket));
      if (address.port == 0) break;
    } else if (error = errno; error == EADDRINUSE) {  // of any: another server would get half of the clients
      break;
    }
  }
  if (sockets.empty() || error == EADDRINUSE) {
    return Unavailable("cannot listen on " + text + ": " + std::strerror(error));
  }
  return sockets;
}

}  // namespace

struct ConnectionAcceptor::Impl {
  Impl(std::vector<Descriptor> sockets, int most)
      : listeners(std::move(sockets)),
        port(PortOf(listeners.front())),
        stop(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
        open(most) {}

  void Run();
  /// Some of those who wait.
  void AcceptFrom(const Descriptor& listener);

  std::vector<Descriptor> listeners;
  const int port;
  const Descriptor stop;  // readable: the thread ends
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
          if (!is_refused) return;  // nobody waits: EMFILE comes first
          break;
        }
        [[fallthrough]];
      case ENOBUFS:
      case ENOMEM:
        (void)reserve.Fill();
        std::this_thread::sleep_for(std::chrono::milliseconds(kRetry_ms));
        return;
      case ECONNABORTED:  // gone before it was accepted
      case EINTR: break;
      default:  // of the network; asked again if somebody still waits
        return;
    }
  }
}

Result<std::unique_ptr<ConnectionAcceptor>> ConnectionAcceptor::Listen(const AcceptorOptions& options) {
  DHPMAP_ASSIGN_OR_RETURN(std::vector<Descriptor> listeners, ListenOnAll(options.address));
  auto impl = std::make_unique<Impl>(std::move(listeners), options.max_connections);
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
}

}  // namespace dhpmap::net
