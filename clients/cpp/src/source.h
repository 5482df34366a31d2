// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "clients/cpp/calls/caller.h"
#include "dhpmap/result.h"
#include "dhpmap/v1/query_service.pb.h"

namespace dhpmap::client {

/// The destination of queries: a map, now or at a revision, by single calls or on a stream. Thread-safe, unless a
/// derived class says otherwise.
class Source {
 public:
  explicit Source(std::string map, std::int64_t read_revision = 0)
      : map_(std::move(map)), read_revision_(read_revision) {}
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// Answers the query that is set; deadline_s 0: that of the connection.
  virtual Result<v1::StreamQueriesResponse> Answer(v1::StreamQueriesRequest query, double deadline_s) = 0;

  /// Requests a distance grid by a separate call, from the same state as other queries; deadline_s as above.
  virtual std::unique_ptr<Parts<v1::QueryDistanceGridResponse>> AnswerGrid(v1::QueryDistanceGridRequest query,
                                                                           double deadline_s) = 0;

  [[nodiscard]] const std::string& map() const { return map_; }  // maps/{map}
  /// The revision that queries must name; 0: none.
  [[nodiscard]] std::int64_t read_revision() const { return read_revision_; }

 private:
  const std::string map_;
  const std::int64_t read_revision_;
};

/// Sends each query as one call.
std::shared_ptr<Source> MakeCalledSource(std::shared_ptr<Caller> caller, std::string map,
                                         std::int64_t read_revision = 0);
/// The same for the state that the contacted server has: see Map::Eventual.
std::shared_ptr<Source> MakeEventualSource(std::shared_ptr<Caller> caller, std::string map);

}  // namespace dhpmap::client
