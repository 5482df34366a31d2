// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/map_conversion.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <string>
#include <string_view>
#include <utility>

#include "server/grpc/resource_names.h"

namespace dhpmap {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// The message that holds the field a dotted key names, and the field. Writes make the messages on the way.
template <typename AnyMessage>
std::pair<AnyMessage*, const FieldDescriptor*> Locate(AnyMessage& root, std::string_view key) {
  AnyMessage* message = &root;
  while (true) {
    const std::size_t dot = key.find('.');
    const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(std::string(key.substr(0, dot)));
    GOOGLE_CHECK(field != nullptr) << "proto MapConfig lacks " << key;
    if (dot == std::string_view::npos) return {message, field};
    if constexpr (std::is_const_v<AnyMessage>) message = &message->GetReflection()->GetMessage(*message, field);
    else message = message->GetReflection()->MutableMessage(message, field);
    key.remove_prefix(dot + 1);
  }
}

void Read(const Message& message, const FieldDescriptor* field, double& value, Status&) {
  value = message.GetReflection()->GetDouble(message, field);
}
void Read(const Message& message, const FieldDescriptor* field, int& value, Status&) {
  value = message.GetReflection()->GetInt32(message, field);
}
void Read(const Message& message, const FieldDescriptor* field, bool& value, Status&) {
  value = message.GetReflection()->GetBool(message, field);
}
void Read(const Message& message, const FieldDescriptor* field, Weighting& value, Status& bad) {
  const int number = message.GetReflection()->GetEnumValue(message, field);
  if (number == v1::WEIGHTING_UNSPECIFIED) return;
  for (const Weighting known :
       {Weighting::kConstant, Weighting::kInverseDepthSquared, Weighting::kInverseRangeSquared}) {
    const auto* name = field->enum_type()->FindValueByName(std::string(WeightingName(known)));
    if (name != nullptr && name->number() == number) {
      value = known;
      return;
    }
  }
  bad.AddViolation("config.integration." + field->name(), std::to_string(number) + " is not a known value");
}

void Write(Message& message, const FieldDescriptor* field, double value) {
  message.GetReflection()->SetDouble(&message, field, value);
}
void Write(Message& message, const FieldDescriptor* field, int value) {
  message.GetReflection()->SetInt32(&message, field, value);
}
void Write(Message& message, const FieldDescriptor* field, bool value) {
  message.GetReflection()->SetBool(&message, field, value);
}
void Write(Message& message, const FieldDescriptor* field, Weighting value) {
  const auto* name = field->enum_type()->FindValueByName(std::string(WeightingName(value)));
  GOOGLE_CHECK(name != nullptr) << "proto Weighting lacks " << WeightingName(value);
  message.GetReflection()->SetEnum(&message, field, name);
}

SizeClass SizeFromProto(v1::SizeClass size) {
  switch (size) {
    case v1::SMALL: return SizeClass::kSmall;
    case v1::LARGE: return SizeClass::kLarge;
    default: return SizeClass::kMedium;
  }
}

v1::SizeClass ToProto(SizeClass size) {
  switch (size) {
    case SizeClass::kSmall: return v1::SMALL;
    case SizeClass::kMedium: return v1::MEDIUM;
    case SizeClass::kLarge: return v1::LARGE;
  }
  return v1::SIZE_CLASS_UNSPECIFIED;
}

LabelClass ClassFromProto(const v1::LabelClass& proto, const std::string& field, Status& bad) {
  constexpr std::uint32_t kMaxId = 65534, kMaxColor = 255;
  LabelClass result{.id = ClassId(static_cast<std::uint16_t>(proto.id())), .name = proto.name()};
  if (proto.id() > kMaxId) bad.AddViolation(field + ".id", std::to_string(proto.id()) + " is not within 0 and 65534");
  if (proto.kind() == v1::THING) result.panoptic = Panoptic::kThing;
  else if (proto.kind() == v1::STUFF) result.panoptic = Panoptic::kStuff;
  else bad.AddViolation(field + ".kind", "must be THING or STUFF");
  if (!v1::SizeClass_IsValid(proto.size())) bad.AddViolation(field + ".size", "is not a known value");
  result.size = SizeFromProto(proto.size());
  const v1::Color& color = proto.color();
  if (color.r() > kMaxColor || color.g() > kMaxColor || color.b() > kMaxColor) {
    bad.AddViolation(field + ".color", "r, g and b must be within 0 and 255");
  }
  result.color = {static_cast<std::uint8_t>(color.r()), static_cast<std::uint8_t>(color.g()),
                  static_cast<std::uint8_t>(color.b())};
  return result;
}

}  // namespace

Status MergeConfig(const v1::MapConfig& proto, MapConfig& config) {
  Status bad = InvalidArgument("the map config is not usable").WithReason("BAD_CONFIG");
  const Message& root = proto;
  VisitFields(config, [&root, &bad](const char* key, auto& value, double, double, const char*) {
    const auto [message, field] = Locate(root, key);
    if (message->GetReflection()->HasField(*message, field)) Read(*message, field, value, bad);
  });
  return bad.violations().empty() ? Status::Ok() : bad;
}

v1::MapConfig ToProto(const MapConfig& config) {
  v1::MapConfig proto;
  Message& root = proto;
  VisitFields(config, [&root](const char* key, const auto& value, double, double, const char*) {
    const auto [message, field] = Locate(root, key);
    Write(*message, field, value);
  });
  return proto;
}

Result<LabelSet> LabelSetFromProto(const google::protobuf::RepeatedPtrField<v1::LabelClass>& classes) {
  Status bad = InvalidArgument("the label set is not usable").WithReason("BAD_LABEL_SET");
  std::vector<LabelClass> result;
  for (int i = 0; i < classes.size(); ++i) {
    result.push_back(ClassFromProto(classes[i], "label_classes[" + std::to_string(i) + "]", bad));
  }
  if (!bad.violations().empty()) return bad;
  return LabelSet::Create(std::move(result));
}

v1::PanopticKind ToProto(Panoptic panoptic) {
  switch (panoptic) {
    case Panoptic::kThing: return v1::THING;
    case Panoptic::kStuff: return v1::STUFF;
    case Panoptic::kUnknown: break;
  }
  return v1::PANOPTIC_KIND_UNSPECIFIED;
}

v1::Color ToProto(Color color) {
  v1::Color proto;
  proto.set_r(color.r);
  proto.set_g(color.g);
  proto.set_b(color.b);
  return proto;
}

v1::Map ToProto(const MapSummary& map) {
  v1::Map proto;
  proto.set_name(MapResourceName(map.info.name));
  proto.set_display_name(map.info.display_name);
  *proto.mutable_config() = ToProto(map.info.config);
  for (const LabelClass& c : map.info.label_set->classes()) {
    v1::LabelClass* label = proto.add_label_classes();
    label->set_id(c.id.value);
    label->set_name(c.name);
    label->set_kind(ToProto(c.panoptic));
    label->set_size(ToProto(c.size));
    *label->mutable_color() = ToProto(c.color);
  }
  proto.set_revision(map.info.revision);
  proto.set_num_frames(map.info.num_frames);
  proto.set_num_submaps(map.num_submaps);
  proto.set_create_time_ns(map.info.create_time_ns);
  proto.set_update_time_ns(map.info.update_time_ns);
  return proto;
}

}  // namespace dhpmap
