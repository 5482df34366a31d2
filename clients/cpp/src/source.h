// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "clients/cpp/calls/caller.h"
#include "dhpmap/result.h"
#include "dhpmap/v1/query_service.pb.h"

namespace dhpmap::client {

/// Where a query goes: to a map, now or as it was at a revision, by a call or on a stream. Thread-safe, unless the way
/// says otherwise.
class Source {
 public:
  explicit Source(std::string map, std::int64_t read_revision = 0)
      : map_(std::move(map)), read_revision_(read_revision) {}
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// The answer to the one query that is set; deadline_s 0: that of the connection.
  virtual Result<v1::StreamQueriesResponse> Answer(v1::StreamQueriesRequest query, double deadline_s) = 0;

  /// One distance grid, by a call of its own, of the state that other queries are of; deadline_s as above.
  virtual std::unique_ptr<Parts<v1::QueryDistanceGridResponse>> AnswerGrid(v1::QueryDistanceGridRequest query,
                                                                           double deadline_s) = 0;

  [[nodiscard]] const std::string& map() const { return map_; }  // maps/{map}
  /// That queries are to name; 0: none.
  [[nodiscard]] std::int64_t read_revision() const { return read_revision_; }

 private:
  const std::string map_;
  const std::int64_t read_revision_;
};

/// One call a query.
std::shared_ptr<Source> MakeCalledSource(std::shared_ptr<Caller> caller, std::string map,
                                         std::int64_t read_revision = 0);

}  // namespace dhpmap::client
