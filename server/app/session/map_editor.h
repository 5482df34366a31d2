// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mapping/changes/map_change.h"
#include "mapping/map/edit_entry.h"
#include "mapping/map/map.h"
#include "server/app/feeds/frame_recorder.h"
#include "server/app/session/map_writer.h"
#include "server/app/states/map_view.h"
#include "storage/store.h"

namespace dhpmap {

/// Whether an edit is to be made, or only to be tried: then everything is checked and told, and nothing changes.
enum class EditMode { kMake, kTryOnly };

/// What an edit did to the map.
struct EditMade {
  SubmapId submap;                        ///< that was edited, or made
  EditSummary summary;                    ///< for the log
  std::vector<RegionEvent> cleared = {};  ///< for those who follow the map
};

/// An edit as it is asked for.
struct EditRequest {
  /// On an error, or what it throws, the map is as it was.
  std::function<Result<EditMade>(Map&)> change;
  EditSource source = {};
  EditMode mode = EditMode::kMake;
  /// What is answered, made from the state that has the edit, or, if it is only tried, would have it. Where the request
  /// has an id it is stored with the edit, and is what a repeated request is answered. May be empty.
  std::function<std::string(const MapView&, const EditMade&)> answer = {};
  ArrivedEdit arrived = {};  ///< if MapRecording::is_wanted
};

/// A state that holds an edit (of one that was only tried: the state that it met), and the submap that was edited, or
/// made (none, of a request that was repeated).
struct EditOutcome {
  std::shared_ptr<const MapView> view;
  SubmapId submap;
  std::string answer = {};
};

/// Edits a map between two frames: all or nothing, and stored before anybody sees it. Thread-safe.
class MapEditor {
 public:
  /// The store outlives this.
  MapEditor(MapWriter writer, MapStore& store) : writer_(std::move(writer)), store_(store) {}

  /// See MapSession::Edit.
  void Edit(EditRequest request, std::function<void(Result<EditOutcome>)> done);

 private:
  using State = std::shared_ptr<const MapSnapshot>;
  Result<EditOutcome> EditNow(const EditRequest& request);
  Result<EditOutcome> Store(const EditRequest& request, const EditMade& made, const State& before);
  [[nodiscard]] Result<std::optional<EditOutcome>> FindRepeated(const EditSource& source) const;

  const MapWriter writer_;
  MapStore& store_;
};

}  // namespace dhpmap
