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
#include "server/app/session/map_writer.h"
#include "server/app/states/map_view.h"

namespace dhpmap {

/// How far MapSession::Finish has come.
enum class FinishStage { kWaiting, kRefining, kStoring };
struct FinishProgress {
  FinishStage stage = FinishStage::kWaiting;
  double elapsed_s = 0;  ///< since it was asked for
};

/// The finished state, and what refining it did.
struct FinishOutcome {
  std::shared_ptr<const MapView> view;
  RefinementReport refinement;
};

/// Ends mapping: refines what frames have left to be refined, and stores it durably. Thread-safe.
class MapFinisher {
 public:
  using Done = std::function<void(Result<FinishOutcome>)>;

  /// `on_refinement` hears of each on the writer thread; `on_finishing`, on any, when Progress answers something else.
  /// Both may be empty.
  MapFinisher(MapWriter writer, std::function<void(const RefinementReport&)> on_refinement,
              std::function<void()> on_finishing)
      : writer_(std::move(writer)), on_refinement_(std::move(on_refinement)), on_finishing_(std::move(on_finishing)) {}

  /// See MapSession::Finish.
  void Finish(Done done, std::stop_token stop) DHPMAP_EXCLUDES(mutex_);
  /// Of the call that came first and is not done; nothing if there is none.
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
  std::deque<std::shared_ptr<Call>> calls_ DHPMAP_GUARDED_BY(mutex_);  ///< in their order
};

}  // namespace dhpmap
