// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/recording.h"

#include <utility>

namespace dhpmap::bench {

Result<Recording> MapRecording(const std::string& directory, std::size_t num_frames, LabelSource labels) {
  Recording made;
  DHPMAP_ASSIGN_OR_RETURN(made.loaded, LoadFrames(directory, labels, num_frames));
  made.info.name = "recording";
  DHPMAP_RETURN_IF_ERROR(ApplyPreset(made.loaded.dataset->preset(), made.info.config));
  DHPMAP_ASSIGN_OR_RETURN(LabelSet label_set, LabelSet::Create(made.loaded.dataset->label_classes()));
  made.info.label_set = std::make_shared<LabelSet>(std::move(label_set));
  made.builder = std::make_unique<MapBuilder>(made.info, 0);
  for (const PanopticFrame& frame : made.loaded.frames) {
    DHPMAP_RETURN_IF_ERROR(made.builder->Integrate(frame).status());
  }
  (void)made.builder->Finish();
  return made;
}

}  // namespace dhpmap::bench
