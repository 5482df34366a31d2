// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "clients/evaluator/experiment.h"
#include "clients/evaluator/retrieval.h"

namespace dhpmap::evaluator {

// The paper's tables, ours with the paper's own numbers in brackets; each takes experiments of all data sets.

/// Table I: panoptic, semantic and instance labels of panmap, dhp_no_refine and dhp, and of the majority of votes.
std::string LabelTable(const std::vector<Experiment>& experiments);
/// Table II: semantic labels of kimera, the majority of votes and dhp.
std::string KimeraTable(const std::vector<Experiment>& experiments);
/// Table III: geometry of kimera, panmap and dhp.
std::string GeometryTable(const std::vector<Experiment>& experiments);
/// Table IV: time to retrieve one object.
std::string RetrievalTable(const std::vector<RetrievalTimes>& retrievals);
/// Not in the paper: what each part of the refinement brings and costs.
std::string AblationTable(const std::vector<Experiment>& experiments);

/// All of them with their captions, and how the numbers came about.
std::string PaperText(const std::vector<Experiment>& experiments, const std::vector<RetrievalTimes>& retrievals);

/// The systems that the tables need, in the order they are run.
std::vector<std::string> PaperSystems();

}  // namespace dhpmap::evaluator
