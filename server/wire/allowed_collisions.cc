// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/allowed_collisions.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "server/wire/option_fields.h"

namespace dhpmap {
namespace {

constexpr char kAllowedList[] = "options.allowed_collisions";

/// Submaps that every part may touch, and those that a link or an attached object may touch in addition.
struct TouchesByPart {
  std::set<SubmapId> all;
  std::map<std::string_view, std::set<SubmapId>> links;
  std::vector<std::set<SubmapId>> attached;
};

Status CheckLinks(const RequestedLinks& links) {
  const auto num_names = static_cast<std::size_t>(links.names.size());
  if (num_names == 0 || num_names == links.num_parts) return Status::Ok();
  return BadOption(
      "BAD_FILTER", links.field,
      "has " + std::to_string(num_names) + " names, not one for each of " + std::to_string(links.num_parts));
}

/// Adds the submaps of one entry to `touched`.
Status AddTouched(const v1::AllowedCollision& allowed, const std::string& item, const MapSnapshot& map,
                  std::set<SubmapId>& touched) {
  if (allowed.submap().empty() == allowed.class_name().empty()) {
    return BadOption(
        "BAD_FILTER", item,
        allowed.submap().empty() ? "says neither a submap nor a class_name" : "says both a submap and a class_name");
  }
  if (!allowed.submap().empty()) {
    DHPMAP_ASSIGN_OR_RETURN(const SubmapId id, OptionSubmapFromProto(allowed.submap(), item + ".submap", map));
    touched.insert(id);
    return Status::Ok();
  }
  DHPMAP_ASSIGN_OR_RETURN(const ClassId class_id,
                          OptionClassFromProto(allowed.class_name(), item + ".class_name", *map.info().label_set));
  for (const auto& submap : map.submaps()) {
    const SubmapInfo& info = submap->info();
    if (info.panoptic != Panoptic::kUnknown && info.class_id == class_id) touched.insert(info.id);
  }
  return Status::Ok();
}

/// The set of the part that an entry is about; null after an error.
Result<std::set<SubmapId>*> TouchedBy(const v1::AllowedCollision& allowed, const std::string& item,
                                      const std::set<std::string_view>& links, const std::vector<SubmapId>& attached,
                                      const MapSnapshot& map, TouchesByPart& touches) {
  if (!allowed.link().empty() && !allowed.attached().empty()) {
    return BadOption("BAD_FILTER", item, "says both a link and something attached");
  }
  if (!allowed.link().empty()) {
    const auto link = links.find(allowed.link());
    if (link == links.end()) {
      return BadOption("BAD_FILTER", item + ".link", "'" + allowed.link() + "' is no link that was named");
    }
    return &touches.links[*link];
  }
  if (allowed.attached().empty()) return &touches.all;
  DHPMAP_ASSIGN_OR_RETURN(const SubmapId id, OptionSubmapFromProto(allowed.attached(), item + ".attached", map));
  const auto carried = std::find(attached.begin(), attached.end(), id);
  if (carried == attached.end()) return BadOption("BAD_FILTER", item + ".attached", "is not attached to a robot");
  return &touches.attached[static_cast<std::size_t>(carried - attached.begin())];
}

Result<TouchesByPart> TouchesFromProto(const v1::QueryOptions& options, const RequestedLinks& links,
                                       const std::vector<SubmapId>& attached, const MapSnapshot& map) {
  DHPMAP_RETURN_IF_ERROR(CheckOptionLength(kAllowedList, options.allowed_collisions_size()));
  TouchesByPart touches;
  touches.attached.resize(attached.size());
  const std::set<std::string_view> names(links.names.begin(), links.names.end());
  for (int i = 0; i < options.allowed_collisions_size(); ++i) {
    const v1::AllowedCollision& allowed = options.allowed_collisions(i);
    const std::string item = ItemOfOption(kAllowedList, i);
    DHPMAP_ASSIGN_OR_RETURN(std::set<SubmapId> * touched, TouchedBy(allowed, item, names, attached, map, touches));
    DHPMAP_RETURN_IF_ERROR(AddTouched(allowed, item, map, *touched));
  }
  return touches;
}

std::vector<SubmapId> Together(const std::set<SubmapId>& a, const std::set<SubmapId>& b) {
  std::vector<SubmapId> both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

/// Makes one list for each distinct set; parts share them.
TouchLists ListsOf(const RequestedLinks& links, const TouchesByPart& touches) {
  TouchLists parts;
  parts.lists = {Together(touches.all, {})};
  if (touches.links.empty()) return parts;
  std::map<std::vector<SubmapId>, std::uint32_t> numbers = {{parts.lists[0], 0}};
  std::map<std::string_view, std::uint32_t> of_link;
  for (const auto& [link, touched] : touches.links) {
    std::vector<SubmapId> list = Together(touches.all, touched);
    const auto [known, is_new] = numbers.try_emplace(list, static_cast<std::uint32_t>(parts.lists.size()));
    if (is_new) parts.lists.push_back(std::move(list));
    of_link[link] = known->second;
  }
  parts.list_of.reserve(links.num_parts);
  for (const std::string& name : links.names) {
    const auto known = of_link.find(name);
    parts.list_of.push_back(known == of_link.end() ? 0 : known->second);
  }
  return parts;
}

}  // namespace

Result<AllowedTouches> AllowedTouchesFromProto(const v1::QueryOptions& options, const RequestedLinks& links,
                                               const std::vector<SubmapId>& attached, const MapSnapshot& map) {
  DHPMAP_RETURN_IF_ERROR(CheckLinks(links));
  AllowedTouches allowed;
  allowed.attached.resize(attached.size());
  if (options.allowed_collisions().empty()) return allowed;
  DHPMAP_ASSIGN_OR_RETURN(const TouchesByPart touches, TouchesFromProto(options, links, attached, map));
  allowed.parts = ListsOf(links, touches);
  if (allowed.parts.lists.size() > kMostTouchLists) {
    return BadOption("BAD_FILTER", kAllowedList,
                     std::to_string(allowed.parts.lists.size()) + " different lists of links are more than 64");
  }
  for (std::size_t i = 0; i < attached.size(); ++i) {
    allowed.attached[i] = Together(touches.all, touches.attached[i]);
  }
  return allowed;
}

}  // namespace dhpmap
