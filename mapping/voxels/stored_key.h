// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

namespace dhpmap {

/// The key under which a store has an immutable part, so that the part is not stored twice. Only the store sets it,
/// once the part has been loaded or committed. It is a hint: check that the key still exists before relying on it. A
/// copy of the part has no key, because copies are made to be written to. Thread-safe.
class StoredKey {
 public:
  StoredKey() = default;
  StoredKey(const StoredKey&) noexcept {}
  StoredKey& operator=(const StoredKey&) noexcept {
    word_.store(0, std::memory_order_relaxed);
    return *this;
  }

  /// 0 if no key in that store is known.
  [[nodiscard]] std::int64_t In(std::uint16_t store) const {
    const std::uint64_t word = word_.load(std::memory_order_relaxed);
    return word >> kKeyBits == store ? static_cast<std::int64_t>(word & kMaxKey) : 0;
  }
  /// `store`: the number of an open store in this process, 0 for none. Replaces any other store. Const, because the key
  /// is not part of the stored value.
  void Set(std::uint16_t store, std::int64_t key) const {
    const bool fits = store != 0 && key > 0 && static_cast<std::uint64_t>(key) <= kMaxKey;
    const std::uint64_t word = (std::uint64_t{store} << kKeyBits) | static_cast<std::uint64_t>(key);
    word_.store(fits ? word : 0, std::memory_order_relaxed);
  }
  [[nodiscard]] bool IsKnown() const { return word_.load(std::memory_order_relaxed) != 0; }
  /// Copies the key of an equal part.
  void Adopt(const StoredKey& same) const {
    word_.store(same.word_.load(std::memory_order_relaxed), std::memory_order_relaxed);
  }
  /// Whether both are known to be the same stored part. False if either key is unknown.
  [[nodiscard]] bool IsSameAs(const StoredKey& other) const {
    const std::uint64_t word = word_.load(std::memory_order_relaxed);
    return word != 0 && word == other.word_.load(std::memory_order_relaxed);
  }

 private:
  static constexpr int kKeyBits = 48;
  static constexpr std::uint64_t kMaxKey = (std::uint64_t{1} << kKeyBits) - 1;

  mutable std::atomic<std::uint64_t> word_ = 0;  ///< store and key at once, so that they always belong together
};

}  // namespace dhpmap
