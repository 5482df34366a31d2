// SPDX-License-Identifier: BSD-3-Clause
#include "proto/types/message_outline.h"

#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/message.h>
#include <google/protobuf/wire_format_lite.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"

namespace dhpmap {

namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::io::CodedInputStream;
using WireFormat = google::protobuf::internal::WireFormatLite;

/// An array of these has doubled.
constexpr std::size_t kPointer_bytes = 2 * sizeof(void*);
/// What any piece of memory takes besides.
constexpr std::size_t kPiece_bytes = 16;
constexpr std::size_t kText_bytes = sizeof(std::string) + kPiece_bytes;
/// A number, text or group that nobody knows, in a list that has doubled, with a share of what that list takes.
constexpr std::size_t kUnknown_bytes = 96;
/// Of a map, with its share of the table; it cannot be asked.
constexpr std::size_t kEntry_bytes = 96;
constexpr int kNoGroup = -1;

std::size_t BytesOfNumber(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_INT64:
    case FieldDescriptor::CPPTYPE_UINT64: return 8;
    default: return 4;
  }
}

/// What a text takes besides its own object: its room is no less than twice the first, and doubles where it comes in
/// pieces and is longer than protobuf gives it room for at once.
std::size_t BytesOfText(std::size_t length) {
  constexpr std::size_t kMostInside = 15, kLeast = 2 * kMostInside, kMostAtOnce = 50'000'000;
  if (length <= kMostInside) return 0;
  return (length > kMostAtOnce ? 2 * length : std::max(length, kLeast)) + 1 + kPiece_bytes;
}

/// False if they are not there.
bool Skip(CodedInputStream& input, std::uint32_t num_bytes) {
  return num_bytes <= INT32_MAX && input.Skip(static_cast<int>(num_bytes));
}

}  // namespace

struct MessageLayout::Field {
  enum class Kind { kUnknown, kNumber, kText, kMessage } kind = Kind::kUnknown;
  bool is_repeated = false;
  WireFormat::WireType wire_type = WireFormat::WIRETYPE_VARINT;  ///< of values that come one by one
  std::size_t number_bytes = 0;                                  ///< in memory
  const Type* message = nullptr;
};

struct MessageLayout::Type {
  std::size_t empty_bytes = 0;
  std::vector<Field> fields;  ///< by their numbers
};

/// One way through the bytes of a message. Each function is false if they are none.
class MessageLayout::Walk {
 public:
  Walk(CodedInputStream& input, MessageOutline& outline) : input_(input), outline_(outline) {}

  /// Counts the fields up to the end of the group, or up to the present limit if it is kNoGroup. `type` is of which
  /// message they are; null: of none that is known.
  bool CountFields(const Type* type, int group) {
    if (!input_.IncrementRecursionDepth()) return false;  // the parser refuses what is so deep
    while (const std::uint32_t tag = input_.ReadTag()) {
      if (WireFormat::GetTagWireType(tag) == WireFormat::WIRETYPE_END_GROUP) {
        input_.DecrementRecursionDepth();
        return WireFormat::GetTagFieldNumber(tag) == group;
      }
      if (!CountField(tag, type)) return false;
    }
    input_.DecrementRecursionDepth();
    return group == kNoGroup && input_.ConsumedEntireMessage();
  }

  bool CountField(std::uint32_t tag, const Type* type) {
    static const Field unknown;
    const auto number = static_cast<std::size_t>(WireFormat::GetTagFieldNumber(tag));
    if (number == 0) return false;
    const Field& field = type != nullptr && number < type->fields.size() ? type->fields[number] : unknown;
    if (WireFormat::GetTagWireType(tag) != WireFormat::WIRETYPE_LENGTH_DELIMITED) return CountShort(tag, field);
    std::uint32_t num_bytes = 0;
    if (!input_.ReadVarint32(&num_bytes)) return false;
    if (field.kind == Field::Kind::kNumber && field.is_repeated) return CountPacked(field, num_bytes);
    ++outline_.num_fields;
    if (field.is_repeated) outline_.message_bytes += kPointer_bytes;
    if (field.kind == Field::Kind::kMessage) return CountMessage(*field.message, num_bytes);
    outline_.message_bytes +=
        BytesOfText(num_bytes) + (field.kind == Field::Kind::kText ? kText_bytes : kUnknown_bytes);
    return Skip(input_, num_bytes);
  }

 private:
  /// A number, or a group; in these messages there are none that anybody knows.
  bool CountShort(std::uint32_t tag, const Field& field) {
    const auto wire_type = WireFormat::GetTagWireType(tag);
    if (field.kind == Field::Kind::kNumber && field.wire_type == wire_type) {
      if (field.is_repeated) outline_.message_bytes += 3 * field.number_bytes;  // while their array doubles
      return WireFormat::SkipField(&input_, tag);
    }
    ++outline_.num_fields;
    outline_.message_bytes += kUnknown_bytes;
    if (wire_type == WireFormat::WIRETYPE_START_GROUP) return CountFields(nullptr, WireFormat::GetTagFieldNumber(tag));
    return WireFormat::SkipField(&input_, tag);
  }

  void CountNumbers(const Field& field, std::size_t num_numbers) {
    outline_.message_bytes += 2 * num_numbers * field.number_bytes;  // their array has doubled
  }

  bool CountPacked(const Field& field, std::uint32_t num_bytes) {
    const bool is_varint = field.wire_type == WireFormat::WIRETYPE_VARINT;  // of a byte or more
    CountNumbers(field, is_varint ? num_bytes : num_bytes / field.number_bytes);
    return Skip(input_, num_bytes);
  }

  /// The message that begins here, up to its own end.
  bool CountMessage(const Type& type, std::uint32_t num_bytes) {
    if (num_bytes > INT32_MAX) return false;
    outline_.message_bytes += type.empty_bytes + kPiece_bytes;
    const int length = static_cast<int>(num_bytes);
    const auto limit = input_.PushLimit(length);
    // A limit beyond the end would be no limit, and the message cut off.
    const bool is_whole =
        input_.BytesUntilLimit() == length && CountFields(&type, kNoGroup) && input_.BytesUntilLimit() == 0;
    input_.PopLimit(limit);
    return is_whole;
  }

  CodedInputStream& input_;
  MessageOutline& outline_;
};

MessageLayout::MessageLayout(const Descriptor& type) : root_(type) { Add(type); }
MessageLayout::~MessageLayout() = default;

const MessageLayout::Type* MessageLayout::Add(const Descriptor& type) {
  auto& slot = types_[&type];
  if (slot != nullptr) return slot.get();
  slot = std::make_unique<Type>();
  Type& added = *slot;  // its fields may hold others of it
  added.empty_bytes = type.options().map_entry()
                          ? kEntry_bytes
                          : google::protobuf::MessageFactory::generated_factory()->GetPrototype(&type)->SpaceUsedLong();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& from = *type.field(i);
    const auto number = static_cast<std::size_t>(from.number());
    added.fields.resize(std::max(added.fields.size(), number + 1));
    Field field{.is_repeated = from.is_repeated(),
                .wire_type = WireFormat::WireTypeForFieldType(static_cast<WireFormat::FieldType>(from.type()))};
    switch (from.cpp_type()) {
      case FieldDescriptor::CPPTYPE_STRING: field.kind = Field::Kind::kText; break;
      case FieldDescriptor::CPPTYPE_MESSAGE:
        field.kind = Field::Kind::kMessage;
        field.message = Add(*from.message_type());
        break;
      default: field.kind = Field::Kind::kNumber; field.number_bytes = BytesOfNumber(from);
    }
    added.fields[number] = field;
  }
  return &added;
}

Result<MessageOutline> MessageLayout::OutlineOf(google::protobuf::io::ZeroCopyInputStream& bytes) const {
  CodedInputStream input(&bytes);
  const Type* root = types_.at(&root_).get();
  MessageOutline outline{.message_bytes = root->empty_bytes};
  Walk walk(input, outline);
  while (const std::uint32_t tag = input.ReadTag()) {
    if (!walk.CountField(tag, root)) return Malformed();
  }
  if (!input.ConsumedEntireMessage()) return Malformed();
  return outline;
}

Result<MessageOutline> MessageLayout::OutlineOf(std::string_view bytes) const {
  if (bytes.size() > INT32_MAX) return Malformed();
  google::protobuf::io::ArrayInputStream stream(bytes.data(), static_cast<int>(bytes.size()));
  return OutlineOf(stream);
}

Status MessageLayout::Malformed() const {
  return InvalidArgument("what was sent is no " + root_.name()).WithReason("MALFORMED_PROTOBUF");
}

const MessageLayout& LayoutOf(const Descriptor& type) {
  static Mutex mutex;
  static std::map<const Descriptor*, std::unique_ptr<const MessageLayout>> layouts;  // none ever goes
  const MutexLock lock(mutex);
  auto& layout = layouts[&type];
  if (layout == nullptr) layout = std::make_unique<const MessageLayout>(type);
  return *layout;
}

}  // namespace dhpmap
