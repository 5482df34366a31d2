// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap {

/// Limits the memory that all requests together hold in evicted tiles. A request keeps the tiles that it has read for
/// as long as it holds its state of the map, even if they are evicted meanwhile.
struct PageReaderLimit {
  std::int64_t bytes = 0;  ///< 0: unlimited
  double wait_s =
      0.05;  ///< wait for other requests to end, before refusing; short, because others need the waiting thread
};
/// One limit for the process, as PageCounts; thread-safe.
void SetPageReaderLimit(const PageReaderLimit& limit);
/// Bytes that requests hold now.
std::int64_t PageReaderBytes();
/// Number of threads that wait for other requests to end.
int NumPageReadersWaiting();

/// The tiles of one request; released by the destructor.
class PageHold {
 public:
  PageHold() = default;
  ~PageHold();
  PageHold(const PageHold&) = delete;
  PageHold& operator=(const PageHold&) = delete;

 private:
  friend class PageReader;
  std::int64_t bytes_ = 0;
};

/// Attributes the tiles that this thread reads from disk to a request. Threads without a PageReader, such as those of
/// fusion and refinement, read without limit.
class PageReader {
 public:
  /// For a request that ends with this object.
  PageReader() noexcept : PageReader(own_) {}
  /// For a request that continues elsewhere, such as a stream.
  explicit PageReader(PageHold& hold) noexcept;
  ~PageReader();
  PageReader(const PageReader&) = delete;
  PageReader& operator=(const PageReader&) = delete;

  /// That of the calling thread, to pass to threads that work on its request while it waits for them; null for none.
  [[nodiscard]] static PageHold* Current() noexcept;
  /// For such a thread; null: it reads without limit.
  explicit PageReader(PageHold* hold) noexcept;

  /// Call before reading a tile: waits while requests are at the limit. Throws StatusError: RESOURCE_EXHAUSTED, reason
  /// OVER_MEMORY_BUDGET, after wait_s.
  static void Admit();
  /// Call after reading a tile of that size.
  static void Count(std::int64_t bytes) noexcept;

  /// While this lives, tiles that the calling thread reads are released at once and do not count.
  class Passing {
   public:
    Passing() noexcept;
    ~Passing();
    Passing(const Passing&) = delete;
    Passing& operator=(const Passing&) = delete;

   private:
    PageHold* const suspended_;
  };

 private:
  PageHold own_;
  PageHold* const outer_;
};

}  // namespace dhpmap
