// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/merged_ids.h"

#include <algorithm>
#include <utility>

namespace dhpmap {
namespace {

std::vector<MergedId>::const_iterator PlaceOfMerged(const std::vector<MergedId>& list, SubmapId merged) {
  return std::lower_bound(list.begin(), list.end(), merged,
                          [](const MergedId& entry, SubmapId wanted) { return entry.merged < wanted; });
}

}  // namespace

Result<MergedIds> MergedIds::Create(std::vector<MergedId> list) {
  MergedIds created;
  if (list.empty()) return created;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].merged == kUnknownSubmap || (i > 0 && !(list[i - 1].merged < list[i].merged))) {
      return DataLoss("the ids of what was merged are damaged");
    }
  }
  created.list_ = std::make_shared<const std::vector<MergedId>>(std::move(list));
  for (const MergedId& entry : created.list()) {
    if (entry.into == kUnknownSubmap || created.Into(entry.into)) {
      return DataLoss("what was merged is said to be a part of what is none");
    }
  }
  return created;
}

std::optional<SubmapId> MergedIds::Into(SubmapId merged) const {
  const auto found = PlaceOfMerged(list(), merged);
  if (found == list().end() || found->merged != merged) return std::nullopt;
  return found->into;
}

void MergedIds::Add(SubmapId merged, SubmapId into) {
  std::vector<MergedId> list = this->list();
  for (MergedId& entry : list) {
    if (entry.into == merged) entry.into = into;
  }
  list.insert(PlaceOfMerged(list, merged), {merged, into});
  list_ = std::make_shared<const std::vector<MergedId>>(std::move(list));
}

const std::vector<MergedId>& MergedIds::list() const {
  static const std::vector<MergedId> none;
  return list_ != nullptr ? *list_ : none;
}

}  // namespace dhpmap
