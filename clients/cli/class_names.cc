// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/class_names.h"

#include <utility>
#include <vector>

#include "mapping/labels/class_names.h"

namespace dhpmap {
namespace {

/// Ids and names of a map's classes, all that is needed here. Names in older maps may be invalid for new ones.
Result<LabelSet> NamesOf(const v1::Map& map) {
  std::vector<LabelClass> classes;
  for (const v1::LabelClass& label_class : map.label_classes()) {
    classes.push_back({.id = ClassId(static_cast<std::uint16_t>(label_class.id())), .name = label_class.name()});
  }
  return LabelSet::Create(std::move(classes));
}

v1::LabelClass WithId(const v1::Map& map, ClassId id) {
  for (const v1::LabelClass& label_class : map.label_classes()) {
    if (label_class.id() == id.value) return label_class;
  }
  return {};
}

}  // namespace

std::string KindName(v1::LabelClass::Kind kind) {
  if (kind == v1::LabelClass::THING) return "thing";
  return kind == v1::LabelClass::STUFF ? "stuff" : "unknown";
}

Result<v1::LabelClass> FindClass(const v1::Map& map, const std::string& name_or_id) {
  DHPMAP_ASSIGN_OR_RETURN(const LabelSet classes, NamesOf(map));
  if (const LabelClass* named = FindClassByName(classes, name_or_id)) return WithId(map, named->id);
  std::string names;
  for (const LabelClass& label_class : classes.classes()) {
    if (std::to_string(label_class.id.value) == name_or_id) return WithId(map, label_class.id);
    names += (names.empty() ? "" : ", ") + label_class.name;
  }
  return NotFound("in " + map.name() + " " + NoSuchClassText(classes, name_or_id) +
                  (names.empty() ? "; it has no classes" : "\n  its classes: " + names));
}

}  // namespace dhpmap
