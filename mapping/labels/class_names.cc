// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/labels/class_names.h"

#include <string>
#include <string_view>
#include <unordered_map>

namespace dhpmap {

Status ValidateClassNames(const std::vector<LabelClass>& classes) {
  Status bad = InvalidArgument("the names of the classes are not usable").WithReason("BAD_LABEL_SET");
  std::unordered_map<std::string_view, ClassId> holders;
  std::size_t num_bytes = 0;
  for (const LabelClass& label_class : classes) {
    const std::string field = "classes[" + std::to_string(label_class.id.value) + "].name";
    num_bytes += label_class.name.size();
    if (label_class.name.size() > kMaxClassNameBytes) {
      bad.AddViolation(field, "is longer than " + std::to_string(kMaxClassNameBytes) + " bytes");
    } else if (const auto [holder, is_new] = holders.emplace(label_class.name, label_class.id);
               !is_new && !label_class.name.empty()) {
      bad.AddViolation(field, "'" + label_class.name + "' is class " + std::to_string(holder->second.value) +
                                  " already: give each class a name of its own");
    }
  }
  if (num_bytes > kMaxClassNamesBytes) {
    bad.AddViolation("classes", "take " + std::to_string(num_bytes) + " bytes of names, of at most " +
                                    std::to_string(kMaxClassNamesBytes));
  }
  return bad.violations().empty() ? Status::Ok() : bad;
}

}  // namespace dhpmap
