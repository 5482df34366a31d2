// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/labels/class_names.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <unordered_map>

#include "mapping/base/near_name.h"

namespace dhpmap {
namespace {

std::string_view Trimmed(std::string_view name) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t begin = name.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return name.substr(begin, name.find_last_not_of(kBlanks) + 1 - begin);
}

bool IsSame(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

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

const LabelClass* FindClassByName(const LabelSet& label_set, std::string_view name) {
  const std::string_view wanted = Trimmed(name);
  if (wanted.empty()) return nullptr;
  const LabelClass* same = nullptr;
  for (const LabelClass& label_class : label_set.classes()) {
    if (label_class.name == name) return &label_class;
    if (same == nullptr && IsSame(Trimmed(label_class.name), wanted)) same = &label_class;
  }
  return same;
}

std::string NoSuchClassText(const LabelSet& label_set, std::string_view name, const Status& told) {
  constexpr std::size_t kMostQuoted = 80, kMostNames = 1000, kEnough = 4;
  const std::string text = "there is no class '" + std::string(name.substr(0, kMostQuoted)) + "'";
  if (told.violations().size() >= kEnough) return text;
  std::vector<std::string> names;
  for (const LabelClass& label_class : label_set.classes()) {
    if (names.size() < kMostNames) names.push_back(label_class.name);
  }
  return text + DidYouMean(Trimmed(name), names);
}

}  // namespace dhpmap
