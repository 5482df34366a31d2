// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mapping/base/ids.h"
#include "mapping/map/region.h"
#include "mapping/submap/submap_fields.h"
#include "storage/codec/bytes.h"

namespace dhpmap {

// One function for both directions, so that they cannot differ: a Coder is a FieldWriter or a FieldReader.

class FieldWriter {
 public:
  explicit FieldWriter(Bytes& bytes) : out_(bytes) {}

  template <typename Int>
  requires(std::is_integral_v<Int> || std::is_enum_v<Int>) void Do(const Int& value) {
    out_.PutVarint(ZigZag(static_cast<std::int64_t>(value)));
  }
  template <typename Tag, typename Int>
  void Do(const StrongId<Tag, Int>& id) {
    Do(id.value);
  }
  void Do(const double& value) { out_.PutF64(value); }
  void Do(const float& value) { out_.PutF32(value); }
  void Do(const std::string& text) { out_.PutText(text); }
  /// Length of a list; each entry takes at least `least_bytes`.
  template <typename Item>
  void DoSize(const std::vector<Item>& list, std::size_t /*least_bytes*/) {
    out_.PutVarint(list.size());
  }

 private:
  static std::uint64_t ZigZag(std::int64_t value) {
    return static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
  }
  ByteWriter out_;
};

class FieldReader {
 public:
  explicit FieldReader(ByteView bytes) : in_(bytes) {}

  [[nodiscard]] bool IsAtGoodEnd() const { return good_ && in_.ok() && in_.remaining() == 0; }
  /// Marks values that are read but inconsistent.
  void Refuse() { good_ = false; }

  template <typename Int>
  requires(std::is_integral_v<Int> || std::is_enum_v<Int>) void Do(Int& value) {
    const std::uint64_t stored = in_.GetVarint();
    const auto number = static_cast<std::int64_t>(stored >> 1 ^ (~(stored & 1) + 1));
    value = static_cast<Int>(number);
    good_ = good_ && static_cast<std::int64_t>(value) == number;
  }
  template <typename Tag, typename Int>
  void Do(StrongId<Tag, Int>& id) {
    Do(id.value);
  }
  void Do(double& value) { value = in_.GetF64(); }
  void Do(float& value) { value = in_.GetF32(); }
  void Do(std::string& text) {
    const ByteView view = in_.GetBytes(in_.GetVarint());
    text.assign(view.begin(), view.end());
  }
  /// Checks the length against the remaining bytes before allocating.
  template <typename Item>
  void DoSize(std::vector<Item>& list, std::size_t least_bytes) {
    const std::uint64_t size = in_.GetVarint();
    if (size > in_.remaining() / least_bytes) good_ = false;
    else list.resize(size);
  }

 private:
  ByteReader in_;
  bool good_ = true;
};

/// A presence flag, then the value.
template <typename Coder, typename Optional, typename Visit>
void DoOptional(Coder& coder, Optional& value, Visit&& visit) {
  bool has_value = value.has_value();
  coder.Do(has_value);
  if constexpr (!std::is_const_v<Optional>) {
    if (has_value && !value) value.emplace();
  }
  if (has_value) visit(*value);
}

template <typename Coder, typename Sphere>
void DoSphere(Coder& coder, Sphere& sphere) {
  for (int axis = 0; axis < 3; ++axis) coder.Do(sphere.center_m[axis]);
  coder.Do(sphere.radius_m);
}

/// A region, as its kind and its numbers.
template <typename Coder, typename AnyRegion>
void DoRegion(Coder& coder, AnyRegion& region) {
  bool is_box = region.index() == 0;
  coder.Do(is_box);
  if constexpr (std::is_same_v<Coder, FieldReader>) {
    if (is_box) region = Eigen::AlignedBox3d();
    else region = BoundingSphere();
  }
  if (is_box) {
    auto& box = std::get<Eigen::AlignedBox3d>(region);
    for (auto* corner : {&box.min(), &box.max()}) {
      for (int axis = 0; axis < 3; ++axis) coder.Do((*corner)[axis]);
    }
  } else {
    DoSphere(coder, std::get<BoundingSphere>(region));
  }
}

/// Minimum size of a row, from its doubles: pose, voxel size, truncation.
inline constexpr std::size_t kLeastInfo_bytes = sizeof(double) * (12 + 2);

template <typename Coder, typename Value>
requires requires(Coder coder, Value& value) { coder.Do(value); }
void DoField(Coder& coder, Value& value) { coder.Do(value); }

template <typename Coder, typename Pose>
requires std::is_same_v<std::remove_const_t<Pose>, Transform>
void DoField(Coder& coder, Pose& pose) {
  auto& matrix = pose.matrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) coder.Do(matrix(row, column));
  }
}

template <typename Coder, typename Counts>
requires std::is_same_v<std::remove_const_t<Counts>, std::vector<ClassTotal>>
void DoField(Coder& coder, Counts& counts) {
  coder.DoSize(counts, 2);
  for (auto& entry : counts) {
    coder.Do(entry.id);
    coder.Do(entry.count);
  }
}

template <typename Coder, typename AllSightings>
requires std::is_same_v<std::remove_const_t<AllSightings>, Sightings>
void DoField(Coder& coder, AllSightings& sightings) {
  std::vector<Sighting> all = sightings.all();
  coder.DoSize(all, 5);
  for (Sighting& sighting : all) {
    coder.Do(sighting.session);
    coder.Do(sighting.track_id);
    coder.Do(sighting.has_in_sight);
    coder.Do(sighting.num_frames_missed);
    coder.Do(sighting.last_frame);
  }
  if constexpr (std::is_same_v<Coder, FieldReader>) {
    Result<Sightings> created = Sightings::Create(std::move(all));
    if (created.ok()) sightings = *std::move(created);
    else coder.Refuse();
  }
}

/// The fields of a SubmapInfo covered since one of these checksum versions, both included.
template <typename Coder, typename Info>
void DoFields(Coder& coder, int first, int last, Info& info) {
  VisitSubmapFields([&](const auto& field) {
    if (field.since >= first && field.since <= last) DoField(coder, field.Of(info));
  });
}

/// A SubmapInfo as of schema 7. Later fields follow (DoFields), in kinds of blobs that have them.
template <typename Coder, typename Info>
void DoInfo(Coder& coder, Info& info) {
  constexpr int kVersionOfSchema7 = 3;
  DoFields(coder, 1, kVersionOfSchema7, info);
}

}  // namespace dhpmap
