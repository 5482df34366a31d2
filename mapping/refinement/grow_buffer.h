// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace dhpmap {

/// An array that keeps its memory when it shrinks and does not touch it when it grows: large arrays are first written,
/// and so paged in, by the threads that fill them.
template <typename T>
class GrowBuffer {
 public:
  /// The contents are undefined afterwards.
  void Resize(std::size_t size) {
    if (size > capacity_) {
      data_.reset();  // first, so that old and new never exist side by side
      data_ = std::make_unique_for_overwrite<T[]>(size);
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
  std::unique_ptr<T[]> data_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace dhpmap
