// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "dhpmap/v1/watch_service.pb.h"
#include "server/app/maps/running_exports.h"
#include "server/app/watch/change_filter.h"
#include "server/app/watch/watch_position.h"

namespace dhpmap {

/// INVALID_ARGUMENT, reason BAD_POSITION, for a negative revision, or a malformed history or position.
Result<WatchStart> WatchStartFromProto(const v1::WatchMapRequest& request);

/// INVALID_ARGUMENT, reason BAD_FILTER, naming every bad field.
Result<ChangeFilter> ChangeFilterFromProto(const v1::WatchFilter& filter, const LabelSet& label_set);

/// Seconds between messages; INVALID_ARGUMENT outside the allowed range.
Result<double> ProgressSecondsFromProto(const v1::WatchMapRequest& request);

/// Adds export changes to a progress message.
void SetExports(const ExportNews& news, v1::WatchProgress& progress);

/// An event of a map; only the map's name, history and label set are used.
v1::SubmapEvent ToProto(const SubmapEvent& event, const MapInfo& map);

v1::RegionEvent ToProto(const RegionEvent& event, const MapInfo& map);

/// The filtered events of one change, in messages of about 64 KiB. Empty if none passes.
class ChangeMessages {
 public:
  ChangeMessages() = default;
  ChangeMessages(std::shared_ptr<const MapChange> change, const ChangeFilter& filter);

  /// Whether there is a next message.
  [[nodiscard]] bool has_next() const { return has_next_; }
  /// Fills an empty message, except its position; marks the last one.
  void Next(const ChangeFilter& filter, const MapInfo& map, v1::MapChange& message);

 private:
  static constexpr std::size_t kMessage_bytes = 64u << 10;
  void SkipToPassing(const ChangeFilter& filter);
  [[nodiscard]] bool IsBeforeEnd() const;
  /// Returns its size.
  std::size_t AddNext(const MapInfo& map, v1::MapChange& message);

  std::shared_ptr<const MapChange> change_;
  std::size_t next_region_ = 0;  ///< regions come first
  std::size_t next_ = 0;         ///< event of a submap
  bool has_next_ = false, has_begun_ = false;
};

}  // namespace dhpmap
