// SPDX-License-Identifier: BSD-3-Clause
#include "clients/evaluator/systems.h"

#include <algorithm>

#include "clients/evaluator/baselines/baselines.h"
#include "clients/evaluator/dhp_system.h"
#include "mapping/base/near_name.h"

namespace dhpmap::evaluator {
namespace {

struct Entry {
  const char* name;
  const char* what;
  std::unique_ptr<MappingSystem> (*make)(SystemSetup setup);
};

template <bool kManagement, bool kCrf>
std::unique_ptr<MappingSystem> MakeVariant(const char* name, SystemSetup setup) {
  setup.config.refinement.management = kManagement;
  setup.config.refinement.crf = kCrf;
  return MakeDhp(name, setup);
}

std::unique_ptr<MappingSystem> MakeUnrefinedOneField(SystemSetup setup) {
  setup.config.refinement.management = setup.config.refinement.crf = false;
  return MakeDhpOfOneField("dhp_no_refine_one_field", setup);
}

constexpr Entry kEntries[] = {
    {"panmap", "Panmap's recipe, with segments cut where they lie apart",
     [](SystemSetup setup) { return MakePanmap(setup); }},
    {"panmap_whole_segments", "Panmap's recipe, with segments as they come",
     [](SystemSetup setup) { return MakePanmapOfWholeSegments(std::move(setup)); }},
    {"kimera", "Kimera's recipe: classes alone, without carving", [](SystemSetup setup) { return MakeKimera(setup); }},
    {"votes", "our fusion with a vote in each voxel: classes alone",
     [](SystemSetup setup) { return MakeVotes(setup); }},
    {"votes_objects", "a vote in each voxel, and connected parts of a class as objects",
     [](SystemSetup setup) { return MakeVotesWithObjects(setup); }},
    {"dhp_no_refine", "not refined: places have several surfaces",
     [](SystemSetup setup) { return MakeVariant<false, false>("dhp_no_refine", std::move(setup)); }},
    {"dhp_no_refine_one_field", "not refined: one surface of all, each place the object's that was seen there most",
     [](SystemSetup setup) { return MakeUnrefinedOneField(std::move(setup)); }},
    {"dhp_management_only", "refined by label management alone",
     [](SystemSetup setup) { return MakeVariant<true, false>("dhp_management_only", std::move(setup)); }},
    {"dhp_crf_only", "refined by the CRF alone",
     [](SystemSetup setup) { return MakeVariant<false, true>("dhp_crf_only", std::move(setup)); }},
    {"dhp", "the map that the server makes", [](SystemSetup setup) { return MakeDhp("dhp", setup); }},
};

const Entry* Find(const std::string& name) {
  const auto* it = std::find_if(std::begin(kEntries), std::end(kEntries),
                                [&name](const Entry& entry) { return name == entry.name; });
  return it == std::end(kEntries) ? nullptr : it;
}

}  // namespace

std::vector<std::string> SystemNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kEntries) names.emplace_back(entry.name);
  return names;
}

std::string SystemDescription(const std::string& name) {
  const Entry* entry = Find(name);
  return entry == nullptr ? "" : entry->what;
}

Status CheckSystemName(const std::string& name) {
  if (Find(name) != nullptr) return Status::Ok();
  const std::vector<std::string> names = SystemNames();
  std::string known;
  for (const std::string& there : names) known += (known.empty() ? "" : ", ") + there;
  return InvalidArgument("there is no system '" + name + "'" + DidYouMean(name, names) + "\n  there are " + known);
}

Result<std::unique_ptr<MappingSystem>> MakeSystem(const std::string& name, SystemSetup setup) {
  DHPMAP_RETURN_IF_ERROR(CheckSystemName(name));
  DHPMAP_RETURN_IF_ERROR(setup.config.Validate());
  return Find(name)->make(std::move(setup));
}

}  // namespace dhpmap::evaluator
