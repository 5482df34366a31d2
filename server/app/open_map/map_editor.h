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
#include "server/app/open_map/map_writer.h"
#include "server/app/states/map_view.h"
#include "storage/store.h"

namespace dhpmap {

/// kTryOnly validates and reports an edit without changing anything.
enum class EditMode { kMake, kTryOnly };

/// Effect of an edit on the map.
struct EditMade {
  SubmapId submap;                        ///< the edited or created submap
  EditSummary summary;                    ///< for the log
  std::vector<RegionEvent> cleared = {};  ///< for watchers
};

/// A requested edit.
struct EditRequest {
  /// If it fails or throws, the map is unchanged.
  std::function<Result<EditMade>(Map&)> change;
  EditSource source = {};
  EditMode mode = EditMode::kMake;
  /// The answer, computed from the state with the edit (for kTryOnly, a hypothetical one). Stored with the edit if the
  /// request has an id, and returned for a repeated request. May be empty.
  std::function<std::string(const MapView&, const EditMade&)> answer = {};
  ArrivedEdit arrived = {};  ///< if MapRecording::is_wanted
};

/// The state with the edit (for kTryOnly, without it), and the edited or created submap (none for a repeated request).
struct EditOutcome {
  std::shared_ptr<const MapView> view;
  SubmapId submap;
  std::string answer = {};
};

/// Edits a map between two frames, atomically; the edit is stored before it becomes visible. Thread-safe.
class MapEditor {
 public:
  /// The store outlives this.
  MapEditor(MapWriter writer, MapStore& store) : writer_(std::move(writer)), store_(store) {}

  /// See OpenMap::Edit.
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
