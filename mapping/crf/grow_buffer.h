// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

#include "mapping/base/memory_count.h"

namespace dhpmap {

/// An array of plain values that keeps its memory when it shrinks and does not touch it when it grows: large arrays are
/// first written, and so paged in, by the threads that fill them. Large ones ask for huge pages, since most of what the
/// lattices do is jump about in them. All are counted as MemoryKind::kRefinement.
template <typename T>
class GrowBuffer {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  /// The contents are undefined afterwards.
  void Resize(std::size_t size) {
    if (size > capacity_) {
      data_.reset();  // first, so that old and new never exist side by side
      capacity_ = 0;
      data_ = Allocate(size);
      capacity_ = size;
    }
    size_ = size;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T* data() { return data_.get(); }
  [[nodiscard]] const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_.get(); }
  T* end() { return data_.get() + size_; }
  const T* begin() const { return data_.get(); }
  const T* end() const { return data_.get() + size_; }

 private:
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;

  /// Large arrays are mapped on their own, so that they go back to the system and leave no holes in the heap.
  struct Free {
    std::size_t num_bytes = 0;  ///< that were allocated
    bool is_mapped = false;     ///< else on the heap
    void operator()(T* data) const {
      if (is_mapped) {
        munmap(data, num_bytes);
      } else {
        std::free(data);
      }
      CountOf(MemoryKind::kRefinement).Remove(num_bytes);
    }
  };
  using Array = std::unique_ptr<T[], Free>;

  static Array Counted(void* data, const Free& free) {
    CountOf(MemoryKind::kRefinement).Add(free.num_bytes);
    return {static_cast<T*>(data), free};
  }

  static Array Allocate(std::size_t size) {
    constexpr std::size_t kLine = 64;
    if (size * sizeof(T) < 2 * kHugePage) {
      const std::size_t num_bytes = (size * sizeof(T) + kLine - 1) / kLine * kLine;
      void* data = std::aligned_alloc(kLine, num_bytes);
      if (data == nullptr) throw std::bad_alloc();
      return Counted(data, {.num_bytes = num_bytes, .is_mapped = false});
    }
    const std::size_t num_bytes = (size * sizeof(T) + kHugePage - 1) / kHugePage * kHugePage;
    void* data = mmap(nullptr, num_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (data == MAP_FAILED) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    madvise(data, num_bytes, MADV_HUGEPAGE);  // a wish; failing changes nothing
#endif
    return Counted(data, {.num_bytes = num_bytes, .is_mapped = true});
  }

  Array data_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace dhpmap
