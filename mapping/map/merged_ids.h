// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/result.h"

namespace dhpmap {

/// A submap that was merged into another.
struct MergedId {
  SubmapId merged, into;
  friend bool operator==(const MergedId&, const MergedId&) = default;
};

/// The permanent record of merges: a request for a merged submap gets its successor. Chains are resolved: `into` was
/// not merged itself, but may have been deleted since. Copies share the list. Value type.
class MergedIds {
 public:
  MergedIds() = default;
  /// DATA_LOSS unless merged ids ascend, are unique and above 0, and chains are resolved.
  static Result<MergedIds> Create(std::vector<MergedId> list);

  /// The successor of a submap; nothing if it was not merged.
  [[nodiscard]] std::optional<SubmapId> Into(SubmapId merged) const;
  /// Neither may have been merged before; they differ.
  void Add(SubmapId merged, SubmapId into);

  /// By ascending merged id.
  [[nodiscard]] const std::vector<MergedId>& list() const;
  friend bool operator==(const MergedIds& a, const MergedIds& b) { return a.list_ == b.list_ || a.list() == b.list(); }

 private:
  std::shared_ptr<const std::vector<MergedId>> list_;  ///< null: empty
};

}  // namespace dhpmap
