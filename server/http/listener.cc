// SPDX-License-Identifier: BSD-3-Clause
#include "server/http/listener.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <chrono>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "mapping/base/this_thread.h"
#include "server/http/request_parser.h"
#include "server/net/address.h"
#include "server/net/door.h"
#include "server/net/refusal.h"
#include "server/net/reserve_descriptor.h"
#include "server/net/socket_names.h"

namespace dhpmap::http {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using beast::error_code;
/// A TCP connection, or the inner end of one that came through a net::Door.
using AnyStream = asio::generic::stream_protocol;
using Socket = AnyStream::socket;

constexpr std::chrono::seconds kProgressTimeout{60};   // without progress of a body or an answer
constexpr std::chrono::milliseconds kFirstProbe{100};  // after a half-close: most answers are ready before
constexpr std::chrono::seconds kNextProbe{1};
// Detects a dead peer or network after some 25 s of silence, also while nothing is written.
constexpr int kFirstKeepalive_s = 10, kNextKeepalive_s = 5, kNumKeepalives = 3;
constexpr std::size_t kFirstRead_bytes = 4u << 10;
constexpr std::size_t kReadSize_bytes = 64u << 10;

void KeepAlive(int socket) {
  const auto set = [socket](int level, int option, int value) {
    (void)setsockopt(socket, level, option, &value, sizeof value);
  };
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, kFirstKeepalive_s);
  set(IPPROTO_TCP, TCP_KEEPINTVL, kNextKeepalive_s);
  set(IPPROTO_TCP, TCP_KEEPCNT, kNumKeepalives);
}

/// The outcome of a failed read.
ReadOutcome OutcomeOf(const error_code& error) {
  return error == beast::error::timeout ? ReadOutcome::kTimedOut : ReadOutcome::kClosed;
}

class BeastConnection final : public Connection, public std::enable_shared_from_this<BeastConnection> {
 public:
  BeastConnection(Socket socket, const ListenerOptions& options, net::PeerIdentity peer, std::string local_address)
      : peer_(std::move(peer)),
        local_address_(std::move(local_address)),
        idle_timeout_(std::chrono::duration_cast<Clock::duration>(options.idle_timeout)),
        head_timeout_(std::chrono::duration_cast<Clock::duration>(options.head_timeout)),
        stream_(std::move(socket)),
        probe_timer_(stream_.get_executor()),
        buffer_(RequestParser::kMaxHead_bytes + kReadSize_bytes) {
    error_code ignored;
    stream_.socket().set_option(tcp::no_delay(true), ignored);
    stream_.socket().non_blocking(true, ignored);  // else peeking might block
    KeepAlive(stream_.socket().native_handle());
  }

  void Start(std::shared_ptr<ConnectionEvents> events) override {
    events_ = std::move(events);
    ReadHead();
  }

  void ReadHead() override {
    parser_ = RequestParser();
    if (buffer_.size() > 0) return Later([](BeastConnection& self) { self.BeginHead(); });
    stream_.expires_after(idle_timeout_);
    ReadSome(
        kFirstRead_bytes, [](BeastConnection& self) { self.BeginHead(); },
        [](BeastConnection& self, ReadOutcome outcome) { self.HeadFailed(outcome); });
  }

  void ReadBody() override {
    body_.resize(kReadSize_bytes);
    stream_.expires_after(kProgressTimeout);
    if (buffer_.size() > 0) return Later([](BeastConnection& self) { self.ParseBody(); });
    ReadMoreBody();
  }

  void Write(std::string first, std::string second) override {
    probe_.clear();
    probe_timer_.cancel();
    first_ = std::move(first);
    second_ = std::move(second);
    to_write_ = {asio::buffer(first_), asio::buffer(second_)};
    WriteSome();
  }

  void WatchPeer(std::string probe) override {
    if (buffer_.size() > 0) return;  // the next request has arrived: the client has not half-closed
    probe_ = std::move(probe);
    watching_ = true;
    const int watch = ++watch_;
    stream_.socket().async_wait(tcp::socket::wait_read, [self = shared_from_this(), watch](error_code error) {
      if (error || watch != self->watch_ || !self->events_) return;
      char byte = 0;
      const std::size_t size = self->stream_.socket().receive(asio::buffer(&byte, 1), tcp::socket::message_peek, error);
      if (error == asio::error::eof || (!error && size == 0)) return self->PeerEnded(watch);
      if (error && error != asio::error::would_block) return self->events()->OnPeerClosed();
    });
  }

  void StopWatching() override {
    if (!watching_) return;
    watching_ = false;
    ++watch_;
    probe_timer_.cancel();
    error_code ignored;
    stream_.socket().cancel(ignored);
  }

  void CloseSending() override {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  void Close() override {
    events_.reset();
    probe_timer_.cancel();
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_both, ignored);
    stream_.close();
  }

  std::string local_address() const override { return local_address_; }
  net::PeerIdentity peer() const override { return peer_; }

  void Post(std::function<void()> task) override { asio::post(stream_.get_executor(), std::move(task)); }

 private:
  using Clock = std::chrono::steady_clock;

  /// Posts `work` instead of calling it: answers to many small parts would nest and exhaust the stack.
  template <typename Work>
  void Later(Work work) {
    Post([self = shared_from_this(), work] {
      if (self->events_) work(*self);
    });
  }

  /// Calls `done` or `failed`, unless the connection was closed meanwhile.
  template <typename Done, typename Failed>
  void ReadSome(std::size_t num_bytes, Done done, Failed failed) {
    stream_.async_read_some(buffer_.prepare(num_bytes),
                            [self = shared_from_this(), done, failed](error_code error, std::size_t size) {
                              if (!self->events_) return;
                              self->buffer_.commit(size);
                              if (error) failed(*self, OutcomeOf(error));
                              else done(*self);
                            });
  }

  [[nodiscard]] std::string_view Unread() const {
    return {static_cast<const char*>(buffer_.data().data()), buffer_.size()};
  }

  void BeginHead() {
    stream_.expires_after(head_timeout_);
    ParseHead();
  }

  void ParseHead() {
    RequestParser::HeadStep step = parser_.AddHead(Unread());
    buffer_.consume(step.num_used);
    if (step.is_complete) return events()->OnHead(std::move(step.head));
    ReadSome(
        kFirstRead_bytes, [](BeastConnection& self) { self.ParseHead(); },
        [](BeastConnection& self, ReadOutcome outcome) { self.HeadFailed(outcome); });
  }

  void HeadFailed(ReadOutcome outcome) {
    HeadResult ended;
    ended.outcome = outcome;
    events()->OnHead(std::move(ended));
  }

  void ParseBody() {
    const RequestParser::BodyStep step = parser_.AddBody(Unread(), body_);
    buffer_.consume(step.num_used);
    if (step.is_complete()) {
      return events()->OnBodyData(step.outcome, {body_.data(), step.num_written}, step.is_end);
    }
    ReadMoreBody();
  }

  void ReadMoreBody() {
    ReadSome(
        kReadSize_bytes, [](BeastConnection& self) { self.ParseBody(); },
        [](BeastConnection& self, ReadOutcome outcome) { self.events()->OnBodyData(outcome, {}, false); });
  }

  /// The client half-closed. If it is gone, the next write resets the connection.
  void PeerEnded(int watch) {
    stream_.socket().async_wait(tcp::socket::wait_error, [self = shared_from_this(), watch](error_code error) {
      if (!error && watch == self->watch_ && self->events_) self->events()->OnPeerClosed();
    });
    events()->OnPeerEnded();
    if (events_ && !probe_.empty()) ProbeAfter(kFirstProbe, watch);
  }

  void ProbeAfter(Clock::duration time, int watch) {
    probe_timer_.expires_after(time);
    probe_timer_.async_wait([self = shared_from_this(), watch](error_code error) {
      if (error || watch != self->watch_ || !self->events_ || self->probe_.empty()) return;
      const std::size_t sent = self->stream_.socket().send(asio::buffer(self->probe_), 0, error);
      if (error == asio::error::would_block) error = {};
      if (error || (sent > 0 && sent < self->probe_.size())) return self->events()->OnPeerClosed();
      self->ProbeAfter(kNextProbe, watch);
    });
  }

  /// A copy, because the call may close the connection.
  std::shared_ptr<ConnectionEvents> events() const { return events_; }

  void WriteSome() {
    stream_.expires_after(kProgressTimeout);
    stream_.async_write_some(to_write_, [self = shared_from_this()](error_code error, std::size_t size) {
      if (!self->events_) return;
      for (auto& part : self->to_write_) {
        const std::size_t step = std::min(size, part.size());
        part += step;
        size -= step;
      }
      if (!error && asio::buffer_size(self->to_write_) > 0) return self->WriteSome();
      self->events()->OnWriteDone(!error);
    });
  }

  const net::PeerIdentity peer_;
  const std::string local_address_;
  const Clock::duration idle_timeout_;
  const Clock::duration head_timeout_;
  beast::basic_stream<AnyStream> stream_;
  asio::steady_timer probe_timer_;
  std::string probe_;
  beast::flat_buffer buffer_;
  RequestParser parser_;
  std::string body_;
  std::string first_, second_;
  std::array<asio::const_buffer, 2> to_write_;
  bool watching_ = false;
  int watch_ = 0;  // number of the current watch: a cancelled one may still report
  std::shared_ptr<ConnectionEvents> events_;
};

}  // namespace

struct Listener::Impl {
  Impl(const ListenerOptions& how, ListenerEvents whom)
      : options(how),
        events(std::move(whom)),
        io(options.num_threads),
        acceptor(asio::make_strand(io)),
        retry(acceptor.get_executor()) {}

  Status Listen(const std::string& address);
  Status Bind(const asio::ip::address& ip, std::uint16_t port);
  Status OpenDoor(const std::string& address);
  void LetIn(net::Passed passed);
  void Accept();
  void Accepted(const error_code& error, tcp::socket socket);
  void AcceptAfter(std::chrono::milliseconds time);

  const ListenerOptions options;
  const ListenerEvents events;
  asio::io_context io;
  // Calls that outlast their connections still post to the threads.
  asio::executor_work_guard<asio::io_context::executor_type> work{io.get_executor()};
  tcp::acceptor acceptor;  // on its strand only, once the threads run
  asio::steady_timer retry;
  net::ReserveDescriptor reserve;
  std::unique_ptr<net::Door> door;  // if set, nothing is accepted here
  int port = 0;
  std::vector<std::thread> threads;
};

Status Listener::Impl::Listen(const std::string& address) {
  if (address.starts_with("unix:") || !options.sockets.empty()) return OpenDoor(address);
  DHPMAP_ASSIGN_OR_RETURN(const net::Address parts, net::SplitAddress(address));
  error_code error;
  const auto ip = asio::ip::make_address(parts.host == "localhost" ? "127.0.0.1" : parts.host, error);
  if (error) return InvalidArgument("'" + address + "' is no address: the host must be an IP address or localhost");
  if (options.tls == nullptr) return Bind(ip, parts.port);
  return OpenDoor((ip.is_v6() ? "[" + ip.to_string() + "]" : ip.to_string()) + ":" + std::to_string(parts.port));
}

Status Listener::Impl::Bind(const asio::ip::address& ip, std::uint16_t wanted_port) {
  const tcp::endpoint endpoint(ip, wanted_port);
  error_code error;
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) return Unavailable("cannot listen on " + options.address + ": " + error.message());
  port = acceptor.local_endpoint(error).port();
  Accept();
  return Status::Ok();
}

Status Listener::Impl::OpenDoor(const std::string& address) {
  constexpr int kSurplus = 64;  // connections above the limit that still get an answer
  DHPMAP_ASSIGN_OR_RETURN(door, net::Door::Open({.name = "REST",
                                                 .address = address,
                                                 .sockets = options.sockets,
                                                 .max_connections = options.max_connections + kSurplus,
                                                 .protocol = net::Protocol::kHttp11,
                                                 .tls = options.tls,
                                                 .num_relays = 1,
                                                 .on_refused = [this](net::Refusal why) {
                                                   if (options.on_refused) options.on_refused(net::RefusalName(why));
                                                 }}));
  port = door->port();
  door->Start([this](net::Passed passed) { LetIn(std::move(passed)); });
  return Status::Ok();
}

void Listener::Impl::LetIn(net::Passed passed) {
  Socket socket(asio::make_strand(io));
  error_code error;
  socket.assign(AnyStream(AF_UNIX, 0), passed.socket, error);
  if (error) {
    ::close(passed.socket);
    return;
  }
  auto connection = std::make_shared<BeastConnection>(std::move(socket), options, std::move(passed.peer),
                                                      std::move(passed.local_address));
  connection->Post([this, connection] { events.on_connection(connection); });
}

void Listener::Impl::Accept() {
  acceptor.async_accept(asio::make_strand(io),
                        [this](error_code error, tcp::socket socket) { Accepted(error, std::move(socket)); });
}

void Listener::Impl::AcceptAfter(std::chrono::milliseconds time) {
  retry.expires_after(time);
  retry.async_wait([this](error_code stopped) {
    if (!stopped && acceptor.is_open()) Accept();
  });
}

void Listener::Impl::Accepted(const error_code& error, tcp::socket socket) {
  if (error == asio::error::operation_aborted || !acceptor.is_open()) return;
  if (error) {  // most likely out of file descriptors
    const bool has_closed_one = events.on_no_descriptors();
    return AcceptAfter(std::chrono::milliseconds(reserve.Use() ? 0 : has_closed_one ? 5 : 50));
  }
  const int descriptor = socket.native_handle();
  auto connection = std::make_shared<BeastConnection>(Socket(std::move(socket)), options, net::IdentityOf(descriptor),
                                                      net::LocalAddress(descriptor));
  connection->Post([this, connection] { events.on_connection(connection); });
  if (!reserve.Fill()) events.on_no_descriptors();
  Accept();
}

Result<std::unique_ptr<Listener>> Listener::Start(const ListenerOptions& options, ListenerEvents events) {
  auto impl = std::make_unique<Impl>(options, std::move(events));
  DHPMAP_RETURN_IF_ERROR(impl->Listen(options.address));
  for (int i = 0; i < options.num_threads; ++i) {
    impl->threads.emplace_back([io = &impl->io] {
      NameThisThread("http");
      (void)TakeTurns(Turns::kShort);
      io->run();
    });
  }
  return std::unique_ptr<Listener>(new Listener(std::move(impl)));
}

Listener::Listener(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

Listener::~Listener() {
  impl_->door.reset();  // it posts to the threads
  impl_->io.stop();
  for (std::thread& thread : impl_->threads) thread.join();
}

int Listener::port() const { return impl_->port; }

void Listener::StopAccepting() {
  if (impl_->door != nullptr) return impl_->door->StopAccepting();
  asio::post(impl_->acceptor.get_executor(), [impl = impl_.get()] {
    error_code ignored;
    impl->acceptor.close(ignored);
    impl->retry.cancel();
  });
}

}  // namespace dhpmap::http
