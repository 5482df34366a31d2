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

/// Repeats recorded edits in another map. Translates names of the map; ids of objects stay. Translates references to
/// edits and past states to the revisions of the other map. Drops preconditions (etag, expected_revision) and request
/// ids, because the recorded edit succeeded. Thread-compatible.
class ReplayEdits {
 public:
  /// Map names such as "maps/kitchen".
  ReplayEdits(std::shared_ptr<client::Caller> caller, std::string recorded_map, std::string map);

  /// Whether the record contains a request that this version knows.
  [[nodiscard]] static bool Knows(const v1::RecordedEdit& edit);
  /// Repeats an edit for which Knows is true; returns the server's status. DATA_LOSS for an unreadable request;
  /// FAILED_PRECONDITION if it refers to a state that no edit of the record made or met.
  client::Status Make(const v1::RecordedEdit& edit);
  /// Restores the regions that were kept clear when the record began.
  client::Status KeepClear(const v1::RecordStart& start);

 private:
  struct Method;
  static const std::map<std::string, Method>& Methods();
  template <typename Request, typename Response, typename Stub>
  static Method MethodOf(grpc::Status (Stub::*call)(grpc::ClientContext*, const Request&, Response*));
  void Translate(google::protobuf::Message& request) const;
  [[nodiscard]] std::int64_t RevisionHere(std::int64_t recorded) const;  ///< 0: unknown
  [[nodiscard]] std::string Translated(const std::string& name) const;

  const std::shared_ptr<client::Caller> caller_;
  const std::string recorded_map_, map_;
  std::map<std::int64_t, std::int64_t> revisions_;  ///< from recorded revisions to those of this map
};

}  // namespace dhpmap
