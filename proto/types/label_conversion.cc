// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/label_conversion.h"

#include <string>
#include <utility>
#include <vector>

#include "mapping/labels/class_names.h"

namespace dhpmap {
namespace {

SizeClass SizeFromProto(v1::LabelClass::Size size) {
  switch (size) {
    case v1::LabelClass::SMALL: return SizeClass::kSmall;
    case v1::LabelClass::LARGE: return SizeClass::kLarge;
    default: return SizeClass::kMedium;
  }
}

v1::LabelClass::Size SizeToProto(SizeClass size) {
  switch (size) {
    case SizeClass::kSmall: return v1::LabelClass::SMALL;
    case SizeClass::kMedium: return v1::LabelClass::MEDIUM;
    case SizeClass::kLarge: return v1::LabelClass::LARGE;
  }
  return v1::LabelClass::SIZE_CLASS_UNSPECIFIED;
}

LabelClass ClassFromProto(const v1::LabelClass& proto, const std::string& field, Status& bad) {
  constexpr std::uint32_t kMaxColor = 255;
  LabelClass result{.id = ClassId(static_cast<std::uint16_t>(proto.id())), .name = proto.name()};
  if (!ClassIdFromProto(proto.id()))
    bad.AddViolation(field + ".id", std::to_string(proto.id()) + " is not within 0 and 65534");
  if (proto.kind() == v1::LabelClass::THING) result.panoptic = Panoptic::kThing;
  else if (proto.kind() == v1::LabelClass::STUFF) result.panoptic = Panoptic::kStuff;
  else bad.AddViolation(field + ".kind", "must be THING or STUFF");
  if (!v1::LabelClass::Size_IsValid(proto.size())) bad.AddViolation(field + ".size", "is not a known value");
  result.size = SizeFromProto(proto.size());
  const v1::Color& color = proto.color();
  if (color.r() > kMaxColor || color.g() > kMaxColor || color.b() > kMaxColor) {
    bad.AddViolation(field + ".color", "r, g and b must be within 0 and 255");
  }
  result.color = {static_cast<std::uint8_t>(color.r()), static_cast<std::uint8_t>(color.g()),
                  static_cast<std::uint8_t>(color.b())};
  return result;
}

/// A label set calls its classes "classes[id]".
Result<LabelSet> InWireTerms(Result<LabelSet> label_set) {
  if (label_set.ok()) return label_set;
  Status bad = InvalidArgument(label_set.status().message()).WithReason(label_set.status().reason());
  for (const FieldViolation& violation : label_set.status().violations()) {
    bad.AddViolation("label_" + violation.field, violation.description);
  }
  return bad;
}

}  // namespace

std::optional<ClassId> ClassIdFromProto(std::int64_t id) {
  constexpr std::int64_t kMaxClassId = 65534;
  if (id < 0 || id > kMaxClassId) return std::nullopt;
  return ClassId(static_cast<std::uint16_t>(id));
}

Result<LabelSet> LabelSetFromProto(const google::protobuf::RepeatedPtrField<v1::LabelClass>& classes) {
  Status bad = InvalidArgument("the label set is not usable").WithReason("BAD_LABEL_SET");
  std::vector<LabelClass> result;
  for (int i = 0; i < classes.size(); ++i) {
    result.push_back(ClassFromProto(classes[i], "label_classes[" + std::to_string(i) + "]", bad));
  }
  if (!bad.violations().empty()) return bad;
  if (Status names = ValidateClassNames(result); !names.ok()) return InWireTerms(std::move(names));
  return InWireTerms(LabelSet::Create(std::move(result)));
}

v1::LabelClass::Kind ToProto(Panoptic panoptic) {
  switch (panoptic) {
    case Panoptic::kThing: return v1::LabelClass::THING;
    case Panoptic::kStuff: return v1::LabelClass::STUFF;
    case Panoptic::kUnknown: break;
  }
  return v1::LabelClass::PANOPTIC_KIND_UNSPECIFIED;
}

v1::Color ToProto(Color color) {
  v1::Color proto;
  proto.set_r(color.r);
  proto.set_g(color.g);
  proto.set_b(color.b);
  return proto;
}

v1::LabelClass ToProto(const LabelClass& label_class) {
  v1::LabelClass proto;
  proto.set_id(label_class.id.value);
  proto.set_name(label_class.name);
  proto.set_kind(ToProto(label_class.panoptic));
  proto.set_size(SizeToProto(label_class.size));
  *proto.mutable_color() = ToProto(label_class.color);
  return proto;
}

}  // namespace dhpmap
