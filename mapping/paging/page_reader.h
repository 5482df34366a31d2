// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace dhpmap {

/// How much requests may hold in memory together of tiles that were left on the disk. What a request has read stays for
/// as long as it holds its state of the map, whatever is let go of meanwhile.
struct PageReaderLimit {
  std::int64_t bytes = 0;  ///< 0: any number
  double wait_s = 0.05;    ///< for other requests to end, before one is refused: a thread waits that others need
};
/// Of the process, as PageCounts; thread-safe.
void SetPageReaderLimit(const PageReaderLimit& limit);
/// What requests hold now.
std::int64_t PageReaderBytes();
/// How many threads wait now for other requests to end.
int NumPageReadersWaiting();

/// What a request holds, until the end of its life.
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

/// Of a request, on the thread that makes it: the tiles that this thread reads from the disk are held by the request.
/// Threads without one, as those that fuse and refine, read what they need.
class PageReader {
 public:
  /// Of one that ends with this.
  PageReader() noexcept : PageReader(own_) {}
  /// Of one that goes on elsewhere, such as a stream.
  explicit PageReader(PageHold& hold) noexcept;
  ~PageReader();
  PageReader(const PageReader&) = delete;
  PageReader& operator=(const PageReader&) = delete;

  /// That of the calling thread, for others that make a part of its request while it waits for them; null: none.
  [[nodiscard]] static PageHold* Current() noexcept;
  /// For such a thread; null: it reads what it needs.
  explicit PageReader(PageHold* hold) noexcept;

  /// Before the calling thread reads a tile: waits where requests hold as much as they may. Throws StatusError:
  /// RESOURCE_EXHAUSTED, reason OVER_MEMORY_BUDGET, if that does not help.
  static void Admit();
  /// After it has read one of so many bytes.
  static void Count(std::int64_t bytes) noexcept;

  /// What the calling thread reads during the life of this goes again at once, and counts for nothing.
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
