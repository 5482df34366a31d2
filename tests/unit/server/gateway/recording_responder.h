// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "server/http/exchange.h"
#include "tests/support/eventually.h"

namespace dhpmap::gateway {

/// The connection's side of a request without any connection: keeps what it is told, and runs what is posted to it on
/// the test's thread. Thread-compatible, but for Post.
class RecordingResponder final : public http::Responder {
 public:
  void Reply(http::Response response) override { replies.push_back(std::move(response)); }
  void BeginStream(http::Response head, std::optional<std::uint64_t> size) override {
    heads.push_back(std::move(head));
    length = size;
  }
  void Chunk(std::string data) override { chunks.push_back(std::move(data)); }
  void EndStream(bool complete) override { ends.push_back(complete); }
  void ResumeBody() override { ++num_resumed; }
  void Post(std::function<void()> task) override {
    const MutexLock lock(mutex_);
    tasks_.push_back(std::move(task));
    changed_.NotifyAll();
  }

  /// Runs posted tasks until `holds`; false after a minute.
  bool RunUntil(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + testing::kPatience;
    while (!holds()) {
      std::function<void()> task;
      {
        const MutexLock lock(mutex_);
        if (std::chrono::steady_clock::now() > end) return false;
        if (tasks_.empty())
          changed_.WaitFor(mutex_, std::chrono::milliseconds(5));  // what it waits for may need no task
        if (tasks_.empty()) continue;
        task = std::move(tasks_.front());
        tasks_.pop_front();
      }
      task();
    }
    return true;
  }

  std::vector<http::Response> replies;
  std::vector<http::Response> heads;
  std::optional<std::uint64_t> length;
  std::vector<std::string> chunks;
  std::vector<bool> ends;
  int num_resumed = 0;

 private:
  Mutex mutex_;
  CondVar changed_;
  std::deque<std::function<void()>> tasks_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::gateway
