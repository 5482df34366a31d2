// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <string>
#include <utility>
#include <vector>

#include "server/auth/call_needs.h"

namespace google::protobuf::io {
class CodedInputStream;
}

namespace dhpmap {

/// What the bytes of a request say of its way: found without parsing the rest, which may be megabytes that go on to
/// another server as they are. Immutable, so thread-safe.
class RouteFields {
 public:
  /// Fields that mean Access::MAP, and beside them `consistency` and `read_revision`.
  RouteFields(const auth::CallNeeds& needs, const google::protobuf::Descriptor& request);

  struct Found {
    std::string map;  ///< {map} of the name that comes last; empty if there is none, or the bytes are no message
    bool is_eventual = false;  ///< any server answers: as AnsweredAnywhere says of the message
  };

  /// Whether requests name maps.
  [[nodiscard]] bool empty() const { return places_.empty(); }
  [[nodiscard]] Found In(const grpc::ByteBuffer& bytes) const;

 private:
  /// Numbers of the fields of one message; 0: it has none.
  struct Fields {
    int map = 0, consistency = 0, read_revision = 0;
  };
  /// In the request itself (0), or in its message of this number.
  struct Place {
    int message = 0;
    Fields fields;
  };
  struct Values;
  static bool Read(google::protobuf::io::CodedInputStream& input, const Fields& fields, Values& values);
  static Fields FieldsOf(const google::protobuf::Descriptor& message, int map);

  std::vector<Place> places_;
};

}  // namespace dhpmap
