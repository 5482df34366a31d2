// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/openapi_schema.h"

#include <google/protobuf/descriptor.h>

#include <set>

namespace dhpmap::gateway {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

void WriteReference(const std::string& name, json::Builder* out) {
  out->BeginObject().Member("$ref", "#/components/schemas/" + name).EndObject();
}

std::string_view WellKnownSchema(const Descriptor& type) {
  switch (type.well_known_type()) {
    case Descriptor::WELLKNOWNTYPE_UNSPECIFIED: return "";
    case Descriptor::WELLKNOWNTYPE_TIMESTAMP: return R"({"type":"string","format":"date-time"})";
    case Descriptor::WELLKNOWNTYPE_DURATION: return R"({"type":"string","example":"1.5s"})";
    case Descriptor::WELLKNOWNTYPE_FIELDMASK:
      return R"({"type":"string","description":"field names with commas between","example":"display_name,class_id"})";
    case Descriptor::WELLKNOWNTYPE_ANY:
      return R"({"type":"object","properties":{"@type":{"type":"string"}},"additionalProperties":true})";
    case Descriptor::WELLKNOWNTYPE_STRUCT: return R"({"type":"object","additionalProperties":true})";
    case Descriptor::WELLKNOWNTYPE_LISTVALUE: return R"({"type":"array","items":{}})";
    case Descriptor::WELLKNOWNTYPE_BOOLVALUE: return R"({"type":"boolean","nullable":true})";
    case Descriptor::WELLKNOWNTYPE_STRINGVALUE: return R"({"type":"string","nullable":true})";
    case Descriptor::WELLKNOWNTYPE_BYTESVALUE: return R"({"type":"string","format":"byte","nullable":true})";
    case Descriptor::WELLKNOWNTYPE_INT64VALUE:
    case Descriptor::WELLKNOWNTYPE_UINT64VALUE: return R"({"type":"string","format":"int64","nullable":true})";
    case Descriptor::WELLKNOWNTYPE_INT32VALUE:
    case Descriptor::WELLKNOWNTYPE_UINT32VALUE: return R"({"type":"integer","nullable":true})";
    case Descriptor::WELLKNOWNTYPE_FLOATVALUE:
    case Descriptor::WELLKNOWNTYPE_DOUBLEVALUE: return R"({"type":"number","nullable":true})";
    default: return "{}";  // google.protobuf.Value: anything
  }
}

std::string_view ScalarSchema(const FieldDescriptor& field) {
  switch (field.type()) {
    case FieldDescriptor::TYPE_BYTES: return R"({"type":"string","format":"byte"})";
    case FieldDescriptor::TYPE_STRING: return R"({"type":"string"})";
    case FieldDescriptor::TYPE_BOOL: return R"({"type":"boolean"})";
    case FieldDescriptor::TYPE_FLOAT: return R"({"type":"number","format":"float"})";
    case FieldDescriptor::TYPE_DOUBLE: return R"({"type":"number","format":"double"})";
    default: break;
  }
  switch (field.cpp_type()) {  // 64-bit numbers are strings in JSON; numbers are accepted as well
    case FieldDescriptor::CPPTYPE_INT64: return R"({"type":"string","format":"int64"})";
    case FieldDescriptor::CPPTYPE_UINT64: return R"({"type":"string","format":"uint64"})";
    case FieldDescriptor::CPPTYPE_UINT32:
      return R"({"type":"integer","format":"int64","minimum":0,"maximum":4294967295})";
    default: return R"({"type":"integer","format":"int32"})";
  }
}

}  // namespace

void OpenApiSchemas::WriteField(const FieldDescriptor& field, json::Builder* out) {
  if (field.is_map()) {
    out->BeginObject().Member("type", "object").Key("additionalProperties");
    WriteValue(*field.message_type()->map_value(), out);
    out->EndObject();
  } else if (field.is_repeated()) {
    out->BeginObject().Member("type", "array").Key("items");
    WriteValue(field, out);
    out->EndObject();
  } else {
    WriteValue(field, out);
  }
}

void OpenApiSchemas::WriteValue(const FieldDescriptor& field, json::Builder* out) {
  if (field.message_type() != nullptr) return WriteMessage(*field.message_type(), out);
  if (field.enum_type() == nullptr) {
    out->Raw(ScalarSchema(field));
    return;
  }
  enums_[field.enum_type()->full_name()] = field.enum_type();
  WriteReference(field.enum_type()->full_name(), out);
}

void OpenApiSchemas::WriteMessage(const Descriptor& type, json::Builder* out) {
  if (const std::string_view known = WellKnownSchema(type); !known.empty()) {
    out->Raw(known);
    return;
  }
  messages_[type.full_name()] = &type;
  WriteReference(type.full_name(), out);
}

void OpenApiSchemas::WriteDefinition(const Descriptor& type, json::Builder* out) {
  out->BeginObject().Member("type", "object").Key("properties").BeginObject();
  for (int i = 0; i < type.field_count(); ++i) {
    out->Key(type.field(i)->name());
    WriteField(*type.field(i), out);
  }
  out->EndObject();
  std::string choices;
  for (int i = 0; i < type.real_oneof_decl_count(); ++i) {
    const auto* oneof = type.oneof_decl(i);
    choices += choices.empty() ? "At most one of " : "; at most one of ";
    for (int k = 0; k < oneof->field_count(); ++k) choices += (k > 0 ? ", " : "") + oneof->field(k)->name();
  }
  if (!choices.empty()) out->Member("description", choices + ".");
  out->EndObject();
}

void OpenApiSchemas::WriteAll(json::Builder* out) {
  std::set<std::string> written;
  for (bool found_more = true; found_more;) {  // writing one may add further references
    found_more = false;
    const auto snapshot = messages_;
    for (const auto& [name, type] : snapshot) {
      if (!written.insert(name).second) continue;
      found_more = true;
      out->Key(name);
      WriteDefinition(*type, out);
    }
  }
  for (const auto& [name, type] : enums_) {
    out->Key(name).BeginObject().Member("type", "string").Key("enum").BeginArray();
    for (int i = 0; i < type->value_count(); ++i) out->String(type->value(i)->name());
    out->EndArray().EndObject();
  }
}

}  // namespace dhpmap::gateway
