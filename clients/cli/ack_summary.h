// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <mutex>
#include <ostream>
#include <string>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/status.h"

namespace dhpmap {

/// What became of the frames of one mapping session. Thread-safe.
class AckSummary {
 public:
  /// A frame that could not be read. True the first time for its kind: then the user should be told.
  bool AddSkipped(const Status& why);
  /// True the first time for its kind of refusal.
  bool AddAck(const v1::IntegrateFramesResponse& ack);

  [[nodiscard]] std::size_t num_done() const;  ///< skipped, refused and fused
  [[nodiscard]] std::size_t num_fused() const;
  [[nodiscard]] std::size_t num_refused() const;
  [[nodiscard]] std::size_t num_created() const;

  void Print(std::ostream& out, double elapsed_s) const;
  /// One JSON object; `map` and `num_submaps` as they are at the end.
  [[nodiscard]] std::string Json(const v1::Map& map, double elapsed_s) const;

 private:
  struct Kind {
    std::size_t count = 0;
    std::string reason, first_message;
  };
  /// By reason and message, numbers in it left out: the same trouble with other frames is of the same kind.
  using Kinds = std::map<std::string, Kind>;
  static bool Count(Kinds& kinds, const std::string& reason, const std::string& message);

  mutable std::mutex mutex_;
  Kinds skipped_, refused_;  // guarded by mutex_, like all below
  std::size_t num_skipped_ = 0, num_refused_ = 0, num_fused_ = 0, num_created_ = 0;
  std::int64_t num_points_ = 0, num_unknown_points_ = 0;
  double fuse_s_ = 0;
  std::int64_t revision_ = 0;
};

}  // namespace dhpmap
