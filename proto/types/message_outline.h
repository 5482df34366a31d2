// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/zero_copy_stream.h>

#include <cstddef>
#include <map>
#include <memory>
#include <string_view>

#include "mapping/base/result.h"

namespace dhpmap {

/// What can be told of a message without parsing it, in no memory. Fields are counted however deep they are, known or
/// not: some take fifty times what they are on the wire.
struct MessageOutline {
  std::size_t num_fields = 0;     ///< all but known numbers: no fewer than there are messages, texts and unknown fields
  std::size_t message_bytes = 0;  ///< what it takes as a message: no less, but for what the allocator adds
};

/// What messages of a type are made of, so that bytes are told to be one, and how large it is, before they are parsed.
/// Immutable.
class MessageLayout {
 public:
  /// `type` is of generated code: it and all that it holds.
  explicit MessageLayout(const google::protobuf::Descriptor& type);
  ~MessageLayout();

  /// In next to no memory, whatever the bytes are. What is no such message is INVALID_ARGUMENT, reason
  /// MALFORMED_PROTOBUF; whether texts are UTF-8 is not looked at.
  [[nodiscard]] Result<MessageOutline> OutlineOf(google::protobuf::io::ZeroCopyInputStream& bytes) const;
  [[nodiscard]] Result<MessageOutline> OutlineOf(std::string_view bytes) const;
  /// What the answer is to bytes that are no such message.
  [[nodiscard]] Status Malformed() const;

 private:
  struct Type;
  struct Field;
  class Walk;
  const Type* Add(const google::protobuf::Descriptor& type);

  const google::protobuf::Descriptor& root_;
  std::map<const google::protobuf::Descriptor*, std::unique_ptr<Type>> types_;
};

/// Made when it is first asked for; `type` is of generated code. Thread-safe.
const MessageLayout& LayoutOf(const google::protobuf::Descriptor& type);
template <typename Message>
const MessageLayout& LayoutOf() {
  static const MessageLayout& layout = LayoutOf(*Message::descriptor());
  return layout;
}

}  // namespace dhpmap
