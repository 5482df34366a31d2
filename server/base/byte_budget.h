// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>

#include "mapping/base/status.h"

namespace dhpmap {

/// RESOURCE_EXHAUSTED: requests, frames and answers in flight have taken all of their budget.
inline Status TooManyBytes() {
  return ResourceExhausted("too many bytes of requests and answers are in flight: try again later")
      .WithReason("TOO_MANY_BYTES");
}

/// How many bytes may be in memory at once for one purpose, whoever holds them. Thread-safe.
class ByteBudget {
 public:
  /// A share of up to `free_bytes` costs nothing: what is small goes on when the budget is spent.
  explicit ByteBudget(std::size_t limit_bytes, std::size_t free_bytes = 0)
      : limit_bytes_(limit_bytes), free_bytes_(free_bytes) {}

  /// False, and nothing taken, if that would be too many.
  bool TryTake(std::size_t bytes) {
    std::size_t used = used_bytes_.load();
    do {
      if (bytes > limit_bytes_ - used) return false;
    } while (!used_bytes_.compare_exchange_weak(used, used + bytes));
    return true;
  }
  void GiveBack(std::size_t bytes) { used_bytes_ -= bytes; }

  [[nodiscard]] std::size_t limit_bytes() const { return limit_bytes_; }
  [[nodiscard]] std::size_t free_bytes() const { return free_bytes_; }
  [[nodiscard]] std::size_t used_bytes() const { return used_bytes_; }

 private:
  const std::size_t limit_bytes_, free_bytes_;
  std::atomic<std::size_t> used_bytes_{0};  // never above the limit
};

/// What one request, answer or frame has taken of a budget; gives it back at its end. Thread-compatible.
class ByteShare {
 public:
  /// `budget` is there as long as this holds anything of it.
  explicit ByteShare(ByteBudget* budget) : budget_(budget) {}
  ~ByteShare() {
    if (bytes_ > 0) Release();
  }
  ByteShare(ByteShare&& other) noexcept : budget_(other.budget_), bytes_(std::exchange(other.bytes_, 0)) {}
  ByteShare(const ByteShare&) = delete;
  ByteShare& operator=(const ByteShare&) = delete;
  ByteShare& operator=(ByteShare&&) = delete;

  /// Takes more, or gives some back. False, and nothing changed, if there are not so many left.
  [[nodiscard]] bool Resize(std::size_t bytes) {
    const std::size_t before = Cost(bytes_), after = Cost(bytes);
    if (after > before && !budget_->TryTake(after - before)) return false;
    if (after < before) budget_->GiveBack(before - after);
    bytes_ = bytes;
    return true;
  }
  /// Takes so much more; all there is where that is more than there ever can be, so that what is huge can be done
  /// alone.
  [[nodiscard]] bool Grow(std::size_t bytes) { return Resize(std::min(bytes_ + bytes, budget_->limit_bytes())); }
  void Release() { (void)Resize(0); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] const ByteBudget& budget() const { return *budget_; }
  /// Another one of the same budget, with nothing in it. At any time, on any thread.
  [[nodiscard]] ByteShare Another() const { return ByteShare(budget_); }

 private:
  [[nodiscard]] std::size_t Cost(std::size_t bytes) const { return bytes <= budget_->free_bytes() ? 0 : bytes; }

  ByteBudget* const budget_;
  std::size_t bytes_ = 0;
};

}  // namespace dhpmap
