// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "tests/rig/clients/corridor.h"

namespace dhpmap::rig {

/// Where the servers are now. Thread-safe.
class Doors {
 public:
  explicit Doors(std::size_t num_servers) : num_servers_(num_servers), channels_(num_servers) {}
  void Set(std::size_t server, const std::string& address) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::shared_ptr<grpc::Channel> ChannelTo(std::size_t server) const DHPMAP_EXCLUDES(mutex_);
  /// The server at that address; `otherwise` if there is none.
  [[nodiscard]] std::size_t Find(const std::string& address, std::size_t otherwise) const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::size_t size() const { return num_servers_; }

 private:
  struct Door {
    std::string address;
    std::shared_ptr<grpc::Channel> channel;
  };
  const std::size_t num_servers_;
  mutable Mutex mutex_;
  std::vector<Door> channels_ DHPMAP_GUARDED_BY(mutex_);
};

/// A robot that feeds a map of its own at an even pace, each frame until it is acknowledged as stored: sequences 1, 2,
/// and so on. After every fourth frame it renames the map, one request until it is answered. It goes to the owner that
/// answers name, and to the next server of its own order when one does not answer in time.
class PacedRobot {
 public:
  using Clock = std::chrono::steady_clock;

  /// `doors` and `corridor` outlive it. `step`: from one server to the next of its order, 1 to their number - 1.
  PacedRobot(const Doors& doors, const Corridor& corridor, std::string map, std::size_t server, std::size_t step)
      : doors_(doors), corridor_(corridor), map_(std::move(map)), step_(step), server_(server) {}

  void Run(double period_s, double timeout_s, const std::atomic<bool>& is_over) DHPMAP_EXCLUDES(mutex_);

  /// Stored by the server's word.
  struct Acknowledged {
    std::int64_t sequence = 0;  ///< of the last frame
    Clock::time_point time;
    std::size_t server = 0;
  };
  /// Of frames and of edits, in order.
  [[nodiscard]] std::vector<Acknowledged> acknowledged() const DHPMAP_EXCLUDES(mutex_);
  /// Revisions of the edits by their number, from 1 on; the author is "edit-" with that number.
  [[nodiscard]] std::vector<std::int64_t> edit_revisions() const DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] const std::string& map() const { return map_; }
  [[nodiscard]] int num_sent_on() const { return num_sent_on_; }
  [[nodiscard]] int num_failed() const { return num_failed_; }
  /// Refusals for other reasons than a takeover.
  [[nodiscard]] std::vector<std::string> complaints() const DHPMAP_EXCLUDES(mutex_);

 private:
  /// Whether it is stored; otherwise `server_` is the one to try next. So does Edit.
  bool Send(std::int64_t sequence, double timeout_s) DHPMAP_EXCLUDES(mutex_);
  bool Edit(std::int64_t number, double timeout_s) DHPMAP_EXCLUDES(mutex_);
  void NoteOwner(const grpc::ClientContext& context);
  void OnFailure(const grpc::Status& status) DHPMAP_EXCLUDES(mutex_);

  const Doors& doors_;
  const Corridor& corridor_;
  const std::string map_;
  const std::size_t step_;
  std::size_t server_;
  std::int64_t last_stored_ = 0;
  std::atomic<int> num_sent_on_ = 0, num_failed_ = 0;
  mutable Mutex mutex_;
  std::vector<Acknowledged> acknowledged_ DHPMAP_GUARDED_BY(mutex_);
  std::vector<std::int64_t> edit_revisions_ DHPMAP_GUARDED_BY(mutex_);
  std::vector<std::string> complaints_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::rig
