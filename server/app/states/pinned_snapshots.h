// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "mapping/base/memory_count.h"
#include "mapping/base/mutex.h"
#include "mapping/map/map.h"
#include "server/base/byte_budget.h"

namespace dhpmap {

/// Pins states of maps for long reads while mapping continues. Memory that only pinned states need counts against the
/// budget for requests and answers. When that runs out, holders of the oldest states are asked to end. Thread-safe.
class PinnedSnapshots {
 public:
  using State = std::shared_ptr<const MapSnapshot>;
  /// For the map of a state: the state of the same revision if it is kept and counted elsewhere, else the present one;
  /// null if the map is deleted or closed.
  using PresentOf = std::function<State(const MapSnapshot&)>;
  /// Asks the holder to end, repeatedly until it does. On a thread of this class; must not block or destroy the Pin.
  using OnEvict = std::function<void()>;

  /// Pins a state during its lifetime; afterwards OnEvict is not called. Must not outlive the PinnedSnapshots.
  class Pin {
   public:
    ~Pin();
    Pin(const Pin&) = delete;
    Pin& operator=(const Pin&) = delete;

   private:
    friend class PinnedSnapshots;
    struct Held;
    explicit Pin(std::shared_ptr<Held> held);
    const std::shared_ptr<Held> held_;
  };

  /// `budget` outlives this.
  PinnedSnapshots(ByteBudget& budget, PresentOf present_of);
  ~PinnedSnapshots();
  PinnedSnapshots(const PinnedSnapshots&) = delete;
  PinnedSnapshots& operator=(const PinnedSnapshots&) = delete;

  /// Null if older states use half of the budget: their holders must end first. Without `on_evict` the holder is never
  /// asked to end.
  std::unique_ptr<Pin> TryPin(State state, OnEvict on_evict) DHPMAP_EXCLUDES(mutex_);

  /// Memory that only pinned states need, as of the last measurement, about every 0.2 s.
  [[nodiscard]] std::size_t bytes() const DHPMAP_EXCLUDES(mutex_);
  /// Measures now.
  void Look() DHPMAP_EXCLUDES(mutex_);

 private:
  using Held = Pin::Held;
  static std::size_t OldestEvictable(const std::vector<std::shared_ptr<Held>>& held,
                                     const std::vector<std::size_t>& bytes);
  [[nodiscard]] std::size_t BytesAlone(const std::vector<std::shared_ptr<Held>>& held, std::size_t i) const;
  /// Reserves that many bytes; false if the budget is exhausted.
  bool Count(std::size_t bytes) DHPMAP_EXCLUDES(mutex_);
  std::vector<std::shared_ptr<Held>> StillHeld() DHPMAP_EXCLUDES(mutex_);
  void LookAgainAndAgain() DHPMAP_EXCLUDES(mutex_);

  const std::size_t limit_bytes_;
  const PresentOf present_of_;
  Mutex look_mutex_ DHPMAP_ACQUIRED_BEFORE(mutex_);  ///< one measurement at a time
  mutable Mutex mutex_;
  CondVar wake_;
  ByteShare share_ DHPMAP_GUARDED_BY(mutex_);
  CountedBytes reserved_ DHPMAP_GUARDED_BY(mutex_){MemoryKind::kReserved};  ///< that share: the blocks count as such
  std::size_t bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::vector<std::weak_ptr<Held>> held_ DHPMAP_GUARDED_BY(mutex_);
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread looker_;
};

/// A snapshot with one submap of a state only, so that the rest can be freed. Null if there is no such submap.
std::shared_ptr<const MapSnapshot> OnlySubmap(const MapSnapshot& state, SubmapId submap);

}  // namespace dhpmap
