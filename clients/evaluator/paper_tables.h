// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/evaluator/experiment.h"
#include "clients/evaluator/retrieval.h"

namespace dhpmap::evaluator {

// The paper's tables with our numbers, and the paper's in brackets, for experiments on all data sets.

/// Table I: panoptic, semantic and instance labels of panmap, dhp_no_refine, dhp and the majority vote.
std::string LabelTable(const std::vector<Experiment>& experiments);
/// Table II: semantic labels of kimera, the majority vote and dhp.
std::string KimeraTable(const std::vector<Experiment>& experiments);
/// Table III: geometry of kimera, panmap and dhp.
std::string GeometryTable(const std::vector<Experiment>& experiments);
/// Table IV: time to retrieve one object.
std::string RetrievalTable(const std::vector<RetrievalTimes>& retrievals);
/// Not in the paper: benefit and cost of each part of the refinement.
std::string AblationTable(const std::vector<Experiment>& experiments);

/// All tables with captions, and a description of the method.
std::string PaperText(const std::vector<Experiment>& experiments, const std::vector<RetrievalTimes>& retrievals);

/// The systems that the tables need, in the order of running.
std::vector<std::string> PaperSystems();

}  // namespace dhpmap::evaluator
