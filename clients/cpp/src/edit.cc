// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/edit.h"

#include <utility>

#include "clients/cpp/src/convert/edits.h"
#include "clients/cpp/src/convert/geometry.h"
#include "clients/cpp/src/edit_impl.h"

namespace dhpmap::client {

Edit::Impl::Impl(std::shared_ptr<Caller> through, const std::string& map, const EditOptions& how)
    : caller(std::move(through)), options(how) {
  request.set_map(map);
  request.set_author(how.author.empty() ? caller->author() : how.author);
  request.set_expected_revision(how.expected_revision);
}

v1::Edit& Edit::Impl::Add(const Target& object) {
  const std::string name = NameOf(object);  // before Add: the number of a new object depends on the edits so far
  v1::Edit& edit = Add();
  edit.set_submap(name);
  if (options.only_if_unedited) edit.set_etag(object.etag());
  return edit;
}

std::string Edit::Impl::NameOf(const Target& object) const {
  if (const auto* made = std::get_if<NewObject>(&object.what())) return "#" + std::to_string(made->step);
  return SubmapName(request.map(), std::get<std::int64_t>(object.what()));
}

Result<Edited> Edit::Impl::Send(const v1::ApplyEditsRequest& edits) const {
  const auto answer = caller->Call(&v1::EditService::Stub::ApplyEdits, edits, options.deadline_s);
  if (!answer.ok()) return answer.status();
  Edited edited{answer->revision(), {}};
  for (const v1::EditResult& result : answer->results()) edited.results.push_back(FromProto(result));
  return edited;
}

Edit::Edit(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Edit::Edit(Edit&&) noexcept = default;
Edit& Edit::operator=(Edit&&) noexcept = default;
Edit::~Edit() = default;

Edit& Edit::MoveTo(const Target& object, const Pose& T_map_object, bool include_supported) {
  v1::MoveEdit& move = *impl_->Add(object).mutable_move();
  *move.mutable_map_from_submap() = ToProto(T_map_object);
  move.set_include_supported(include_supported);
  return *this;
}

Edit& Edit::MoveBy(const Target& object, const Vector3& by_m, bool include_supported) {
  v1::TranslateEdit& translate = *impl_->Add(object).mutable_translate();
  *translate.mutable_offset_m() = ToProto(by_m);
  translate.set_include_supported(include_supported);
  return *this;
}

Edit& Edit::Turn(const Target& object, double angle_rad, bool include_supported) {
  v1::TurnEdit& turn = *impl_->Add(object).mutable_turn();
  turn.set_angle_rad(angle_rad);
  turn.set_include_supported(include_supported);
  return *this;
}

Edit& Edit::Place(const Target& object, const Target& on, const std::optional<Vector3>& at_m, bool include_supported) {
  v1::PlaceEdit& place = *impl_->Add(object).mutable_place();
  place.set_support(impl_->NameOf(on));
  if (at_m) *place.mutable_point_m() = ToProto(*at_m);
  place.set_include_supported(include_supported);
  return *this;
}

Edit& Edit::Delete(const Target& object) {
  (void)impl_->Add(object).mutable_delete_();
  return *this;
}

Edit& Edit::Undelete(std::int64_t object) {
  (void)impl_->Add(object).mutable_undelete();
  return *this;
}

Edit& Edit::Relabel(const Target& object, std::string_view class_name) {
  impl_->Add(object).mutable_relabel()->set_class_name(std::string(class_name));
  return *this;
}

Edit& Edit::Rename(const Target& object, std::string_view name) {
  impl_->Add(object).mutable_rename()->set_display_name(std::string(name));
  return *this;
}

Edit& Edit::Merge(const Target& object, std::span<const std::int64_t> others) {
  v1::MergeEdit& merge = *impl_->Add(object).mutable_merge();
  for (const std::int64_t other : others) merge.add_merged_submaps(impl_->NameOf(other));
  return *this;
}

Edit& Edit::SetPresent(const Target& object, bool is_present) {
  impl_->Add(object).mutable_presence()->set_presence(is_present ? v1::Submap::PRESENT : v1::Submap::ABSENT);
  return *this;
}

Edit& Edit::SetLocked(const Target& object, bool is_locked) {
  v1::Edit& edit = impl_->Add(object);
  if (is_locked) (void)edit.mutable_lock();
  else (void)edit.mutable_unlock();
  return *this;
}

Edit& Edit::Clear(const Region& region, std::span<const std::string> class_names) {
  v1::ClearEdit& clear = *impl_->Add().mutable_clear();
  SetRegion(region, clear);
  for (const std::string& name : class_names) clear.add_class_names(name);
  return *this;
}

Edit& Edit::IgnoreRegion(std::string_view name, const Region& region) {
  v1::IgnoreRegionEdit& ignore = *impl_->Add().mutable_ignore_region();
  ignore.set_name(std::string(name));
  SetRegion(region, ignore);
  return *this;
}

Edit& Edit::UnignoreRegion(std::string_view name) {
  impl_->Add().mutable_unignore_region()->set_name(std::string(name));
  return *this;
}

NewObject Edit::Clone(const Target& object, const std::optional<Pose>& T_map_object, std::string_view name) {
  v1::CloneEdit& clone = *impl_->Add(object).mutable_clone();
  if (T_map_object) *clone.mutable_map_from_submap() = ToProto(*T_map_object);
  clone.set_display_name(std::string(name));
  return impl_->Made();
}

NewObject Edit::Split(const Target& object, const Box& box, std::string_view class_name) {
  v1::SplitEdit& split = *impl_->Add(object).mutable_split();
  *split.mutable_box() = ToProto(box);
  split.set_class_name(std::string(class_name));
  return impl_->Made();
}

Result<Edited> Edit::Preview() const {
  v1::ApplyEditsRequest request = impl_->request;
  request.set_validate_only(true);
  return impl_->Send(request);
}

Result<Edited> Edit::Apply() {
  impl_->request.set_request_id(NewRequestId());
  Result<Edited> edited = impl_->Send(impl_->request);
  impl_->request.clear_edits();
  return edited;
}

}  // namespace dhpmap::client
