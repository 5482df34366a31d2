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

/// States of maps that are read for long while the maps go on: what only such a state still needs takes room of the
/// budget for requests and answers. When there is no more, those who hold the oldest are asked to let go. Thread-safe.
class HeldStates {
 public:
  using State = std::shared_ptr<const MapSnapshot>;
  /// Of the map that a state is of: the state of the same revision, if somebody keeps that anyway and counts it, else
  /// the present one; null if that map is gone, or closed.
  using PresentOf = std::function<State(const MapSnapshot&)>;
  /// Asks the holder to end; again with every look, if it has not. On a thread of ours; must not wait, or end the Hold.
  using LetGo = std::function<void()>;

  /// A state is held while this lives; afterwards LetGo is not called. Must not outlive the HeldStates.
  class Hold {
   public:
    ~Hold();
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    friend class HeldStates;
    struct Held;
    explicit Hold(std::shared_ptr<Held> held);
    const std::shared_ptr<Held> held_;
  };

  /// `budget` outlives this.
  HeldStates(ByteBudget& budget, PresentOf present_of);
  ~HeldStates();
  HeldStates(const HeldStates&) = delete;
  HeldStates& operator=(const HeldStates&) = delete;

  /// Null if older states have taken half of the budget: those who hold them shall come to an end first. Without
  /// `let_go` it is never asked to.
  std::unique_ptr<Hold> TryHold(State state, LetGo let_go) DHPMAP_EXCLUDES(mutex_);

  /// What only states that are held still need, at the last look. There is one every 0.2 s or so.
  [[nodiscard]] std::size_t bytes() const DHPMAP_EXCLUDES(mutex_);
  /// Looks now.
  void Look() DHPMAP_EXCLUDES(mutex_);

 private:
  using Held = Hold::Held;
  static std::size_t OldestThatCanLetGo(const std::vector<std::shared_ptr<Held>>& held,
                                        const std::vector<std::size_t>& bytes);
  [[nodiscard]] std::size_t BytesAlone(const std::vector<std::shared_ptr<Held>>& held, std::size_t i) const;
  /// Takes room for so much; false if there is none.
  bool Count(std::size_t bytes) DHPMAP_EXCLUDES(mutex_);
  std::vector<std::shared_ptr<Held>> StillHeld() DHPMAP_EXCLUDES(mutex_);
  void LookAgainAndAgain() DHPMAP_EXCLUDES(mutex_);

  const std::size_t limit_bytes_;
  const PresentOf present_of_;
  Mutex look_mutex_ DHPMAP_ACQUIRED_BEFORE(mutex_);  ///< one look at a time
  mutable Mutex mutex_;
  CondVar wake_;
  ByteShare share_ DHPMAP_GUARDED_BY(mutex_);
  CountedBytes reserved_ DHPMAP_GUARDED_BY(mutex_){MemoryKind::kReserved};  ///< that share: blocks are counted as such
  std::size_t bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::vector<std::weak_ptr<Held>> held_ DHPMAP_GUARDED_BY(mutex_);
  bool stopping_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::thread looker_;
};

/// One submap of a state alone, for who needs no other: what else there was can go. Null if there is no such submap.
std::shared_ptr<const MapSnapshot> OnlySubmap(const MapSnapshot& state, SubmapId submap);

}  // namespace dhpmap
