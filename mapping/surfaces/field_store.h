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

/// The near fields of a map over its states. A field stays valid until a surface appears nearer than its triangles, or
/// one of its triangles is removed. Removal of other surfaces does not matter, because its triangles were as near.
/// States are numbered in the order of their first query. Thread-safe. Threads do not wait while another compares a
/// field with changes or frees it; only the choice of the half to evict, if there are too many, holds the mutex.
class FieldStore {
 public:
  explicit FieldStore(std::shared_ptr<SurfaceLedger> ledger) : ledger_(std::move(ledger)) {}
  ~FieldStore() = default;
  FieldStore(const FieldStore&) = delete;
  FieldStore& operator=(const FieldStore&) = delete;

  /// The first state.
  static constexpr std::uint64_t kFirst = 0;
  /// The number of a new state that differs from `before` by `changed`. Nothing if `before` already has a successor.
  std::optional<std::uint64_t> Append(std::uint64_t before, std::vector<SurfaceChange> changed) DHPMAP_EXCLUDES(mutex_);

  /// Null: no stored field is valid in that state.
  std::shared_ptr<const NearField> Find(BlockIndex block, std::uint64_t state) DHPMAP_EXCLUDES(mutex_);
  /// Stores a field that was computed for a state. If there are too many, the least recently used are evicted.
  void Put(BlockIndex block, std::uint64_t state, std::shared_ptr<const NearField> field) DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] const std::shared_ptr<SurfaceLedger>& ledger() const { return ledger_; }
  [[nodiscard]] std::size_t num_fields() const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Entry {
    std::shared_ptr<const NearField> field;
    std::uint64_t made = 0, checked = 0;  ///< valid in the states from `made` to `checked`
    std::uint64_t last_used = 0;
  };
  using Changes = std::shared_ptr<const std::vector<SurfaceChange>>;
  using Fields = std::vector<std::shared_ptr<const NearField>>;
  /// The changes from a state in which an entry is valid to a later state; nothing if they are no longer stored.
  [[nodiscard]] std::optional<std::vector<Changes>> ChangesSince(const Entry& entry, std::uint64_t state) const
      DHPMAP_REQUIRES(mutex_);
  /// Moves the evicted fields to `dropped`, which the caller frees without the mutex.
  void DropOldest(Fields& dropped) DHPMAP_REQUIRES(mutex_);

  const std::shared_ptr<SurfaceLedger> ledger_;
  mutable Mutex mutex_;
  std::unordered_map<BlockIndex, Entry, BlockIndexHash> entries_ DHPMAP_GUARDED_BY(mutex_);
  std::size_t bytes_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::uint64_t last_ DHPMAP_GUARDED_BY(mutex_) = kFirst;
  std::deque<Changes> changes_ DHPMAP_GUARDED_BY(mutex_);  ///< up to the last state
};

}  // namespace dhpmap
