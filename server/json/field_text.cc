// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/field_text.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <google/protobuf/util/json_util.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <system_error>

#include "mapping/base/utf8.h"
#include "server/json/base64.h"
#include "server/json/writer.h"

namespace dhpmap::json {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

template <typename T>
std::optional<T> ParseExactly(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Parses digits, or a fraction or exponent with a whole value ("1e3", "2.0"), as proto3 JSON allows.
template <typename T>
std::optional<T> ParseInteger(std::string_view text) {
  if (const auto exact = ParseExactly<T>(text)) return exact;
  if (text.find_first_of(".eE") == std::string_view::npos) return std::nullopt;
  const auto real = ParseExactly<double>(text);
  constexpr double kExact = 9007199254740992.0;  // 2^53: a double represents every integer up to it
  if (!real || std::trunc(*real) != *real || std::abs(*real) > kExact) return std::nullopt;
  if (*real < static_cast<double>(std::numeric_limits<T>::min())) return std::nullopt;
  if (*real > static_cast<double>(std::numeric_limits<T>::max())) return std::nullopt;
  return static_cast<T>(*real);
}

template <typename T>
std::optional<T> ParseReal(std::string_view text) {
  if (text == "NaN") return std::numeric_limits<T>::quiet_NaN();
  if (text == "Infinity") return std::numeric_limits<T>::infinity();
  if (text == "-Infinity") return -std::numeric_limits<T>::infinity();
  if (text.find_first_of("nN") != std::string_view::npos) return std::nullopt;  // from_chars accepts "nan" and "inf"
  if (const auto value = ParseExactly<T>(text)) return value;
  // from_chars reports underflow as out of range; accept it as (nearly) zero. Not from_chars for long double, which
  // reads past the end of the text (GCC 12).
  double wide = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), wide);
  if (error == std::errc::invalid_argument || end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) wide = std::strtod(std::string(text).c_str(), nullptr);
  if (std::abs(wide) < 1) return static_cast<T>(wide);
  return std::nullopt;
}

std::optional<bool> ParseBool(std::string_view text) {
  if (text == "true") return true;
  if (text == "false") return false;
  return std::nullopt;
}

std::optional<int> ParseEnum(const FieldDescriptor& field, std::string_view text) {
  const auto* value = field.enum_type()->FindValueByName(std::string(text));
  if (value != nullptr) return value->number();
  return ParseInteger<std::int32_t>(text);
}

std::string SetBytes(const FieldDescriptor& field, std::string_view text, Message* message) {
  const auto* reflection = message->GetReflection();
  std::string value;
  if (field.type() == FieldDescriptor::TYPE_BYTES) {
    auto decoded = DecodeBase64(text);
    if (!decoded) return "expected base64";
    value = std::move(*decoded);
  } else {
    if (FindInvalidUtf8(text) != std::string_view::npos) return "expected UTF-8";
    value = text;
  }
  if (field.is_repeated()) {
    reflection->AddString(message, &field, std::move(value));
  } else {
    reflection->SetString(message, &field, std::move(value));
  }
  return "";
}

/// Sets the field to `parsed` by the setter of its type, or returns `expected`.
#define DHPMAP_SET_SCALAR(Type, parsed, expected)                            \
  {                                                                          \
    const auto value = (parsed);                                             \
    if (!value) return expected;                                             \
    if (field.is_repeated()) reflection->Add##Type(message, &field, *value); \
    else reflection->Set##Type(message, &field, *value);                     \
    return "";                                                               \
  }

bool IsWrapper(const Descriptor& type) {
  return type.file()->package() == "google.protobuf" && type.name().ends_with("Value") && type.field_count() == 1 &&
         type.field(0)->name() == "value";
}

Status Violation(const FieldPath& path, const std::string& what) {
  const std::string name = ToString(path);
  return InvalidArgument(name + ": " + what).WithViolation(name, what);
}

}  // namespace

const FieldDescriptor* FindField(const Descriptor& type, std::string_view name) {
  const std::string key(name);
  if (const auto* field = type.FindFieldByName(key)) return field;
  if (const auto* field = type.FindFieldByCamelcaseName(key)) return field;
  for (int i = 0; i < type.field_count(); ++i) {
    if (type.field(i)->json_name() == key) return type.field(i);
  }
  return nullptr;
}

Status ResolveFieldPath(const Descriptor& type, std::string_view dotted, FieldPath* path) {
  path->clear();
  const Descriptor* parent = &type;
  std::string_view rest = dotted;
  while (true) {
    const std::size_t dot = rest.find('.');
    const std::string_view name = rest.substr(0, dot);
    const FieldDescriptor* field = parent == nullptr ? nullptr : FindField(*parent, name);
    if (field == nullptr) {
      const std::string owner = parent == nullptr ? path->back()->full_name() : parent->full_name();
      return InvalidArgument(owner + " has no field '" + std::string(name) + "'")
          .WithViolation(std::string(dotted), "no such field");
    }
    path->push_back(field);
    if (dot == std::string_view::npos) return Status::Ok();
    rest.remove_prefix(dot + 1);
    parent = field->is_repeated() ? nullptr : field->message_type();
  }
}

std::string ToString(const FieldPath& path) {
  std::string out;
  for (const auto* field : path) {
    if (!out.empty()) out += '.';
    out += field->name();
  }
  return out;
}

std::string SetScalarFromText(const FieldDescriptor& field, std::string_view text, Message* message) {
  const auto* reflection = message->GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_FLOAT: DHPMAP_SET_SCALAR(Float, ParseReal<float>(text), "expected a number (float)")
    case FieldDescriptor::CPPTYPE_DOUBLE: DHPMAP_SET_SCALAR(Double, ParseReal<double>(text), "expected a number")
    case FieldDescriptor::CPPTYPE_INT32:
      DHPMAP_SET_SCALAR(Int32, ParseInteger<std::int32_t>(text), "expected an integer of 32 bits")
    case FieldDescriptor::CPPTYPE_INT64:
      DHPMAP_SET_SCALAR(Int64, ParseInteger<std::int64_t>(text), "expected an integer of 64 bits")
    case FieldDescriptor::CPPTYPE_UINT32:
      DHPMAP_SET_SCALAR(UInt32, ParseInteger<std::uint32_t>(text), "expected a non-negative integer of 32 bits")
    case FieldDescriptor::CPPTYPE_UINT64:
      DHPMAP_SET_SCALAR(UInt64, ParseInteger<std::uint64_t>(text), "expected a non-negative integer of 64 bits")
    case FieldDescriptor::CPPTYPE_BOOL: DHPMAP_SET_SCALAR(Bool, ParseBool(text), "expected true or false")
    case FieldDescriptor::CPPTYPE_ENUM:
      DHPMAP_SET_SCALAR(EnumValue, ParseEnum(field, text), "expected a value of " + field.enum_type()->full_name())
    case FieldDescriptor::CPPTYPE_STRING: return SetBytes(field, text, message);
    case FieldDescriptor::CPPTYPE_MESSAGE: break;
  }
  return "expected a message";
}
#undef DHPMAP_SET_SCALAR

Status SetFieldFromText(const FieldPath& path, std::string_view text, Message* message) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    message = message->GetReflection()->MutableMessage(message, path[i]);
  }
  const FieldDescriptor& field = *path.back();
  if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
    const std::string wrong = SetScalarFromText(field, text, message);
    return wrong.empty() ? Status::Ok() : Violation(path, wrong + ", not '" + std::string(text.substr(0, 64)) + "'");
  }
  const auto* reflection = message->GetReflection();
  if (field.is_map()) return Violation(path, "a map cannot be given in the query");
  Message* inner =
      field.is_repeated() ? reflection->AddMessage(message, &field) : reflection->MutableMessage(message, &field);
  const Descriptor& type = *inner->GetDescriptor();
  if (type.full_name() == "google.protobuf.FieldMask") {
    SetFieldMask(text, inner);
    return Status::Ok();
  }
  if (IsWrapper(type)) {
    const std::string wrong = SetScalarFromText(*type.field(0), text, inner);
    return wrong.empty() ? Status::Ok() : Violation(path, wrong);
  }
  if (type.full_name() == "google.protobuf.Timestamp" || type.full_name() == "google.protobuf.Duration") {
    std::string quoted;
    AppendString(text, &quoted);
    if (google::protobuf::util::JsonStringToMessage(quoted, inner).ok()) return Status::Ok();
    return Violation(path, "expected a " + type.full_name());
  }
  return Violation(path, "a message cannot be given as one value: name its fields, as in " + field.name() + "." +
                             (type.field_count() > 0 ? type.field(0)->name() : std::string("field")));
}

std::string ToSnakeCase(std::string_view name) {
  std::string out;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') {
      out += '_';
      out += static_cast<char>(c - 'A' + 'a');
    } else {
      out += c;
    }
  }
  return out;
}

void SetFieldMask(std::string_view text, Message* mask) {
  const FieldDescriptor* paths = mask->GetDescriptor()->FindFieldByName("paths");
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view part = text.substr(0, comma);
    if (!part.empty()) mask->GetReflection()->AddString(mask, paths, ToSnakeCase(part));
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
}

}  // namespace dhpmap::json
