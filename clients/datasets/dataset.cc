// SPDX-License-Identifier: BSD-3-Clause
#include "clients/datasets/dataset.h"

namespace dhpmap {

Result<LabelSource> ParseLabelSource(const std::string& name) {
  if (name == "predicted") return LabelSource::kPredicted;
  if (name == "groundtruth") return LabelSource::kGroundTruth;
  if (name == "none") return LabelSource::kNone;
  return InvalidArgument("label source '" + name + "' is not predicted, groundtruth or none");
}

}  // namespace dhpmap
