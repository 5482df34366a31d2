// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/server/http/http_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>

#include "server/http/message.h"
#include "tests/support/eventually.h"

namespace dhpmap::http {

std::string HttpAnswer::Header(std::string_view name) const { return std::string(FindHeader(headers, name)); }

HttpClient::HttpClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int on = 1;
  const timeval timeout{.tv_sec = std::chrono::seconds(testing::kPatience).count(), .tv_usec = 0};
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(socket_);
    socket_ = -1;
  }
}

HttpClient::~HttpClient() {
  if (socket_ >= 0) ::close(socket_);
}

HttpAnswer HttpClient::Ask(std::string_view method, std::string_view target, std::string_view body, Headers headers) {
  std::string request;
  request.append(method).append(" ").append(target).append(" HTTP/1.1\r\nHost: localhost\r\n");
  if (!body.empty()) headers.emplace_back("Content-Length", std::to_string(body.size()));
  for (const auto& [name, value] : headers) request += name + ": " + value + "\r\n";
  request += "\r\n";
  request += body;
  SendRaw(request);
  return ReadAnswer(method == "HEAD");
}

bool HttpClient::SendRaw(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool HttpClient::Fill() {
  std::array<char, 65536> data;
  const ssize_t got = ::recv(socket_, data.data(), data.size(), 0);
  if (got <= 0) return false;
  buffer_.append(data.data(), static_cast<std::size_t>(got));
  return true;
}

bool HttpClient::FillTo(std::size_t size) {
  while (buffer_.size() < size) {
    if (!Fill()) return false;
  }
  return true;
}

HttpAnswer HttpClient::ReadAnswer(bool is_head) {
  HttpAnswer answer;
  std::size_t end = 0;
  while ((end = buffer_.find("\r\n\r\n")) == std::string::npos) {
    if (!Fill()) return answer;
  }
  const std::string head = buffer_.substr(0, end + 2);
  buffer_.erase(0, end + 4);
  answer.status = std::atoi(head.c_str() + head.find(' '));
  for (std::size_t at = head.find("\r\n") + 2; at < head.size();) {
    const std::size_t line_end = head.find("\r\n", at);
    const std::size_t colon = head.find(": ", at);
    answer.headers.emplace_back(head.substr(at, colon - at), head.substr(colon + 2, line_end - colon - 2));
    at = line_end + 2;
  }
  if (is_head || (answer.status == 204 || answer.status == 304) || answer.status == 100) return answer;
  answer.was_chunked = answer.Header("Transfer-Encoding") == "chunked";
  if (!answer.was_chunked && !answer.Header("Content-Length").empty()) {
    const std::size_t size = std::strtoull(answer.Header("Content-Length").c_str(), nullptr, 10);
    answer.is_complete = FillTo(size);
    answer.body = buffer_.substr(0, size);
    buffer_.erase(0, size);
    return answer;
  }
  if (!answer.was_chunked) {  // up to the end of the connection
    while (Fill()) {
    }
    answer.body.swap(buffer_);
    return answer;
  }
  while (true) {
    std::size_t line = 0;
    while ((line = buffer_.find("\r\n")) == std::string::npos) {
      if (!Fill()) return answer.is_complete = false, answer;
    }
    const std::size_t size = std::strtoull(buffer_.c_str(), nullptr, 16);
    if (!FillTo(line + 2 + size + 2)) return answer.is_complete = false, answer;
    answer.body += buffer_.substr(line + 2, size);
    buffer_.erase(0, line + 2 + size + 2);
    if (size == 0) return answer;
  }
}

std::string HttpClient::ReadSome() {
  if (buffer_.empty()) Fill();
  std::string out;
  out.swap(buffer_);
  return out;
}

void HttpClient::CloseSending() { ::shutdown(socket_, SHUT_WR); }

bool HttpClient::IsClosedByServer() {
  while (true) {
    std::array<char, 4096> data;
    const ssize_t got = ::recv(socket_, data.data(), data.size(), 0);
    if (got > 0) continue;
    return got == 0 || errno == ECONNRESET;
  }
}

}  // namespace dhpmap::http
