// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "clients/cpp/calls/caller.h"
#include "dhpmap/v1/record.pb.h"

namespace dhpmap {

/// Makes recorded edits again in another map: each names that map, its objects by the same ids, and edits, and states
/// to go back to, by the revisions that they have there. What a client asked of the state that it met (etag,
/// expected_revision) and the id of its request are left out: what was recorded was made. Thread-compatible.
class ReplayEdits {
 public:
  /// Names as "maps/kitchen".
  ReplayEdits(std::shared_ptr<client::Caller> caller, std::string recorded_map, std::string map);

  /// Whether the record says how it was made, by a request that this version knows.
  [[nodiscard]] static bool Knows(const v1::RecordedEdit& edit);
  /// Of one that it knows; what the server says of it. DATA_LOSS for a request that cannot be read; FAILED_PRECONDITION
  /// for one that goes back to a state which no edit of the record has made, or met.
  client::Status Make(const v1::RecordedEdit& edit);
  /// What was kept clear when the record began.
  client::Status KeepClear(const v1::RecordStart& start);

 private:
  struct Method;
  static const std::map<std::string, Method>& Methods();
  template <typename Request, typename Response, typename Stub>
  static Method MethodOf(grpc::Status (Stub::*call)(grpc::ClientContext*, const Request&, Response*));
  void Translate(google::protobuf::Message& request) const;
  [[nodiscard]] std::int64_t RevisionHere(std::int64_t recorded) const;  ///< 0: not known
  [[nodiscard]] std::string Translated(const std::string& name) const;

  const std::shared_ptr<client::Caller> caller_;
  const std::string recorded_map_, map_;
  std::map<std::int64_t, std::int64_t> revisions_;  ///< here, of those that the record has
};

}  // namespace dhpmap
