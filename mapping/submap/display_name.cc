// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/submap/display_name.h"

#include <algorithm>

namespace dhpmap {
namespace {

std::string NameAfter(const LabelClass& label_class, SubmapId id) {
  if (label_class.panoptic != Panoptic::kThing) return label_class.name;
  return label_class.name + " " + std::to_string(id.value);
}

bool IsOfTheMapsMaking(const SubmapInfo& info, const LabelSet& labels) {
  const auto& classes = labels.classes();
  return info.display_name.empty() || std::any_of(classes.begin(), classes.end(), [&info](const LabelClass& c) {
           return c.panoptic == info.panoptic && info.display_name == NameAfter(c, info.id);
         });
}

}  // namespace

std::string DisplayNameOf(const SubmapInfo& info, const LabelSet& labels) {
  if (!IsOfTheMapsMaking(info, labels)) return info.display_name;
  if (info.panoptic == Panoptic::kUnknown) return "unknown";
  const LabelClass* label_class = labels.Find(info.class_id);
  return label_class == nullptr ? "submap " + std::to_string(info.id.value) : NameAfter(*label_class, info.id);
}

}  // namespace dhpmap
