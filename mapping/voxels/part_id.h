// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

namespace dhpmap {

/// A permanent name for an object: unlike an address, no other object of this process ever gets it, and an evicted
/// object that is read again can be given its old name. A copy is another object. Thread-compatible.
class PartId {
 public:
  PartId() noexcept : value_(Next()) {}
  PartId(const PartId&) noexcept : value_(Next()) {}
  PartId& operator=(const PartId&) noexcept { return *this; }  // assignment keeps the target's name

  /// Not 0.
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }
  /// For the same object, read again.
  void Restore(std::uint64_t value) noexcept { value_ = value; }

  /// Reserves `count` consecutive names and returns the first.
  static std::uint64_t Reserve(std::uint64_t count) noexcept {
    static std::atomic<std::uint64_t> next{1};
    return next.fetch_add(count, std::memory_order_relaxed);
  }

 private:
  /// Threads take names in batches, so that they do not contend.
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
