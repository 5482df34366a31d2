// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mapping/base/grid.h"
#include "mapping/base/mutex.h"
#include "mapping/surfaces/near_field.h"
#include "mapping/surfaces/surface_change.h"
#include "mapping/surfaces/surface_ledger.h"

namespace dhpmap {

/// The near fields of a map, from state to state: one serves until something comes nearer to it than what it holds, or
/// some of that goes. What goes of others is no loss: what it holds was as near.
/// States have numbers, in the order in which they were first asked about. Thread-safe: nobody waits while another
/// compares a field with what has changed or frees it, only for half of them to be chosen where there are too many.
class FieldStore {
 public:
  explicit FieldStore(std::shared_ptr<SurfaceLedger> ledger) : ledger_(std::move(ledger)) {}
  ~FieldStore() = default;
  FieldStore(const FieldStore&) = delete;
  FieldStore& operator=(const FieldStore&) = delete;

  /// The first state.
  static constexpr std::uint64_t kFirst = 0;
  /// The number of a state that differs from `before` in these. Nothing if another came after that.
  std::optional<std::uint64_t> Append(std::uint64_t before, std::vector<SurfaceChange> changed) DHPMAP_EXCLUDES(mutex_);

  /// Null: there is none that is right in that state.
  std::shared_ptr<const NearField> Find(BlockIndex block, std::uint64_t state) DHPMAP_EXCLUDES(mutex_);
  /// Keeps a field made of a state; those not asked for longest go if there are too many.
  void Put(BlockIndex block, std::uint64_t state, std::shared_ptr<const NearField> field) DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] const std::shared_ptr<SurfaceLedger>& ledger() const { return ledger_; }
  [[nodiscard]] std::size_t num_fields() const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Entry {
    std::shared_ptr<const NearField> field;
    std::uint64_t made = 0, checked = 0;  ///< right in the states from one to the other
    std::uint64_t last_used = 0;
  };
  using Changes = std::shared_ptr<const std::vector<SurfaceChange>>;
  using Fields = std::vector<std::shared_ptr<const NearField>>;
  /// What has changed from a state an entry is right in to a later one; nothing if that is forgotten.
  [[nodiscard]] std::optional<std::vector<Changes>> ChangesSince(const Entry& entry, std::uint64_t state) const
      DHPMAP_REQUIRES(mutex_);
  /// Leaves what goes to the caller, to be freed without the mutex.
  void DropOldest(Fields& dropped) DHPMAP_REQUIRES(mutex_);

  const std::shared_ptr<SurfaceLedger> ledger_;
  mutable Mutex mutex_;
  std::unordered_map<BlockIndex, Entry, BlockIndexHash> entries_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::uint64_t last_ DHPMAP_GUARDED_BY(mutex_) = kFirst;
  std::deque<Changes> changes_ DHPMAP_GUARDED_BY(mutex_);  ///< up to the last state
};

}  // namespace dhpmap
