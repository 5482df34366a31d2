// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "dhpmap/v1/mapping_service.pb.h"
#include "mapping/base/mutex.h"
#include "mapping/base/status.h"

namespace dhpmap {

/// Summary of the server's answers to the frames of one mapping session. Thread-safe.
class AckSummary {
 public:
  /// Counts a frame that could not be read. True for the first of its kind: tell the user.
  bool AddSkipped(const Status& why);
  /// True for the first refusal of its kind. A frame that is sent and fused again, because it was lost before it was
  /// stored, counts once.
  bool AddAck(const v1::IntegrateFramesResponse& ack);
  /// Returns the warnings of a fused frame whose fault is new: tell the user.
  std::vector<std::string> AddWarnings(const v1::IntegrateFramesResponse& ack);
  /// Takes an answer without a frame; it reports how much is stored.
  void AddProgress(const v1::IntegrateFramesResponse& answer);
  /// Sets the number of frames that an earlier run stored; they need not be sent.
  void SetStoredBefore(std::size_t num_frames);
  /// The stream ended well: all accepted frames are stored.
  void SetAllStored();

  [[nodiscard]] std::size_t num_done() const;    ///< skipped, refused, fused now, and stored before
  [[nodiscard]] std::size_t num_stored() const;  ///< as far as the server has reported, including those stored before
  [[nodiscard]] std::size_t num_fused() const;
  [[nodiscard]] std::size_t num_refused() const;
  [[nodiscard]] std::size_t num_created() const;

  void Print(std::ostream& out, double elapsed_s) const;
  /// One JSON object; `map` and `num_submaps` as at the end.
  [[nodiscard]] std::string Json(const v1::Map& map, double elapsed_s) const;

 private:
  struct Kind {
    std::size_t count = 0;
    std::string reason, first_message;
  };
  /// By reason and message without its numbers, so that the same problem with other frames is of the same kind.
  using Kinds = std::map<std::string, Kind>;
  static bool Count(Kinds& kinds, const std::string& reason, const std::string& message);
  static void PrintKinds(std::ostream& out, const Kinds& kinds, const char* what);
  [[nodiscard]] std::size_t NumStored() const DHPMAP_REQUIRES(mutex_);

  mutable Mutex mutex_;
  Kinds skipped_ DHPMAP_GUARDED_BY(mutex_);
  Kinds refused_ DHPMAP_GUARDED_BY(mutex_);
  Kinds doubtful_ DHPMAP_GUARDED_BY(mutex_);  ///< fused with a warning, by fault
  std::size_t num_skipped_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::size_t num_refused_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::size_t num_doubtful_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::size_t num_fused_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::set<std::int64_t> taken_ DHPMAP_GUARDED_BY(mutex_);           ///< sequences of frames fused, now or before
  std::optional<std::int64_t> committed_ DHPMAP_GUARDED_BY(mutex_);  ///< frames up to this sequence are stored
  std::size_t num_duplicates_ DHPMAP_GUARDED_BY(mutex_) = 0;         ///< fused before, and not counted as fused
  std::size_t num_stored_before_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::size_t num_created_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::int64_t num_points_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::int64_t num_unknown_points_ DHPMAP_GUARDED_BY(mutex_) = 0;
  double fuse_s_ DHPMAP_GUARDED_BY(mutex_) = 0;
  std::int64_t revision_ DHPMAP_GUARDED_BY(mutex_) = 0;
};

}  // namespace dhpmap
