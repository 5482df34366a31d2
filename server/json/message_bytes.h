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

/// Asked whether so many bytes may be held in all, before they are; what it refuses with is the reader's answer.
using AskRoom = std::function<Status(std::size_t num_bytes)>;

/// Counts what a message takes while it is made: no less, but for what the allocator adds. Asks in steps. Each function
/// is false once there is no room. Thread-compatible.
class MessageBytes {
 public:
  /// Without `ask` there is always room.
  explicit MessageBytes(AskRoom ask) : ask_(std::move(ask)) {}

  /// `message` is new and empty.
  bool AddMessage(const google::protobuf::Message& message, bool is_in_list);
  bool AddScalar(const google::protobuf::FieldDescriptor& field, std::size_t text_bytes);
  /// A string that has escapes is copied to be read; one at a time.
  bool AddScratch(std::string_view raw);
  bool Add(std::size_t num_bytes);
  /// What is added in between is there twice: in the list that entries of a map are read into, and in the map.
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
