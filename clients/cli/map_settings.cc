// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/map_settings.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mapping/base/near_name.h"

namespace dhpmap {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

void CollectKeys(const Descriptor& message, const std::string& prefix, std::vector<std::string>& keys) {
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor& field = *message.field(i);
    if (field.options().deprecated()) continue;
    const std::string key = prefix + field.name();
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) CollectKeys(*field.message_type(), key + ".", keys);
    else keys.push_back(key);
  }
}

Status UnknownKey(const std::string& key) {
  const std::vector<std::string> keys = SettingKeys();
  std::string message = "there is no setting '" + key + "'" + DidYouMean(key, keys) + "\n  settings are";
  for (const std::string& known : keys) message += " " + known;
  return InvalidArgument(message);
}

template <typename Number>
bool Parse(const std::string& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// "inverse_depth_squared" -> "INVERSE_DEPTH_SQUARED".
std::string EnumName(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// False if the text is not a value of the field's type.
bool SetScalar(Message& message, const FieldDescriptor& field, const std::string& text) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: {
      double value = 0;
      if (!Parse(text, value) || !std::isfinite(value)) return false;
      reflection.SetDouble(&message, &field, value);
      return true;
    }
    case FieldDescriptor::CPPTYPE_INT32: {
      std::int32_t value = 0;
      if (!Parse(text, value)) return false;
      reflection.SetInt32(&message, &field, value);
      return true;
    }
    case FieldDescriptor::CPPTYPE_BOOL: {
      if (text != "true" && text != "false") return false;
      reflection.SetBool(&message, &field, text == "true");
      return true;
    }
    case FieldDescriptor::CPPTYPE_ENUM: {
      const auto* value = field.enum_type()->FindValueByName(EnumName(text));
      if (value == nullptr) return false;
      reflection.SetEnum(&message, &field, value);
      return true;
    }
    default: return false;
  }
}

std::string Expected(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32: return "a whole number";
    case FieldDescriptor::CPPTYPE_BOOL: return "true or false";
    case FieldDescriptor::CPPTYPE_ENUM: {
      std::string names;
      for (int i = 1; i < field.enum_type()->value_count(); ++i) {
        names += (i > 1 ? " or " : "") + field.enum_type()->value(i)->name();
      }
      return names;
    }
    default: return "a number";
  }
}

}  // namespace

std::vector<std::string> SettingKeys() {
  std::vector<std::string> keys;
  CollectKeys(*v1::MapConfig::descriptor(), "", keys);
  std::sort(keys.begin(), keys.end());
  return keys;
}

Status ApplySetting(const std::string& key_value, v1::MapConfig& config) {
  const std::size_t equals = key_value.find('=');
  if (equals == std::string::npos) return InvalidArgument("'" + key_value + "' is not key=value");
  const std::string key = key_value.substr(0, equals), value = key_value.substr(equals + 1);
  Message* message = &config;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(key.substr(begin, end - begin));
    const bool is_last = end == key.size();
    if (field == nullptr || is_last == (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE)) return UnknownKey(key);
    if (is_last) {
      if (SetScalar(*message, *field, value)) return Status::Ok();
      return InvalidArgument(key + " must be " + Expected(*field) + ", not '" + value + "'");
    }
    message = message->GetReflection()->MutableMessage(message, field);
    begin = end + 1;
  }
}

}  // namespace dhpmap
