// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/cut_connection.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <functional>
#include <string_view>

namespace dhpmap::testing {
namespace {

constexpr char kSocketName[] = "/.s.PGSQL.5432";
constexpr int kLookAgain_ms = 50;  // whether to stop

sockaddr_un AddressIn(const std::string& folder) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, (folder + kSocketName).c_str(), sizeof address.sun_path - 1);
  return address;
}

bool SendAll(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

/// What has come; empty at the end.
std::string Receive(int socket) {
  std::array<char, 65536> buffer;
  const ssize_t num = recv(socket, buffer.data(), buffer.size(), 0);
  return num <= 0 ? std::string() : std::string(buffer.data(), static_cast<std::size_t>(num));
}

/// The command tag of a COMMIT, as servers send it; the statement's text has no zero before it.
constexpr std::string_view kCommitted(
    "C\0\0\0\x0b"
    "COMMIT\0",
    12);

/// As a client of ours names a prepared statement.
std::string NameOfStatement(const std::string& sql) {
  return std::string("s").append(std::to_string(std::hash<std::string>{}(sql)));
}

}  // namespace

CutConnection::CutConnection(const std::string& server) : server_(server) {
  listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_un address = AddressIn(folder_.path().string());
  EXPECT_EQ(bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_EQ(listen(listener_, 16), 0);
  acceptor_ = std::thread([this] { Accept(); });
}

CutConnection::~CutConnection() {
  is_stopping_ = true;
  acceptor_.join();
  for (std::thread& thread : threads_) thread.join();
  close(listener_);
}

std::string CutConnection::Url() const { return "postgresql://postgres@/postgres?host=" + folder_.path().string(); }

void CutConnection::Accept() {
  while (!is_stopping_) {
    pollfd listening = {listener_, POLLIN, 0};
    if (poll(&listening, 1, kLookAgain_ms) <= 0) continue;
    const int client = accept(listener_, nullptr, nullptr);
    if (client >= 0) threads_.emplace_back([this, client] { Serve(client); });
  }
}

void CutConnection::AwaitRelease() {
  is_held_ = true;
  is_held_.notify_all();
  while (!is_released_ && !is_stopping_) poll(nullptr, 0, kLookAgain_ms);
}

std::string_view CutConnection::HoldRest(std::string_view asked, bool& is_held) {
  static const std::string begin = NameOfStatement("BEGIN"), commit = NameOfStatement("COMMIT");
  const Hold where = hold_;
  const std::size_t at =
      where == Hold::kNowhere ? std::string_view::npos : asked.rfind(where == Hold::kBeforeBegin ? begin : commit);
  if (at == std::string_view::npos) return asked;
  hold_ = Hold::kNowhere;
  is_held = true;
  constexpr std::size_t kHead = 6;  // of the message that names it: its letter, its length, an empty name
  if (where == Hold::kBeforeBegin) return {};
  return where == Hold::kBeforeCommit ? asked.substr(0, at - kHead) : asked;
}

void CutConnection::Serve(int client) {
  const int upstream = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_un address = AddressIn(server_);
  bool goes_on = !is_away_ && connect(upstream, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  bool is_held = false;
  std::string answers;  // the end of what the server sent, as a tag may come in two pieces
  while (goes_on && !is_stopping_) {
    std::array<pollfd, 2> both = {{{client, POLLIN, 0}, {upstream, POLLIN, 0}}};
    if (poll(both.data(), both.size(), kLookAgain_ms) <= 0) continue;
    if (both[0].revents != 0) {
      const std::string asked = Receive(client);
      const bool is_lost = lose_request_.exchange(false);
      if (is_lost) ++num_lost_;
      const std::string_view first = HoldRest(asked, is_held);
      goes_on = !asked.empty() && !is_lost && SendAll(upstream, first);
      if (is_held) {
        AwaitRelease();
        is_held = false;
        goes_on = goes_on && SendAll(upstream, std::string_view(asked).substr(first.size()));
      }
    }
    if (goes_on && both[1].revents != 0) {
      const std::string got = Receive(upstream);
      answers = (answers + got).substr(answers.size() > 16 ? answers.size() - 16 : 0);
      const bool is_committed = answers.find(kCommitted) != std::string::npos;
      const bool is_lost = is_committed && lose_answer_.exchange(false);
      if (is_lost) ++num_lost_;
      goes_on = !got.empty() && !is_lost && SendAll(client, got);
    }
  }
  close(upstream);
  close(client);
}

}  // namespace dhpmap::testing
