// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "mapping/base/status.h"

namespace google::protobuf {
class Descriptor;
class FieldDescriptor;
class Message;
}  // namespace google::protobuf

namespace dhpmap::json {

/// Asked before memory is used: may the total be this many bytes? The reader returns its error.
using AskRoom = std::function<Status(std::size_t num_bytes)>;

/// Counts at least the memory that a message takes while it is parsed, apart from the allocator's overhead. Asks in
/// steps. Functions return false once the limit is reached. Thread-compatible.
class MessageBytes {
 public:
  /// Empty `ask`: no limit.
  explicit MessageBytes(AskRoom ask) : ask_(std::move(ask)) {}

  /// `message` is new and empty.
  bool AddMessage(const google::protobuf::Message& message, bool is_in_list);
  bool AddScalar(const google::protobuf::FieldDescriptor& field, std::size_t text_bytes);
  /// A string with escapes is copied to be decoded, one at a time.
  bool AddScratch(std::string_view raw);
  bool Add(std::size_t num_bytes);
  /// Map entries count twice until EndMap: in the list that they are read into, and in the map.
  void BeginMap() { num_copies_ = num_copies_ < kMostCopies ? 2 * num_copies_ : num_copies_; }
  void EndMap() { num_copies_ = num_copies_ > 1 ? num_copies_ / 2 : 1; }

  [[nodiscard]] const Status& status() const { return status_; }

 private:
  static constexpr std::size_t kMostCopies = 1 << 16;

  AskRoom ask_;
  Status status_;
  std::size_t bytes_ = 0, granted_ = 0, scratch_bytes_ = 0, num_copies_ = 1;
  std::unordered_map<const google::protobuf::Descriptor*, std::size_t> empty_bytes_;
};

}  // namespace dhpmap::json
