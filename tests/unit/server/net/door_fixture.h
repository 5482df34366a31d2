// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/net/descriptor.h"
#include "server/net/door.h"
#include "tests/support/eventually.h"

namespace dhpmap::net {

/// Plays the server behind a door: the inner ends of connections, in order, each blocking.
class Behind {
 public:
  struct Inner {
    Descriptor socket;
    PeerIdentity peer;
    std::string local_address;

    /// So many bytes, or fewer at the end of the stream.
    std::string Read(std::size_t num_bytes) const {
      std::string bytes(num_bytes, '\0');
      std::size_t num_read = 0;
      while (num_read < num_bytes) {
        const ssize_t got = ::recv(socket.get(), bytes.data() + num_read, num_bytes - num_read, 0);
        if (got <= 0) break;
        num_read += static_cast<std::size_t>(got);
      }
      bytes.resize(num_read);
      return bytes;
    }
    [[nodiscard]] bool Say(std::string_view bytes) const {
      return ::send(socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
    }
    [[nodiscard]] bool IsAtEnd() const { return Read(1).empty(); }
  };

  void Take(Passed passed) {
    const timeval timeout{.tv_sec = std::chrono::seconds(testing::kPatience).count(), .tv_usec = 0};
    ::setsockopt(passed.socket, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    const int flags = ::fcntl(passed.socket, F_GETFL);
    ::fcntl(passed.socket, F_SETFL, flags & ~O_NONBLOCK);
    const std::lock_guard lock(mutex_);
    arrived_.push_back(
        {.socket = Descriptor(passed.socket), .peer = passed.peer, .local_address = passed.local_address});
    changed_.notify_all();
  }
  /// The next connection.
  std::optional<Inner> Next() {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, testing::kPatience, [&] { return !arrived_.empty(); })) return std::nullopt;
    Inner next = std::move(arrived_.front());
    arrived_.erase(arrived_.begin());
    return next;
  }
  std::size_t size() {
    const std::lock_guard lock(mutex_);
    return arrived_.size();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Inner> arrived_;
};

/// A door on a free port, and its refusals.
class DoorTest : public ::testing::Test {
 protected:
  void OpenDoor(DoorOptions options) {
    options.name = "test";
    if (options.address.empty()) options.address = "127.0.0.1:0";
    options.on_refused = [this](Refusal why) {
      const std::lock_guard lock(mutex_);
      refused_.push_back(why);
    };
    auto door = Door::Open(options);
    ASSERT_TRUE(door.ok()) << door.status().ToString();
    door_ = std::move(*door);
    door_->Start([this](Passed passed) { behind_.Take(std::move(passed)); });
  }
  std::size_t NumRefused(Refusal why) {
    const std::lock_guard lock(mutex_);
    return static_cast<std::size_t>(std::count(refused_.begin(), refused_.end(), why));
  }
  bool IsRefused(Refusal why, std::size_t times = 1) {
    return testing::Eventually([&] { return NumRefused(why) >= times; });
  }

  Behind behind_;
  std::mutex mutex_;
  std::vector<Refusal> refused_;
  std::unique_ptr<Door> door_;  // last: its threads use the others
};

}  // namespace dhpmap::net
