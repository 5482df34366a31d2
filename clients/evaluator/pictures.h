// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/evaluator/evaluation.h"

namespace dhpmap::evaluator {

/// Writes `<folder>/<system>_labels.png`, coloured by instance (stuff by class), and `<system>_errors.png`: grey =
/// right, red = wrong class, orange = right class but another segment than the matched one, blue = missing; and
/// `truth_labels.png`. Each shows the samples of the truth from above, ceilings taken off, and below that from a corner
/// at half height. Makes the folder. UNAVAILABLE if a file cannot be written.
Status DrawPictures(const Truth& truth, const Scores& scores, const std::vector<ElementLabel>& labels,
                    const std::string& folder);

}  // namespace dhpmap::evaluator
