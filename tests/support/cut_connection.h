// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/support/scenes.h"

namespace dhpmap::testing {

/// Stands between clients and a PostgreSQL server on a Unix socket, and can lose the answer to a COMMIT: the server has
/// made it, the client sees its connection end. Thread-safe.
class CutConnection {
 public:
  /// `server`: the folder of the server's socket.
  explicit CutConnection(const std::string& server);
  ~CutConnection();
  CutConnection(const CutConnection&) = delete;
  CutConnection& operator=(const CutConnection&) = delete;

  /// For libpq, in place of the server's own.
  [[nodiscard]] std::string Url() const;
  /// Loses the answer to the next COMMIT; or what is asked next, before the server has it.
  void LoseNextCommitsAnswer() { lose_answer_ = true; }
  void LoseNextRequest() { lose_request_ = true; }
  /// While it is away, every new connection ends at once.
  void GoAway() { is_away_ = true; }
  void ComeBack() { is_away_ = false; }
  [[nodiscard]] int num_lost() const { return num_lost_; }

  /// Where the next transaction is held, as if the client had been stopped there.
  enum class Hold {
    kNowhere,
    kBeforeBegin,   ///< the server has nothing of it
    kBeforeCommit,  ///< the server has all but its COMMIT
    kAfterCommit,   ///< the server has made it, and the client has no answer
  };
  void HoldNext(Hold where) { hold_ = where; }
  void AwaitHeld() const { is_held_.wait(false); }
  /// Goes on where it was held. Once.
  void Release() { is_released_ = true; }

 private:
  void Accept();
  void Serve(int client);
  /// What of a request goes to the server at once; the rest is held.
  std::string_view HoldRest(std::string_view asked, bool& is_held);
  void AwaitRelease();

  const std::string server_;
  TempDir folder_;
  int listener_ = -1;
  std::atomic<bool> lose_answer_ = false, lose_request_ = false, is_stopping_ = false, is_away_ = false;
  std::atomic<int> num_lost_ = 0;
  std::atomic<Hold> hold_ = Hold::kNowhere;
  std::atomic<bool> is_held_ = false, is_released_ = false;
  std::thread acceptor_;
  std::vector<std::thread> threads_;  // of the acceptor, until it has ended
};

}  // namespace dhpmap::testing
