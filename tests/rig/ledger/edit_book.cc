// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/ledger/edit_book.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace dhpmap::rig {
namespace {

constexpr double kSamePlace_m = 1e-9;

std::string InWords(const Eigen::Vector3d& p) {
  std::ostringstream text;
  text << p.transpose();
  return text.str();
}

std::string InWords(const Wish& wish) {
  std::string text = wish.presence == Presence::kGone    ? "gone"
                     : wish.presence == Presence::kThere ? "there"
                                                         : "perhaps there";
  if (wish.display_name) text += " as '" + *wish.display_name + "'";
  if (wish.position_m) text += " at " + InWords(*wish.position_m);
  if (wish.class_id) text += " of class " + std::to_string(*wish.class_id);
  return text;
}

std::string InWords(const Sight* sight) {
  if (sight == nullptr) return "gone";
  return "'" + sight->display_name + "' at " + InWords(sight->position_m) + " of class " +
         std::to_string(sight->class_id);
}

/// `change` on top of `wish`.
Wish Changed(Wish wish, const Wish& change) {
  if (change.presence != Presence::kEither) wish.presence = change.presence;
  if (change.display_name) wish.display_name = change.display_name;
  if (change.position_m) wish.position_m = change.position_m;
  if (change.class_id) wish.class_id = change.class_id;
  return wish;
}

}  // namespace

std::string ToString(const ObjectKey& key) { return key.history + "/" + std::to_string(key.id); }

bool EditBook::Allows(const Wish& wish, const Sight* sight) {
  if (sight == nullptr) return wish.presence != Presence::kThere;
  return wish.presence != Presence::kGone && (!wish.display_name || *wish.display_name == sight->display_name) &&
         (!wish.position_m || (*wish.position_m - sight->position_m).norm() <= kSamePlace_m) &&
         (!wish.class_id || *wish.class_id == sight->class_id);
}

EditBook::Versions& EditBook::VersionsOf(const ObjectKey& key, const Wish& before) {
  Versions& versions = objects_[key];
  if (versions.empty()) versions.push_back({.wish = before, .begun = 0, .made = 0});
  return versions;
}

std::optional<EditId> EditBook::Begin(EditPlan plan, Moment begun) {
  Wish wish;
  if (plan.id) {
    const Versions& versions = VersionsOf({plan.history, *plan.id}, plan.before);
    if (!versions.back().made) return std::nullopt;
    wish = Changed(versions.back().wish, plan.change);
  }
  return Enter(std::move(plan), std::move(wish), begun);
}

/// `wish`: what the plan's object, if it has an id, is asked to be from now on.
EditId EditBook::Enter(EditPlan plan, Wish wish, Moment begun) {
  const EditId edit = static_cast<EditId>(edits_.size()) + 1;
  if (plan.id) {
    VersionsOf({plan.history, *plan.id}, plan.before)
        .push_back({.wish = std::move(wish), .begun = begun, .made = std::nullopt, .edit = edit});
  }
  if (plan.change.display_name) names_[*plan.change.display_name] = edit;
  Edit& entry = edits_[edit];
  entry.begun = begun;
  if (plan.id) entry.key = {plan.history, *plan.id};
  entry.plan = std::move(plan);
  return edit;
}

/// A copy that was seen, or answered, has an id.
void EditBook::Adopt(EditId edit, const ObjectKey& key) {
  Edit& entry = edits_.at(edit);
  entry.key = key;
  Versions& versions = VersionsOf(key, {.presence = Presence::kGone});
  if (versions.size() > 1) {
    std::string known = InWords(versions.front().wish);
    for (std::size_t v = 1; v < versions.size(); ++v) known += ", then " + edits_.at(versions[v].edit).plan.what;
    complaints_.push_back("law 1: a copy has the id of another object: " + entry.plan.what + " is " + ToString(key) +
                          ", which was " + known);
  }
  versions.push_back({.wish = Changed(versions.back().wish, entry.plan.change), .begun = entry.begun, .edit = edit});
}

void EditBook::OnMade(EditId edit, std::optional<std::int64_t> id, const Sight* sight, Moment answered) {
  Edit& entry = edits_.at(edit);
  if (!entry.key && id) Adopt(edit, {entry.plan.history, *id});
  if (!entry.key) return;
  if (id && *id != entry.key->id) {
    complaints_.push_back("law 3: " + entry.plan.what + " was answered for " + std::to_string(*id) + ", but seen as " +
                          ToString(*entry.key));
  }
  Versions& versions = objects_.at(*entry.key);
  if (versions.size() > 1 && versions[versions.size() - 2].wish.presence == Presence::kGone && entry.plan.id &&
      entry.plan.before.presence != Presence::kGone) {
    complaints_.push_back("law 3: made, although the object is gone: " + entry.plan.what);
  }
  Decide(edit, true, answered);
  if (sight != nullptr) Check(*entry.key, sight, answered, answered);
}

void EditBook::OnRefused(EditId edit) {
  const Edit& entry = edits_.at(edit);
  if (entry.is_seen) complaints_.push_back("law 3: refused, but seen before: " + entry.plan.what);
  Decide(edit, false, 0);
}

void EditBook::Decide(EditId edit, bool was_made, Moment moment) {
  Edit& entry = edits_.at(edit);
  entry.is_over = true;
  entry.was_made = was_made;
  if (!entry.key) return;
  Versions& versions = objects_.at(*entry.key);
  const auto version = std::find_if(versions.begin(), versions.end(), [&](const auto& v) { return v.edit == edit; });
  if (version == versions.end()) return;
  if (was_made) version->made = moment;
  else versions.erase(version);
}

/// Complains of a name that no edit can have given to this object.
bool EditBook::MayHaveItsName(const ObjectKey& key, const Sight& sight) {
  if (!sight.display_name.starts_with(kMark)) return true;
  const auto named = names_.find(sight.display_name);
  if (named == names_.end()) {
    complaints_.push_back("law 3: " + ToString(key) + " has a name that nobody gave: " + InWords(&sight));
    return false;
  }
  Edit& entry = edits_.at(named->second);
  if (entry.plan.history == key.history && !entry.key && !entry.is_over) Adopt(named->second, key);
  if (entry.key == key && (!entry.is_over || entry.was_made)) return true;
  complaints_.push_back("law 3: " + ToString(key) + " is what was asked for in vain: " + entry.plan.what);
  return false;
}

void EditBook::Check(const ObjectKey& key, const Sight* sight, Moment asked, Moment answered) {
  if (sight != nullptr && !MayHaveItsName(key, *sight)) return;
  const auto found = objects_.find(key);
  if (found == objects_.end()) return;
  const Versions& versions = found->second;
  std::string allowed;
  std::optional<EditId> only_by;  // an edit that nobody has heard of yet
  for (auto version = versions.rbegin(); version != versions.rend(); ++version) {
    if (version->begun <= answered) {
      const bool is_allowed = Allows(version->wish, sight);
      if (is_allowed && version->made) return;
      if (is_allowed) only_by = version->edit;
      allowed += (allowed.empty() ? "" : ", or ") + InWords(version->wish);
    }
    if (version->made && *version->made <= asked) break;  // whatever was before has been told to be over
  }
  if (only_by) edits_.at(*only_by).is_seen = true;
  else complaints_.push_back("law 3: " + ToString(key) + " is " + InWords(sight) + ", but must be " + allowed);
}

void EditBook::OnSeen(const ObjectKey& key, const Sight& sight, Moment asked, Moment answered) {
  Check(key, &sight, asked, answered);
}

void EditBook::OnAbsent(const ObjectKey& key, Moment asked, Moment answered) { Check(key, nullptr, asked, answered); }

void EditBook::OnWhole(const std::string& history, const std::map<std::int64_t, Sight>& sights, Moment asked,
                       Moment answered) {
  for (const auto& [id, sight] : sights) Check({history, id}, &sight, asked, answered);
  for (auto it = objects_.lower_bound({history, 0}); it != objects_.end() && it->first.history == history; ++it) {
    if (!sights.contains(it->first.id)) Check(it->first, nullptr, asked, answered);
  }
  CheckLists(history, sights, asked);
}

int EditBook::OnRestarted(const std::string& history, const std::map<std::int64_t, Sight>& sights, Moment asked,
                          Moment answered) {
  OnWhole(history, sights, asked, answered);
  int num_made = 0;
  for (auto& [edit, entry] : edits_) {
    if (entry.is_over || !entry.is_cut || entry.plan.history != history) continue;
    bool was_made = false;
    // One in vain leaves no trace, though what it asked for may be so: an id of another map's is free here as yet.
    if (entry.key && !entry.plan.is_vain) {
      const Versions& versions = objects_.at(*entry.key);
      const auto sight = sights.find(entry.key->id);
      was_made = versions.back().edit == edit &&
                 Allows(versions.back().wish, sight == sights.end() ? nullptr : &sight->second);
    }
    if (entry.is_seen && !was_made) complaints_.push_back("law 3: lost, but seen before: " + entry.plan.what);
    Decide(edit, was_made, answered);
    num_made += was_made ? 1 : 0;
  }
  return num_made;
}

bool EditBook::IsGone(const ObjectKey& key, Moment moment) const {
  const auto found = objects_.find(key);
  if (found == objects_.end()) return false;
  const Version& newest = found->second.back();
  return newest.made && *newest.made <= moment && newest.wish.presence == Presence::kGone;
}

}  // namespace dhpmap::rig
