// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

namespace dhpmap {

/// Names an object as its address does, but for good: no other one that this process makes is ever called the same, and
/// what was let go of and read again from a store can be given its old name. A copy is another object.
/// Thread-compatible.
class PartId {
 public:
  PartId() noexcept : value_(Next()) {}
  PartId(const PartId&) noexcept : value_(Next()) {}
  PartId& operator=(const PartId&) noexcept { return *this; }  // what is written to stays the object that it is

  /// Not 0.
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }
  /// Of the same object, read again.
  void Restore(std::uint64_t value) noexcept { value_ = value; }

  /// The first of as many names as are wanted, which nobody else gets.
  static std::uint64_t Reserve(std::uint64_t count) noexcept {
    static std::atomic<std::uint64_t> next{1};
    return next.fetch_add(count, std::memory_order_relaxed);
  }

 private:
  /// Threads take names in batches, so that they do not wait for each other.
  static std::uint64_t Next() noexcept {
    constexpr std::uint64_t kBatch = 4096;
    thread_local std::uint64_t next = 0, end = 0;
    if (next == end) {
      next = Reserve(kBatch);
      end = next + kBatch;
    }
    return next++;
  }

  std::uint64_t value_;
};

}  // namespace dhpmap
