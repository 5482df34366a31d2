// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/submap_info.h"

#include <algorithm>

namespace dhpmap {

float SubmapInfo::ClassConfidence() const {
  std::uint64_t total = 0, own = 0;
  for (const ClassTotal& entry : class_counts) {
    total += entry.count;
    if (entry.id == class_id) own = entry.count;
  }
  return total == 0 ? 0.0f : static_cast<float>(static_cast<double>(own) / static_cast<double>(total));
}

bool SubmapInfo::IsSeenAs(ClassId wanted) const {
  if (class_id == wanted) return true;
  if (!class_is_fixed || class_counts.empty()) return false;
  std::uint64_t total = 0;
  for (const ClassTotal& entry : class_counts) total += entry.count;
  const auto most = std::max_element(class_counts.begin(), class_counts.end(),
                                     [](const ClassTotal& x, const ClassTotal& y) { return x.count < y.count; });
  return std::any_of(class_counts.begin(), class_counts.end(), [&](const ClassTotal& entry) {
    return entry.id == wanted && (entry.id == most->id || (entry.count > 0 && entry.count >= (total + 2) / 3));
  });
}

bool IsEdited(const SubmapInfo& info) { return info.is_placed || info.class_is_fixed || !info.display_name.empty(); }

}  // namespace dhpmap
