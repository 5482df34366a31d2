// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/option_fields.h"

#include "mapping/labels/class_names.h"
#include "proto/types/resource_names.h"
#include "server/app/states/no_such_submap.h"

namespace dhpmap {

Status BadOption(Reason reason, const std::string& field, const std::string& what) {
  return InvalidArgument("the options of the query are not usable").WithReason(reason).WithViolation(field, what);
}

Status NotTaken(const std::string& field) { return BadOption("BAD_FILTER", field, "has no meaning for this query"); }

std::string ItemOfOption(const std::string& list, int number) { return list + "[" + std::to_string(number) + "]"; }

Status CheckOptionLength(const std::string& list, int length) {
  if (length <= kMostOptionItems) return Status::Ok();
  return BadOption("BAD_FILTER", list, std::to_string(length) + " are more than " + std::to_string(kMostOptionItems));
}

Result<SubmapId> OptionSubmapFromProto(const std::string& name, const std::string& field, const MapSnapshot& map) {
  DHPMAP_ASSIGN_OR_RETURN(const SubmapName parsed, ParseSubmapName(name, field));
  if (parsed.map != map.info().name) return BadOption("BAD_FILTER", field, "is a submap of another map");
  if (map.Find(parsed.submap) == nullptr) {
    return NoSuchSubmap(map.info(), parsed.submap).WithViolation(field, "is not there");
  }
  return parsed.submap;
}

Result<ClassId> OptionClassFromProto(const std::string& name, const std::string& field, const LabelSet& label_set) {
  if (const LabelClass* found = FindClassByName(label_set, name)) return found->id;
  return BadOption("BAD_FILTER", field, NoSuchClassText(label_set, name));
}

}  // namespace dhpmap
