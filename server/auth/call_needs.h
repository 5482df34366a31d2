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

/// From a request to one of its fields: all but the last are messages.
using FieldPath = std::vector<const google::protobuf::FieldDescriptor*>;

/// What one rpc needs, as its options in proto/ say (permission.proto).
struct CallNeeds {
  Need need = v1::Access::NEED_UNSPECIFIED;
  v1::Access::Maps maps = v1::Access::MAPS_UNSPECIFIED;
  bool is_public = false;     ///< of gRPC's health: asked without a key
  bool can_only_try = false;  ///< the request has a field that means VALIDATE_ONLY
  bool is_stream = false;
  bool comes_in_messages = false;  ///< the client streams
  /// Fields that mean something, by meaning. Of MAP there may be several in branches of a oneof.
  std::vector<std::pair<Meaning, FieldPath>> fields = {};
};

/// What every rpc needs. Immutable, so thread-safe.
class CallTable {
 public:
  /// Of these services, and of gRPC's own: reflection needs READ, health's Check nothing. FAILED_PRECONDITION naming
  /// every rpc that does not say what it needs, or which maps.
  static Result<CallTable> Make(const std::vector<const google::protobuf::ServiceDescriptor*>& services);
  /// Of all services of dhpmap.v1 that are linked.
  static Result<CallTable> OfLinkedServices();

  /// By "/dhpmap.v1.MapService/GetMap"; null if there is no such rpc.
  [[nodiscard]] const CallNeeds* Find(std::string_view path) const;
  [[nodiscard]] const std::map<std::string, CallNeeds, std::less<>>& calls() const { return calls_; }

 private:
  std::map<std::string, CallNeeds, std::less<>> calls_;
};

/// "/dhpmap.v1.MapService/GetMap".
std::string PathOf(const google::protobuf::MethodDescriptor& method);

}  // namespace dhpmap::auth
