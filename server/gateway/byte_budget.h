// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>

namespace dhpmap::gateway {

/// How many bytes of requests and answers may be in memory at once, over all connections. Thread-safe.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t limit_bytes) : limit_bytes_(limit_bytes) {}

  /// False, and nothing taken, if that would be too many.
  bool TryTake(std::size_t bytes) {
    std::size_t used = used_bytes_.load();
    do {
      if (bytes > limit_bytes_ - used) return false;
    } while (!used_bytes_.compare_exchange_weak(used, used + bytes));
    return true;
  }
  void GiveBack(std::size_t bytes) { used_bytes_ -= bytes; }
  [[nodiscard]] std::size_t used_bytes() const { return used_bytes_; }

 private:
  const std::size_t limit_bytes_;
  std::atomic<std::size_t> used_bytes_{0};  // never above the limit
};

/// What one request has taken of a budget; gives it back at its end. Thread-compatible.
class ByteShare {
 public:
  /// `budget` outlives this.
  explicit ByteShare(ByteBudget* budget) : budget_(budget) {}
  ~ByteShare() { budget_->GiveBack(bytes_); }
  ByteShare(ByteShare&& other) noexcept : budget_(other.budget_), bytes_(std::exchange(other.bytes_, 0)) {}
  ByteShare(const ByteShare&) = delete;
  ByteShare& operator=(const ByteShare&) = delete;
  ByteShare& operator=(ByteShare&&) = delete;

  /// Takes more, or gives some back. False, and nothing changed, if there are not so many left.
  bool Resize(std::size_t bytes) {
    if (bytes > bytes_ && !budget_->TryTake(bytes - bytes_)) return false;
    if (bytes < bytes_) budget_->GiveBack(bytes_ - bytes);
    bytes_ = bytes;
    return true;
  }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  ByteBudget* budget_;
  std::size_t bytes_ = 0;
};

}  // namespace dhpmap::gateway
