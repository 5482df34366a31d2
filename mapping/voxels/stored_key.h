// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

namespace dhpmap {

/// Under which key a store has a part that is never written again, so that it need not be stored once more. A hint, set
/// by the store alone, once it is certain: loaded, or committed; whoever relies on it makes sure that the key is still
/// there. It is of one state in memory: a copy, which is made to be written to, has none. Thread-safe.
class StoredKey {
 public:
  StoredKey() = default;
  StoredKey(const StoredKey&) noexcept {}
  StoredKey& operator=(const StoredKey&) noexcept {
    word_.store(0, std::memory_order_relaxed);
    return *this;
  }

  /// 0 if it is not known to be in that store.
  [[nodiscard]] std::int64_t In(std::uint16_t store) const {
    const std::uint64_t word = word_.load(std::memory_order_relaxed);
    return word >> kKeyBits == store ? static_cast<std::int64_t>(word & kMaxKey) : 0;
  }
  /// `store`: the number of an open store in this process, 0 for none. Forgets any other store. Const, as it is no part
  /// of what is stored.
  void Set(std::uint16_t store, std::int64_t key) const {
    const bool fits = store != 0 && key > 0 && static_cast<std::uint64_t>(key) <= kMaxKey;
    const std::uint64_t word = (std::uint64_t{store} << kKeyBits) | static_cast<std::uint64_t>(key);
    word_.store(fits ? word : 0, std::memory_order_relaxed);
  }
  [[nodiscard]] bool IsKnown() const { return word_.load(std::memory_order_relaxed) != 0; }
  /// Takes over what is known of another one, which is of a part that is the same.
  void Adopt(const StoredKey& same) const {
    word_.store(same.word_.load(std::memory_order_relaxed), std::memory_order_relaxed);
  }
  /// Whether both are known to be the same stored part. Of two that are not stored nothing is known.
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
