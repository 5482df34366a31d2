// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace dhpmap {

/// Purposes of memory that is counted at its allocation.
enum class MemoryKind : std::uint8_t {
  kBlocks,      ///< voxels of maps, in all pinned states
  kRefinement,  ///< working memory of refinements, without the blocks that they write
  kMeshing,     ///< working memory of meshing
  kFusion,      ///< buffers of fusion, reused between frames
  kTileRooms,   ///< thread-local buffers for tile surfaces of queries
  kReserved,    ///< no memory: part of the request budget reserved for memory that is counted elsewhere
};
inline constexpr std::size_t kNumMemoryKinds = 6;

/// Present and peak bytes of one kind. Thread-safe; nothing throws. Counting is an atomic addition, so it is done for
/// whole arrays, never for single voxels.
class alignas(64) MemoryCount {
 public:
  void Add(std::size_t bytes) noexcept {
    const std::size_t now = now_bytes_.fetch_add(bytes, std::memory_order_relaxed) + bytes;
    std::size_t most = most_bytes_.load(std::memory_order_relaxed);
    while (most < now && !most_bytes_.compare_exchange_weak(most, now, std::memory_order_relaxed)) {
    }
  }
  void Remove(std::size_t bytes) noexcept { now_bytes_.fetch_sub(bytes, std::memory_order_relaxed); }

  [[nodiscard]] std::size_t now_bytes() const noexcept { return now_bytes_.load(std::memory_order_relaxed); }
  /// Peak since the process started.
  [[nodiscard]] std::size_t most_bytes() const noexcept { return most_bytes_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::size_t> now_bytes_{0}, most_bytes_{0};
};
// Threads release their buffers at exit, possibly after static destruction.
static_assert(std::is_trivially_destructible_v<MemoryCount>);

/// The process's count of a kind.
inline MemoryCount& CountOf(MemoryKind kind) noexcept {
  static constinit std::array<MemoryCount, kNumMemoryKinds> counts;
  return counts[static_cast<std::size_t>(kind)];
}

/// Counts bytes during its lifetime, for an owner that knows its size but does not allocate itself. Thread-compatible.
class CountedBytes {
 public:
  explicit CountedBytes(MemoryKind kind, std::size_t bytes = 0) noexcept : kind_(kind), bytes_(bytes) {
    CountOf(kind_).Add(bytes_);
  }
  ~CountedBytes() { CountOf(kind_).Remove(bytes_); }
  CountedBytes(CountedBytes&& other) noexcept : kind_(other.kind_), bytes_(std::exchange(other.bytes_, 0)) {}
  CountedBytes(const CountedBytes&) = delete;
  CountedBytes& operator=(const CountedBytes&) = delete;
  CountedBytes& operator=(CountedBytes&&) = delete;

  /// Sets the number of bytes.
  void Set(std::size_t bytes) noexcept {
    if (bytes > bytes_) CountOf(kind_).Add(bytes - bytes_);
    else CountOf(kind_).Remove(bytes_ - bytes);
    bytes_ = bytes;
  }
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

 private:
  MemoryKind kind_;
  std::size_t bytes_;
};

/// std::allocator with counting; exact also when an exception ends the work. For containers of few large pieces.
template <typename T, MemoryKind kKind>
class CountedAllocator {
 public:
  using value_type = T;
  template <typename U>
  struct rebind {
    using other = CountedAllocator<U, kKind>;
  };

  CountedAllocator() noexcept = default;
  template <typename U>
  CountedAllocator(const CountedAllocator<U, kKind>& /*other*/) noexcept {}  // NOLINT: as allocators must

  [[nodiscard]] T* allocate(std::size_t count) {
    T* const pieces = std::allocator<T>().allocate(count);
    CountOf(kKind).Add(count * sizeof(T));
    return pieces;
  }
  void deallocate(T* pieces, std::size_t count) noexcept {
    std::allocator<T>().deallocate(pieces, count);
    CountOf(kKind).Remove(count * sizeof(T));
  }

  template <typename U>
  bool operator==(const CountedAllocator<U, kKind>& /*other*/) const noexcept {
    return true;
  }
};

template <typename T, MemoryKind kKind>
using CountedVector = std::vector<T, CountedAllocator<T, kKind>>;

/// For operator new and delete of a class with counted objects: `counted_bytes` is the heap size of one.
[[nodiscard]] inline void* NewCounted(MemoryKind kind, std::size_t bytes, std::size_t counted_bytes) {
  void* const object = ::operator new(bytes);
  CountOf(kind).Add(counted_bytes);
  return object;
}
inline void DeleteCounted(MemoryKind kind, void* object, std::size_t counted_bytes) noexcept {
  ::operator delete(object);
  CountOf(kind).Remove(counted_bytes);
}

/// Bytes of a vector's buffer, including unused capacity.
template <typename T, typename Allocator>
[[nodiscard]] std::size_t CapacityBytes(const std::vector<T, Allocator>& items) {
  return items.capacity() * sizeof(T);  // NOLINT(bugprone-sizeof-expression): T may well be a pointer
}

}  // namespace dhpmap
