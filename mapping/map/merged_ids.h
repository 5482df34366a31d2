// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/base/result.h"

namespace dhpmap {

/// A submap that is now a part of another.
struct MergedId {
  SubmapId merged, into;
  friend bool operator==(const MergedId&, const MergedId&) = default;
};

/// What became of the submaps of a map that were merged into others, for ever: whoever asks for one of them is told
/// which it is now. Chains are resolved: `into` was itself not merged, though it may have been deleted since. Copies
/// share the list. Value type.
class MergedIds {
 public:
  MergedIds() = default;
  /// DATA_LOSS unless they are by ascending merged id and each once, larger than 0, and chains are resolved.
  static Result<MergedIds> Create(std::vector<MergedId> list);

  /// What the submap is a part of; nothing if it was not merged.
  [[nodiscard]] std::optional<SubmapId> Into(SubmapId merged) const;
  /// `merged` was not merged before, nor was `into`, which is another.
  void Add(SubmapId merged, SubmapId into);

  /// By ascending merged id.
  [[nodiscard]] const std::vector<MergedId>& list() const;
  friend bool operator==(const MergedIds& a, const MergedIds& b) { return a.list_ == b.list_ || a.list() == b.list(); }

 private:
  std::shared_ptr<const std::vector<MergedId>> list_;  ///< null: empty
};

}  // namespace dhpmap
