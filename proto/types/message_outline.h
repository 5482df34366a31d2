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

/// Size of a serialised message as an object, computed without parsing and without memory. Counts fields at any depth,
/// known or not: some take fifty times their size on the wire.
struct MessageOutline {
  std::size_t num_fields = 0;     ///< all except known numbers: an upper bound of messages, texts and unknown fields
  std::size_t message_bytes = 0;  ///< upper bound of its memory, without allocator overhead
};

/// Layout of a message type, for validating and sizing bytes before they are parsed. Immutable.
class MessageLayout {
 public:
  /// `type` and all nested types are generated code.
  explicit MessageLayout(const google::protobuf::Descriptor& type);
  ~MessageLayout();

  /// Needs almost no memory for any input. INVALID_ARGUMENT, reason MALFORMED_PROTOBUF, for anything else; does not
  /// check texts for UTF-8.
  [[nodiscard]] Result<MessageOutline> OutlineOf(google::protobuf::io::ZeroCopyInputStream& bytes) const;
  [[nodiscard]] Result<MessageOutline> OutlineOf(std::string_view bytes) const;
  /// The error for malformed bytes.
  [[nodiscard]] Status Malformed() const;

 private:
  struct Type;
  struct Field;
  class Walk;
  const Type* Add(const google::protobuf::Descriptor& type);

  const google::protobuf::Descriptor& root_;
  std::map<const google::protobuf::Descriptor*, std::unique_ptr<Type>> types_;
};

/// Created on first use; `type` is generated code. Thread-safe.
const MessageLayout& LayoutOf(const google::protobuf::Descriptor& type);
template <typename Message>
const MessageLayout& LayoutOf() {
  static const MessageLayout& layout = LayoutOf(*Message::descriptor());
  return layout;
}

}  // namespace dhpmap
