// SPDX-License-Identifier: BSD-3-Clause
#include "server/rest/http_server.h"

#include <algorithm>
#include <array>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <thread>
#include <vector>

namespace dhpmap::rest {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using beast::error_code;

constexpr std::chrono::seconds kHeadTimeout{60};      // idle and head together
constexpr std::chrono::seconds kProgressTimeout{60};  // a body or an answer that does not move
constexpr std::size_t kMaxHead_bytes = 32u << 10;
constexpr std::size_t kReadSize_bytes = 64u << 10;

ReadOutcome OutcomeOf(const error_code& error) {
  if (!error) return ReadOutcome::kOk;
  if (error == beast::error::timeout) return ReadOutcome::kTimedOut;
  if (error == http::error::header_limit || error == http::error::buffer_overflow) return ReadOutcome::kTooLarge;
  if (error == http::error::end_of_stream || error == http::error::partial_message) return ReadOutcome::kClosed;
  return error.category() == http::make_error_code(http::error::bad_method).category() ? ReadOutcome::kMalformed
                                                                                       : ReadOutcome::kClosed;
}

class BeastConnection final : public Connection, public std::enable_shared_from_this<BeastConnection> {
 public:
  explicit BeastConnection(tcp::socket socket) : stream_(std::move(socket)), buffer_(kMaxHead_bytes + kReadSize_bytes) {
    error_code ignored;
    stream_.socket().set_option(tcp::no_delay(true), ignored);
    stream_.socket().non_blocking(true, ignored);  // or peeking might block
  }

  void Start(std::shared_ptr<ConnectionEvents> events) override {
    events_ = std::move(events);
    ReadHead();
  }

  void ReadHead() override {
    parser_.emplace();
    parser_->header_limit(kMaxHead_bytes);
    parser_->body_limit(
        std::numeric_limits<std::uint64_t>::max());  // the exchange limits it; none does not work in 1.74
    stream_.expires_after(kHeadTimeout);
    http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
      if (self->events_) self->events()->OnHead(self->MakeHead(error));
    });
  }

  void ReadBody() override {
    body_.resize(kReadSize_bytes);
    auto& body = parser_->get().body();
    body.data = body_.data();
    body.size = body_.size();
    body.more = true;
    stream_.expires_after(kProgressTimeout);
    http::async_read_some(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
      if (!self->events_) return;
      if (error == http::error::need_buffer) error = {};
      const std::size_t size = self->body_.size() - self->parser_->get().body().size;
      self->events()->OnBodyData(OutcomeOf(error), {self->body_.data(), size}, !error && self->parser_->is_done());
    });
  }

  void Write(std::string first, std::string second) override {
    first_ = std::move(first);
    second_ = std::move(second);
    to_write_ = {asio::buffer(first_), asio::buffer(second_)};
    WriteSome();
  }

  void WatchPeer() override {
    if (buffer_.size() > 0) return;  // the next request is here already: its end is not the client's
    watching_ = true;
    const int watch = ++watch_;
    stream_.socket().async_wait(tcp::socket::wait_read, [self = shared_from_this(), watch](error_code error) {
      if (error || watch != self->watch_ || !self->events_) return;
      self->watching_ = false;
      char byte = 0;
      self->stream_.socket().receive(asio::buffer(&byte, 1), tcp::socket::message_peek, error);
      if (error && error != asio::error::would_block) self->events()->OnPeerClosed();
    });
  }

  void StopWatching() override {
    if (!watching_) return;
    watching_ = false;
    ++watch_;
    error_code ignored;
    stream_.socket().cancel(ignored);
  }

  void CloseSending() override {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  void Close() override {
    events_.reset();
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_both, ignored);
    stream_.close();
  }

  void Post(std::function<void()> task) override { asio::post(stream_.get_executor(), std::move(task)); }

 private:
  /// A copy, because the call may close the connection.
  std::shared_ptr<ConnectionEvents> events() const { return events_; }

  HeadResult MakeHead(const error_code& error) const {
    HeadResult result;
    result.outcome = OutcomeOf(error);
    if (error) {
      result.problem = error.message();
      return result;
    }
    const auto& message = parser_->get();
    result.head.method = std::string(message.method_string());
    result.head.target = std::string(message.target());
    for (const auto& field : message) {
      result.head.headers.emplace_back(std::string(field.name_string()), std::string(field.value()));
    }
    if (const auto length = parser_->content_length()) result.head.content_length = *length;
    result.is_http_1_1 = message.version() >= 11;
    result.keep_alive = parser_->keep_alive();
    result.has_body = !parser_->is_done();
    return result;
  }

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

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::buffer_body>> parser_;
  std::string body_;
  std::string first_, second_;
  std::array<asio::const_buffer, 2> to_write_;
  bool watching_ = false;
  int watch_ = 0;  // which watch: a cancelled one may still report
  std::shared_ptr<ConnectionEvents> events_;
};

Result<std::pair<std::string, std::uint16_t>> SplitAddress(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  std::uint16_t port = 0;
  const char* begin = address.data() + (colon == std::string::npos ? address.size() : colon + 1);
  const char* end = address.data() + address.size();
  const auto [stop, error] = std::from_chars(begin, end, port);
  if (colon == std::string::npos || error != std::errc() || stop != end) {
    return InvalidArgument("'" + address + "' is no address: expected host:port");
  }
  std::string host = address.substr(0, colon);
  if (host.size() > 1 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return std::pair{std::move(host), port};
}

}  // namespace

struct HttpServer::Impl {
  Impl(int num_threads, OnConnection handler)
      : io(num_threads),
        acceptor(asio::make_strand(io)),
        retry(acceptor.get_executor()),
        on_connection(std::move(handler)) {}

  Status Bind(const std::string& address);
  void Accept();
  void Accepted(const error_code& error, tcp::socket socket);

  asio::io_context io;
  // Calls that outlast their connections still report through the threads.
  asio::executor_work_guard<asio::io_context::executor_type> work{io.get_executor()};
  tcp::acceptor acceptor;  // used on its strand only, once the threads run
  asio::steady_timer retry;
  OnConnection on_connection;
  int port = 0;
  std::vector<std::thread> threads;
};

Status HttpServer::Impl::Bind(const std::string& address) {
  DHPMAP_ASSIGN_OR_RETURN(const auto parts, SplitAddress(address));
  error_code error;
  const auto ip = parts.first == "localhost" ? asio::ip::make_address("127.0.0.1", error)
                                             : asio::ip::make_address(parts.first, error);
  if (error) return InvalidArgument("'" + address + "' is no address: the host must be an IP address or localhost");
  const tcp::endpoint endpoint(ip, parts.second);
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) return Unavailable("cannot listen on " + address + ": " + error.message());
  port = acceptor.local_endpoint(error).port();
  return Status::Ok();
}

void HttpServer::Impl::Accept() {
  acceptor.async_accept(asio::make_strand(io),
                        [this](error_code error, tcp::socket socket) { Accepted(error, std::move(socket)); });
}

void HttpServer::Impl::Accepted(const error_code& error, tcp::socket socket) {
  if (error == asio::error::operation_aborted || !acceptor.is_open()) return;
  if (error) {  // out of file descriptors, most likely: wait for some to be closed
    retry.expires_after(std::chrono::milliseconds(100));
    return retry.async_wait([this](error_code stopped) {
      if (!stopped && acceptor.is_open()) Accept();
    });
  }
  auto connection = std::make_shared<BeastConnection>(std::move(socket));
  connection->Post([this, connection] { on_connection(connection); });
  Accept();
}

Result<std::unique_ptr<HttpServer>> HttpServer::Start(const std::string& address, int num_threads,
                                                      OnConnection on_connection) {
  auto impl = std::make_unique<Impl>(num_threads, std::move(on_connection));
  DHPMAP_RETURN_IF_ERROR(impl->Bind(address));
  impl->Accept();
  for (int i = 0; i < num_threads; ++i) impl->threads.emplace_back([io = &impl->io] { io->run(); });
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(impl)));
}

HttpServer::HttpServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

HttpServer::~HttpServer() {
  impl_->io.stop();
  for (std::thread& thread : impl_->threads) thread.join();
}

int HttpServer::port() const { return impl_->port; }

void HttpServer::StopAccepting() {
  asio::post(impl_->acceptor.get_executor(), [impl = impl_.get()] {
    error_code ignored;
    impl->acceptor.close(ignored);
    impl->retry.cancel();
  });
}

}  // namespace dhpmap::rest
