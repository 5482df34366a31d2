// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <utility>

#include "mapping/base/status.h"

namespace dhpmap {

/// RESOURCE_EXHAUSTED: requests, frames and answers in flight have used the budget.
inline Status TooManyBytes() {
  return ResourceExhausted("too many bytes of requests and answers are in flight: try again later")
      .WithReason("TOO_MANY_BYTES");
}

/// A memory limit in bytes for one purpose, over all holders. Thread-safe.
class ByteBudget {
 public:
  /// Shares of up to `free_bytes` are free, so that small requests pass even when the budget is spent. Bytes taken from
  /// this budget are also taken from `within`, unless it is null.
  explicit ByteBudget(std::size_t limit_bytes, std::size_t free_bytes = 0, std::shared_ptr<ByteBudget> within = nullptr)
      : limit_bytes_(limit_bytes), free_bytes_(free_bytes), within_(std::move(within)) {}

  /// False, without effect, if that would exceed a limit.
  bool TryTake(std::size_t bytes) {
    std::size_t used = used_bytes_.load();
    do {
      if (bytes > limit_bytes_ - used) return false;
    } while (!used_bytes_.compare_exchange_weak(used, used + bytes));
    if (within_ == nullptr || within_->TryTake(bytes)) return true;
    used_bytes_ -= bytes;
    return false;
  }
  void GiveBack(std::size_t bytes) {
    if (within_ != nullptr) within_->GiveBack(bytes);
    used_bytes_ -= bytes;
  }

  [[nodiscard]] std::size_t limit_bytes() const { return limit_bytes_; }
  [[nodiscard]] std::size_t free_bytes() const { return free_bytes_; }
  [[nodiscard]] std::size_t used_bytes() const { return used_bytes_; }

 private:
  const std::size_t limit_bytes_, free_bytes_;
  const std::shared_ptr<ByteBudget> within_;
  std::atomic<std::size_t> used_bytes_{0};  // at most the limit
};

/// The share of one request, answer or frame; its destructor returns it. Thread-compatible.
class ByteShare {
 public:
  /// `budget` must outlive the share.
  explicit ByteShare(ByteBudget* budget) : budget_(budget) {}
  ~ByteShare() {
    if (bytes_ > 0) Release();
  }
  ByteShare(ByteShare&& other) noexcept : budget_(other.budget_), bytes_(std::exchange(other.bytes_, 0)) {}
  ByteShare(const ByteShare&) = delete;
  ByteShare& operator=(const ByteShare&) = delete;
  ByteShare& operator=(ByteShare&&) = delete;

  /// Takes more or returns some. False, without change, if the budget does not suffice.
  [[nodiscard]] bool Resize(std::size_t bytes) {
    const std::size_t before = Cost(bytes_), after = Cost(bytes);
    if (after > before && !budget_->TryTake(after - before)) return false;
    if (after < before) budget_->GiveBack(before - after);
    bytes_ = bytes;
    return true;
  }
  /// Takes `bytes` more, at most the whole budget, so that a huge request can run alone.
  [[nodiscard]] bool Grow(std::size_t bytes) { return Resize(std::min(bytes_ + bytes, budget_->limit_bytes())); }
  void Release() { (void)Resize(0); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] const ByteBudget& budget() const { return *budget_; }
  /// A new, empty share of the same budget. From any thread.
  [[nodiscard]] ByteShare Another() const { return ByteShare(budget_); }

 private:
  [[nodiscard]] std::size_t Cost(std::size_t bytes) const { return bytes <= budget_->free_bytes() ? 0 : bytes; }

  ByteBudget* const budget_;
  std::size_t bytes_ = 0;
};

}  // namespace dhpmap
