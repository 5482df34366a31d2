// SPDX-License-Identifier: BSD-3-Clause
#include "server/json/message_bytes.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/message.h>

#include <string>

namespace dhpmap::json {
namespace {

using google::protobuf::FieldDescriptor;

constexpr std::size_t kStep_bytes = 64u << 10;
constexpr std::size_t kPointer_bytes = 2 * sizeof(void*);  // after an array of pointers has doubled

constexpr std::size_t kEntry_bytes = 96;  // a map entry with its share of the table; an estimate

/// Bytes of an element in an array that has doubled.
std::size_t BytesInList(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_INT64:
    case FieldDescriptor::CPPTYPE_UINT64: return 2 * sizeof(double);
    default: return 2 * sizeof(float);
  }
}

}  // namespace

bool MessageBytes::Add(std::size_t num_bytes) {
  bytes_ += num_copies_ * num_bytes;
  if (bytes_ <= granted_ || ask_ == nullptr) return status_.ok();
  if (!status_.ok()) return false;
  granted_ = bytes_ < kStep_bytes ? bytes_ : bytes_ + kStep_bytes;
  status_ = ask_(granted_);
  return status_.ok();
}

bool MessageBytes::AddMessage(const google::protobuf::Message& message, bool is_in_list) {
  const google::protobuf::Descriptor* type = message.GetDescriptor();
  std::size_t& empty_bytes = empty_bytes_[type];
  if (empty_bytes == 0) empty_bytes = type->options().map_entry() ? kEntry_bytes : message.SpaceUsedLong();
  return Add(empty_bytes + (is_in_list ? kPointer_bytes : 0));
}

bool MessageBytes::AddScalar(const FieldDescriptor& field, std::size_t text_bytes) {
  if (field.cpp_type() != FieldDescriptor::CPPTYPE_STRING) {
    constexpr std::size_t kMostOfNumber_bytes = 64;  // a longer text is copied to be parsed
    return Add((field.is_repeated() ? BytesInList(field) : 0) + (text_bytes > kMostOfNumber_bytes ? text_bytes : 0));
  }
  return Add(text_bytes + sizeof(std::string) + 1 + (field.is_repeated() ? kPointer_bytes : 0));
}

bool MessageBytes::AddScratch(std::string_view raw) {
  constexpr std::size_t kGrown = 3;  // it doubles while the old buffer still exists
  if (kGrown * raw.size() <= scratch_bytes_ || raw.find('\\') == std::string_view::npos) return true;
  const std::size_t more_bytes = kGrown * raw.size() - scratch_bytes_;
  scratch_bytes_ += more_bytes;
  return Add(more_bytes);
}

}  // namespace dhpmap::json
