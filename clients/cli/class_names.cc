// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/class_names.h"

#include <strings.h>

namespace dhpmap {

std::string KindName(v1::PanopticKind kind) {
  if (kind == v1::THING) return "thing";
  return kind == v1::STUFF ? "stuff" : "unknown";
}

Result<v1::LabelClass> FindClass(const v1::Map& map, const std::string& name_or_id) {
  for (const v1::LabelClass& label_class : map.label_classes()) {
    if (strcasecmp(label_class.name().c_str(), name_or_id.c_str()) == 0) return label_class;
  }
  std::string names;
  for (const v1::LabelClass& label_class : map.label_classes()) {
    if (std::to_string(label_class.id()) == name_or_id) return label_class;
    names += (names.empty() ? "" : ", ") + label_class.name();
  }
  return NotFound(map.name() + " has no class '" + name_or_id + "'" +
                  (names.empty() ? "; it has no classes" : "; it has " + names));
}

}  // namespace dhpmap
