// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/reader.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <bitset>
#include <utility>

#include "mapping/base/utf8.h"
#include "server/json/cursor.h"
#include "server/json/field_text.h"
#include "server/json/message_bytes.h"

namespace dhpmap::json {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr std::size_t kMostOfName_bytes = 128;
/// Limit of texts such as times.
constexpr std::size_t kMostOfShort_bytes = 1024;
/// A value of any type takes up to this many times its text: "1," is a message in a list, built from a copy.
constexpr std::size_t kMostOfValue = 128;

/// An unknown name, shortened for error messages.
std::string Shortened(std::string_view name) {
  if (name.size() <= kMostOfName_bytes) return std::string(name);
  std::size_t end = kMostOfName_bytes;
  while ((static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;  // do not split a character
  return std::string(name.substr(0, end)) + "...";
}

class Reader {
 public:
  Reader(std::string_view text, Paths* paths, AskRoom ask) : cursor_(text), paths_(paths), bytes_(std::move(ask)) {
    if (const std::size_t bad = FindInvalidUtf8(text); bad != std::string_view::npos) {
      cursor_.FailAt(bad, "the text is not UTF-8");
    }
  }

  /// Counts the initial message, too.
  void Start(const Message& message) {
    if (!bytes_.Add(message.SpaceUsedLong())) FailRoom();
  }
  bool ReadMessage(Message* message);
  bool ReadField(const FieldDescriptor& field, Message* message);

  Status Finish() {
    if (!bytes_.status().ok()) return bytes_.status();
    if (!cursor_.failed()) cursor_.ExpectEnd();
    Status status = cursor_.status();
    if (status.ok()) return status;
    if (violation_.empty()) {
      return InvalidArgument("malformed JSON: " + status.message()).WithReason("MALFORMED_JSON");
    }
    return std::move(InvalidArgument(violation_ + ": " + status.message()).WithReason("BAD_FIELD"))
        .WithViolation(violation_, status.message());
  }

 private:
  bool ReadFields(Message* message);
  bool ReadNamedField(Message* message, std::bitset<256>* seen);
  bool ReadRepeated(const FieldDescriptor& field, Message* message);
  bool ReadMap(const FieldDescriptor& field, Message* message);
  bool ReadScalar(const FieldDescriptor& field, Message* message);
  bool ReadScalarText(const FieldDescriptor& field, std::string_view* text);
  bool ReadWellKnown(Message* message);
  bool ReadMapKey(const FieldDescriptor& key, Message* entry);

  /// Reports a wrong value of the current field, rather than malformed JSON.
  bool FailField(std::size_t offset, const std::string& message) {
    if (violation_.empty()) violation_ = PathText();
    return cursor_.FailAt(offset, message);
  }
  /// Reports that the next part exceeds the memory limit.
  bool FailRoom() { return cursor_.Fail("no room"); }
  bool ReadText(std::string_view* text) {
    return (bytes_.AddScratch(cursor_.RawString()) || FailRoom()) && cursor_.ReadString(text, &scratch_);
  }
  bool Begin(const Message& message, bool is_in_list) { return bytes_.AddMessage(message, is_in_list) || FailRoom(); }
  [[nodiscard]] std::string PathText() const;
  void AddPath() {
    if (paths_ != nullptr && list_depth_ == 0 && !path_.empty()) paths_->push_back(ToString(path_));
  }

  Cursor cursor_;
  Paths* paths_;
  MessageBytes bytes_;
  FieldPath path_;
  std::vector<int> indices_;  // for each field of path_: index in a list, or -1
  int list_depth_ = 0;
  std::string violation_;
  std::string scratch_;
};

std::string Reader::PathText() const {
  std::string out;
  for (std::size_t i = 0; i < path_.size(); ++i) {
    if (i > 0) out += '.';
    out += path_[i]->name();
    if (indices_[i] >= 0) out += '[' + std::to_string(indices_[i]) + ']';
  }
  return out;
}

bool Reader::ReadMessage(Message* message) {
  if (cursor_.failed()) return false;
  if (path_.size() > kMaxDepth) return cursor_.Fail("nested too deeply");
  const bool well_known = message->GetDescriptor()->well_known_type() != Descriptor::WELLKNOWNTYPE_UNSPECIFIED;
  return well_known ? ReadWellKnown(message) : ReadFields(message);
}

bool Reader::ReadFields(Message* message) {
  if (const char c = cursor_.Peek();
      c == '"' || c == '[' || c == 't' || c == 'f' || c == '-' || (c >= '0' && c <= '9')) {
    if (!path_.empty()) return FailField(cursor_.offset(), "expected an object");
  }
  if (!cursor_.Consume('{')) return false;
  if (cursor_.TryConsume('}')) {
    AddPath();
    return true;
  }
  std::bitset<256> seen;
  do {
    if (!ReadNamedField(message, &seen)) return false;
  } while (cursor_.TryConsume(','));
  return cursor_.Consume('}');
}

bool Reader::ReadNamedField(Message* message, std::bitset<256>* seen) {
  cursor_.Peek();
  const std::size_t start = cursor_.offset();
  std::string_view key;
  if (!ReadText(&key)) return false;
  const FieldDescriptor* field = key.size() > kMostOfName_bytes ? nullptr : FindField(*message->GetDescriptor(), key);
  if (field == nullptr) {
    violation_ = path_.empty() ? Shortened(key) : PathText() + "." + Shortened(key);
    return cursor_.FailAt(start, message->GetDescriptor()->full_name() + " has no such field");
  }
  path_.push_back(field);
  indices_.push_back(-1);
  if (const auto index = static_cast<std::size_t>(field->index()); index < seen->size()) {
    if (seen->test(index)) return FailField(start, "given twice");
    seen->set(index);
  }
  if (!cursor_.Consume(':') || !ReadField(*field, message)) return false;
  path_.pop_back();
  indices_.pop_back();
  return true;
}

bool Reader::ReadField(const FieldDescriptor& field, Message* message) {
  if (cursor_.failed()) return false;
  const bool null_is_a_value =
      field.message_type() != nullptr && field.message_type()->well_known_type() == Descriptor::WELLKNOWNTYPE_VALUE;
  if (cursor_.Peek() == 'n' && !(null_is_a_value && !field.is_repeated())) {
    if (!cursor_.ReadWord("null")) return false;
    message->GetReflection()->ClearField(message, &field);
    AddPath();
    return true;
  }
  if (field.is_map()) return ReadMap(field, message);
  if (field.is_repeated()) return ReadRepeated(field, message);
  if (const auto* oneof = field.real_containing_oneof();
      oneof != nullptr && message->GetReflection()->HasOneof(*message, oneof)) {
    return FailField(cursor_.offset(), "another member of '" + oneof->name() + "' is given already");
  }
  if (field.message_type() != nullptr) {
    Message* inner = message->GetReflection()->MutableMessage(message, &field);
    return Begin(*inner, false) && ReadMessage(inner);
  }
  AddPath();
  return ReadScalar(field, message);
}

bool Reader::ReadRepeated(const FieldDescriptor& field, Message* message) {
  AddPath();
  if (cursor_.Peek() != '[') return FailField(cursor_.offset(), "expected a list");
  cursor_.TryConsume('[');
  if (cursor_.TryConsume(']')) return true;
  ++list_depth_;
  int index = 0;
  do {
    if (!indices_.empty()) indices_.back() = index;
    ++index;
    if (field.message_type() == nullptr) {
      if (!ReadScalar(field, message)) return false;
      continue;
    }
    Message* added = message->GetReflection()->AddMessage(message, &field);
    if (!Begin(*added, true) || !ReadMessage(added)) return false;
  } while (cursor_.TryConsume(','));
  --list_depth_;
  if (!indices_.empty()) indices_.back() = -1;
  return cursor_.Consume(']');
}

bool Reader::ReadMap(const FieldDescriptor& field, Message* message) {
  AddPath();
  if (cursor_.Peek() != '{') return FailField(cursor_.offset(), "expected an object");
  cursor_.TryConsume('{');
  if (cursor_.TryConsume('}')) return true;
  ++list_depth_;
  bytes_.BeginMap();
  do {
    Message* entry = message->GetReflection()->AddMessage(message, &field);
    const Descriptor& type = *entry->GetDescriptor();
    if (!Begin(*entry, true)) return false;
    if (!ReadMapKey(*type.map_key(), entry) || !cursor_.Consume(':')) return false;
    const FieldDescriptor& value = *type.map_value();
    if (value.message_type() == nullptr) {
      if (!ReadScalar(value, entry)) return false;
      continue;
    }
    Message* inner = entry->GetReflection()->MutableMessage(entry, &value);
    if (!Begin(*inner, false) || !ReadMessage(inner)) return false;
  } while (cursor_.TryConsume(','));
  bytes_.EndMap();
  --list_depth_;
  return cursor_.Consume('}');
}

bool Reader::ReadMapKey(const FieldDescriptor& key, Message* entry) {
  cursor_.Peek();
  const std::size_t start = cursor_.offset();
  std::string_view text;
  if (!ReadText(&text)) return false;
  if (!bytes_.AddScalar(key, text.size())) return FailRoom();
  const std::string wrong = SetScalarFromText(key, text, entry);
  return wrong.empty() || FailField(start, "key: " + wrong);
}

bool Reader::ReadScalar(const FieldDescriptor& field, Message* message) {
  cursor_.Peek();
  const std::size_t start = cursor_.offset();
  std::string_view text;
  if (!ReadScalarText(field, &text)) return false;
  if (!bytes_.AddScalar(field, text.size())) return FailRoom();
  const std::string wrong = SetScalarFromText(field, text, message);
  return wrong.empty() || FailField(start, wrong);
}

/// The text of a value whose JSON type fits the field: numbers may be quoted; booleans and strings must have their
/// type.
bool Reader::ReadScalarText(const FieldDescriptor& field, std::string_view* text) {
  const char c = cursor_.Peek();
  const std::size_t start = cursor_.offset();
  const bool is_text = field.cpp_type() == FieldDescriptor::CPPTYPE_STRING;
  const bool is_bool = field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL;
  if (c == '"' && !is_bool) return ReadText(text);
  if ((c == 't' || c == 'f') && is_bool) {
    *text = c == 't' ? "true" : "false";
    return cursor_.ReadWord(*text);
  }
  if ((c == '-' || (c >= '0' && c <= '9')) && !is_text && !is_bool) return cursor_.ReadNumber(text);
  if (!cursor_.SkipValue()) return false;  // prefer the syntax error to the type error
  return FailField(start, is_text   ? (field.type() == FieldDescriptor::TYPE_BYTES ? "expected base64 in a string"
                                                                                   : "expected a string")
                          : is_bool ? "expected true or false"
                                    : "expected a number or a name in quotes");
}

bool Reader::ReadWellKnown(Message* message) {
  AddPath();
  cursor_.Peek();
  const std::size_t start = cursor_.offset();
  const Descriptor& type = *message->GetDescriptor();
  if (type.well_known_type() == Descriptor::WELLKNOWNTYPE_FIELDMASK) {
    std::string_view text;
    if (cursor_.Peek() != '"') return FailField(start, "expected field names in a string, with commas between");
    if (!ReadText(&text)) return false;
    constexpr std::size_t kPath_bytes = sizeof(std::string) + 2 * sizeof(void*);
    const auto num_commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
    // Parts may grow: "A" becomes "_a".
    if (!bytes_.Add(4 * text.size() + (num_commas + 1) * kPath_bytes)) return FailRoom();
    SetFieldMask(text, message);
    return true;
  }
  if (!cursor_.SkipValue()) return false;
  const std::string_view slice = cursor_.Slice(start);
  const bool is_short = type.well_known_type() == Descriptor::WELLKNOWNTYPE_TIMESTAMP ||
                        type.well_known_type() == Descriptor::WELLKNOWNTYPE_DURATION;
  if (is_short && slice.size() > kMostOfShort_bytes) return FailField(start, "expected a " + type.full_name());
  if (!is_short && !bytes_.Add(kMostOfValue * slice.size())) return FailRoom();
  const auto status = google::protobuf::util::JsonStringToMessage({slice.data(), slice.size()}, message);
  return status.ok() || FailField(start, "expected a " + type.full_name());
}

}  // namespace

Status Read(std::string_view text, Message* message, Paths* paths, AskRoom ask) {
  Reader reader(text, paths, std::move(ask));
  reader.Start(*message);
  reader.ReadMessage(message);
  return reader.Finish();
}

Status ReadField(std::string_view text, const FieldDescriptor& field, Message* message, Paths* paths, AskRoom ask) {
  Reader reader(text, paths, std::move(ask));
  reader.Start(*message);
  reader.ReadField(field, message);
  return reader.Finish();
}

}  // namespace dhpmap::json
