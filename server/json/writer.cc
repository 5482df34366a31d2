// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/writer.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <google/protobuf/util/json_util.h>

#include <array>
#include <charconv>
#include <cmath>

#include "server/json/base64.h"

namespace dhpmap::json {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

template <typename T>
void AppendNumber(T value, std::string* out) {
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  (void)error;  // 32 characters hold the shortest form of any number
  out->append(text.data(), end);
}

template <typename T>
void AppendReal(T value, std::string* out) {
  if (std::isfinite(value)) return AppendNumber(value, out);
  *out += std::isnan(value) ? "\"NaN\"" : value > 0 ? "\"Infinity\"" : "\"-Infinity\"";
}

template <typename T>
void AppendQuotedNumber(T value, std::string* out) {
  *out += '"';
  AppendNumber(value, out);
  *out += '"';
}

void AppendBytes(const FieldDescriptor& field, const std::string& value, std::string* out) {
  if (field.type() != FieldDescriptor::TYPE_BYTES) return AppendString(value, out);
  *out += '"';
  AppendBase64(value, out);
  *out += '"';
}

void AppendEnum(const FieldDescriptor& field, int number, std::string* out) {
  const auto* value = field.enum_type()->FindValueByNumber(number);
  if (value == nullptr) return AppendNumber(number, out);
  *out += '"';
  *out += value->name();
  *out += '"';
}

#define DHPMAP_GET(Type) (i < 0 ? r.Get##Type(m, &f) : r.GetRepeated##Type(m, &f, i))

/// Writes the value of a singular field (i < 0) or of element i.
void AppendValue(const Message& m, const FieldDescriptor& f, int i, std::string* out) {
  const auto& r = *m.GetReflection();
  switch (f.cpp_type()) {
    case FieldDescriptor::CPPTYPE_FLOAT: return AppendReal(DHPMAP_GET(Float), out);
    case FieldDescriptor::CPPTYPE_DOUBLE: return AppendReal(DHPMAP_GET(Double), out);
    case FieldDescriptor::CPPTYPE_INT32: return AppendNumber(DHPMAP_GET(Int32), out);
    case FieldDescriptor::CPPTYPE_UINT32: return AppendNumber(DHPMAP_GET(UInt32), out);
    case FieldDescriptor::CPPTYPE_INT64: return AppendQuotedNumber(DHPMAP_GET(Int64), out);
    case FieldDescriptor::CPPTYPE_UINT64: return AppendQuotedNumber(DHPMAP_GET(UInt64), out);
    case FieldDescriptor::CPPTYPE_BOOL: *out += DHPMAP_GET(Bool) ? "true" : "false"; return;
    case FieldDescriptor::CPPTYPE_ENUM: return AppendEnum(f, DHPMAP_GET(EnumValue), out);
    case FieldDescriptor::CPPTYPE_MESSAGE: return Append(DHPMAP_GET(Message), out);
    case FieldDescriptor::CPPTYPE_STRING: break;
  }
  std::string scratch;
  const std::string& text =
      i < 0 ? r.GetStringReference(m, &f, &scratch) : r.GetRepeatedStringReference(m, &f, i, &scratch);
  AppendBytes(f, text, out);
}
#undef DHPMAP_GET

void AppendMapEntry(const Message& entry, std::string* out) {
  const Descriptor& type = *entry.GetDescriptor();
  std::string key;
  AppendValue(entry, *type.map_key(), -1, &key);
  if (key.front() != '"') key = '"' + key + '"';
  *out += key;
  *out += ':';
  AppendValue(entry, *type.map_value(), -1, out);
}

void AppendRepeated(const Message& message, const FieldDescriptor& field, std::string* out) {
  const auto& reflection = *message.GetReflection();
  *out += field.is_map() ? '{' : '[';
  const int size = reflection.FieldSize(message, &field);
  for (int i = 0; i < size; ++i) {
    if (i > 0) *out += ',';
    if (field.is_map()) {
      AppendMapEntry(reflection.GetRepeatedMessage(message, &field, i), out);
    } else {
      AppendValue(message, field, i, out);
    }
  }
  *out += field.is_map() ? '}' : ']';
}

/// Writes types with a special form in proto3 JSON. False if the library cannot either (an Any of a type not linked
/// in).
bool AppendWellKnown(const Message& message, std::string* out) {
  google::protobuf::util::JsonPrintOptions options;
  options.always_print_primitive_fields = true;
  options.preserve_proto_field_names = true;
  std::string text;
  if (!google::protobuf::util::MessageToJsonString(message, &text, options).ok()) return false;
  *out += text;
  return true;
}

}  // namespace

void Append(const Message& message, std::string* out) {
  const Descriptor& type = *message.GetDescriptor();
  if (type.well_known_type() != Descriptor::WELLKNOWNTYPE_UNSPECIFIED && AppendWellKnown(message, out)) return;
  const auto& reflection = *message.GetReflection();
  bool first = true;
  *out += '{';
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (field.has_presence() && !reflection.HasField(message, &field)) continue;
    if (!first) *out += ',';
    first = false;
    *out += '"';
    *out += field.name();
    *out += "\":";
    AppendField(message, field, out);
  }
  *out += '}';
}

void AppendField(const Message& message, const FieldDescriptor& field, std::string* out) {
  if (field.is_repeated()) return AppendRepeated(message, field, out);
  if (field.has_presence() && !message.GetReflection()->HasField(message, &field)) {
    *out += "null";
    return;
  }
  AppendValue(message, field, -1, out);
}

void AppendString(std::string_view text, std::string* out) {
  constexpr std::string_view kHex = "0123456789abcdef";
  *out += '"';
  std::size_t run = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c >= 0x20 && c != '"' && c != '\\' && c != 0x7F) continue;
    *out += text.substr(run, i - run);
    run = i + 1;
    switch (c) {
      case '"': *out += "\\\""; break;
      case '\\': *out += "\\\\"; break;
      case '\n': *out += "\\n"; break;
      case '\r': *out += "\\r"; break;
      case '\t': *out += "\\t"; break;
      default:
        *out += "\\u00";
        *out += kHex[c >> 4];
        *out += kHex[c & 15];
    }
  }
  *out += text.substr(run);
  *out += '"';
}

}  // namespace dhpmap::json
