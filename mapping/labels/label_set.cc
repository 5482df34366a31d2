// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/labels/label_set.h"

#include <algorithm>
#include <limits>

namespace dhpmap {

Result<LabelSet> LabelSet::Create(std::vector<LabelClass> classes) {
  std::sort(classes.begin(), classes.end(), [](const LabelClass& a, const LabelClass& b) { return a.id < b.id; });
  Status bad = InvalidArgument("the label set is not usable").WithReason("BAD_LABEL_SET");
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const std::string field = "classes[" + std::to_string(classes[i].id.value) + "]";
    if (classes[i].id.value == std::numeric_limits<std::uint16_t>::max()) bad.AddViolation(field, "id is reserved");
    if (i > 0 && classes[i].id == classes[i - 1].id) bad.AddViolation(field, "id is given twice");
    if (classes[i].panoptic == Panoptic::kUnknown) bad.AddViolation(field, "is neither thing nor stuff");
  }
  if (!bad.violations().empty()) return bad;
  LabelSet set;
  set.classes_ = std::move(classes);
  return set;
}

const LabelClass* LabelSet::Find(ClassId id) const {
  const auto it = std::lower_bound(classes_.begin(), classes_.end(), id,
                                   [](const LabelClass& c, ClassId wanted) { return c.id < wanted; });
  return it != classes_.end() && it->id == id ? &*it : nullptr;
}

}  // namespace dhpmap
