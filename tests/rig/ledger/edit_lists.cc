// SPDX-License-Identifier: BSD-3-Clause
// Edits that are made together, and what takes them back.
#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "tests/rig/ledger/edit_book.h"

namespace dhpmap::rig {
namespace {

/// What `change` has changed, as it is in `from`; the rest as it is in `now`.
Wish TakenFrom(const Wish& from, const Wish& change, Wish now) {
  if (change.presence != Presence::kEither) now.presence = from.presence;
  if (change.display_name) now.display_name = from.display_name;
  if (change.position_m) now.position_m = from.position_m;
  if (change.class_id) now.class_id = from.class_id;
  return now;
}

/// Whether what is seen is always either the one or the other, whatever mapping does.
bool CanBeTold(const Wish& a, const Wish& b) {
  if (a.presence == Presence::kEither || b.presence == Presence::kEither) return false;
  if (a.presence != b.presence) return true;
  return a.presence == Presence::kThere && a.display_name && b.display_name && *a.display_name != *b.display_name;
}

}  // namespace

bool EditBook::IsHeld(const ObjectKey& key) const {
  const auto found = objects_.find(key);
  if (found == objects_.end()) return false;
  const Version& newest = found->second.back();
  return newest.made && newest.wish.presence == Presence::kThere && newest.wish.display_name;
}

std::optional<std::vector<EditId>> EditBook::BeginList(std::vector<EditPlan> plans, Moment begun) {
  std::set<std::int64_t> ids;
  for (const EditPlan& plan : plans) {
    if (plan.id && (!IsHeld({plan.history, *plan.id}) || !ids.insert(*plan.id).second)) return std::nullopt;
  }
  List list;
  list.edits.reserve(plans.size());
  for (EditPlan& plan : plans) list.edits.push_back(Begin(std::move(plan), begun).value());
  open_lists_.push_back(list);
  return std::move(list.edits);
}

/// What the object of an edit that was made is asked to be once that is undone, or done again.
std::optional<Wish> EditBook::WishAfter(EditId made, bool is_redo) const {
  const Edit& entry = edits_.at(made);
  if (!entry.key || !entry.was_made) return std::nullopt;
  const Versions& versions = objects_.at(*entry.key);
  const auto version = std::find_if(versions.begin(), versions.end(), [&](const auto& v) { return v.edit == made; });
  if (version == versions.begin() || version == versions.end() || !versions.back().made) return std::nullopt;
  const Wish& now = versions.back().wish;
  Wish after = TakenFrom((is_redo ? version : std::prev(version))->wish, entry.plan.change, now);
  return CanBeTold(now, after) ? std::optional(std::move(after)) : std::nullopt;
}

std::optional<std::vector<EditId>> EditBook::BeginUndo(const std::vector<EditId>& made, bool is_redo,
                                                       const std::string& what, Moment begun) {
  std::vector<Wish> wishes;
  wishes.reserve(made.size());
  for (const EditId edit : made) {
    auto wish = WishAfter(edit, is_redo);
    if (!wish) return std::nullopt;
    wishes.push_back(std::move(*wish));
  }
  List list;
  list.edits.reserve(made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    const Edit& of = edits_.at(made[i]);
    // It may bring back what is gone, and gives no name that was not given before.
    EditPlan plan{.what = what + " of " + of.plan.what,
                  .history = of.plan.history,
                  .id = of.key->id,
                  .before = {.presence = Presence::kGone}};
    list.edits.push_back(Enter(std::move(plan), std::move(wishes[i]), begun));
  }
  open_lists_.push_back(list);
  return std::move(list.edits);
}

/// Whether everything that there is of the history, asked for at that moment, has what the edit makes of its object;
/// nothing if it may be of before the object was as it was before the edit.
std::optional<bool> EditBook::Shows(EditId edit, const std::map<std::int64_t, Sight>& sights, Moment asked) const {
  const Edit& entry = edits_.at(edit);
  if (!entry.key) return false;  // a copy that nobody has seen
  const Versions& versions = objects_.at(*entry.key);
  if (versions.size() < 2 || versions.back().edit != edit) return std::nullopt;
  const Version& before = versions[versions.size() - 2];
  if (!before.made || *before.made > asked) return std::nullopt;
  const auto sight = sights.find(entry.key->id);
  return Allows(versions.back().wish, sight == sights.end() ? nullptr : &sight->second);
}

/// Of lists that nobody has been told about yet: in one state they are there whole or not at all.
void EditBook::CheckLists(const std::string& history, const std::map<std::int64_t, Sight>& sights, Moment asked) {
  std::erase_if(open_lists_,
                [this](const List& list) { return list.edits.empty() || edits_.at(list.edits.front()).is_over; });
  for (List& list : open_lists_) {
    if (list.is_told || edits_.at(list.edits.front()).plan.history != history) continue;
    std::size_t num_shown = 0;
    bool is_certain = true;
    for (const EditId edit : list.edits) {
      const auto shows = Shows(edit, sights, asked);
      is_certain &= shows.has_value();
      num_shown += shows.value_or(false) ? 1 : 0;
    }
    if (!is_certain || num_shown == 0 || num_shown == list.edits.size()) continue;
    list.is_told = true;
    complaints_.push_back("law 3: of a list of " + std::to_string(list.edits.size()) + " edits there are " +
                          std::to_string(num_shown) + ": " + edits_.at(list.edits.front()).plan.what);
  }
}

}  // namespace dhpmap::rig
