// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dhpmap/v1/permission.pb.h"
#include "mapping/base/result.h"

namespace google::protobuf {
class FieldDescriptor;
class MethodDescriptor;
class ServiceDescriptor;
}  // namespace google::protobuf

namespace dhpmap::auth {

using Need = v1::Access::Need;
using Meaning = v1::Access::Meaning;

/// Path from a request to one of its fields: all but the last are messages.
using FieldPath = std::vector<const google::protobuf::FieldDescriptor*>;

/// What one rpc requires, as the options in its proto say (permission.proto).
struct CallNeeds {
  Need need = v1::Access::NEED_UNSPECIFIED;
  v1::Access::Maps maps = v1::Access::MAPS_UNSPECIFIED;
  bool is_public = false;     ///< gRPC's health check: called without a key
  bool can_only_try = false;  ///< the request has a field that means VALIDATE_ONLY
  bool is_stream = false;
  bool comes_in_messages = false;  ///< the client streams
  /// Fields with a meaning for access control. MAP may occur several times, in branches of a oneof.
  std::vector<std::pair<Meaning, FieldPath>> fields = {};
};

/// The requirements of every rpc. Immutable, so thread-safe.
class CallTable {
 public:
  /// Reads the options of these services; adds gRPC's own: reflection needs READ, health's Check nothing.
  /// FAILED_PRECONDITION, naming every rpc that does not declare its need or its maps.
  static Result<CallTable> Make(const std::vector<const google::protobuf::ServiceDescriptor*>& services);
  /// The same for all linked services of dhpmap.v1.
  static Result<CallTable> OfLinkedServices();

  /// Finds a method by "/dhpmap.v1.MapService/GetMap"; null if there is no such rpc.
  [[nodiscard]] const CallNeeds* Find(std::string_view path) const;
  [[nodiscard]] const std::map<std::string, CallNeeds, std::less<>>& calls() const { return calls_; }

 private:
  std::map<std::string, CallNeeds, std::less<>> calls_;
};

/// "/dhpmap.v1.MapService/GetMap".
std::string PathOf(const google::protobuf::MethodDescriptor& method);

}  // namespace dhpmap::auth
