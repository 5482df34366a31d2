// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

#include "mapping/base/mutex.h"
#include "mapping/pipeline/map_builder.h"
#include "server/app/open_map/map_writer.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// Progress of OpenMap::Finish.
enum class FinishStage { kWaiting, kRefining, kStoring };
struct FinishProgress {
  FinishStage stage = FinishStage::kWaiting;
  double elapsed_s = 0;  ///< since the request
};

/// The finished state, and the report of its refinement.
struct FinishOutcome {
  std::shared_ptr<const MapView> view;
  RefinementReport refinement;
};

/// Finishes mapping: refines everything pending and stores it durably. Thread-safe.
class MapFinisher {
 public:
  using Done = std::function<void(Result<FinishOutcome>)>;

  /// `on_refinement` is called for each on the writer thread; `on_finishing`, on any thread, when Progress changes.
  /// Both may be empty.
  MapFinisher(MapWriter writer, std::function<void(const RefinementReport&)> on_refinement,
              std::function<void()> on_finishing)
      : writer_(std::move(writer)), on_refinement_(std::move(on_refinement)), on_finishing_(std::move(on_finishing)) {}

  /// See OpenMap::Finish.
  void Finish(Done done, std::stop_token stop) DHPMAP_EXCLUDES(mutex_);
  /// Of the oldest running call; nothing if there is none.
  [[nodiscard]] std::optional<FinishProgress> Progress() const DHPMAP_EXCLUDES(mutex_);

 private:
  struct Call;
  void Post(const std::shared_ptr<Call>& call, Done on_done, std::stop_token stop);
  Status FinishAndStore(const std::shared_ptr<Call>& call, const std::stop_token& stop, const Done& done);
  Result<RefinementReport> Refine(const std::stop_token& stop);
  void SetStage(const std::shared_ptr<Call>& call, FinishStage stage) DHPMAP_EXCLUDES(mutex_);
  void End(const std::shared_ptr<Call>& call) DHPMAP_EXCLUDES(mutex_);
  void TellProgress() const;

  const MapWriter writer_;
  const std::function<void(const RefinementReport&)> on_refinement_;
  const std::function<void()> on_finishing_;
  mutable Mutex mutex_;
  std::deque<std::shared_ptr<Call>> calls_ DHPMAP_GUARDED_BY(mutex_);  ///< in order of arrival
};

}  // namespace dhpmap
