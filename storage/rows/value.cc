// SPDX-License-Identifier: BSD-3-Clause
#include "storage/rows/value.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dhpmap {

const char* SqlTypeName(SqlType type) {
  switch (type) {
    case SqlType::kInteger: return "INTEGER";
    case SqlType::kReal: return "REAL";
    case SqlType::kText: return "TEXT";
    case SqlType::kBlob: return "BLOB";
  }
  return "";
}

std::int64_t ToInteger(Color color) { return (std::int64_t{color.r} << 16) | (std::int64_t{color.g} << 8) | color.b; }

Color FromInteger(std::int64_t stored, std::type_identity<Color>) {
  return {static_cast<std::uint8_t>(stored >> 16), static_cast<std::uint8_t>(stored >> 8),
          static_cast<std::uint8_t>(stored)};
}

Bytes ToBytes(const Transform& T) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) writer.PutF64(T.matrix()(row, column));
  }
  return bytes;
}

bool FromBytes(ByteView bytes, Transform& T) {
  ByteReader reader(bytes);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) T.matrix()(row, column) = reader.GetF64();
  }
  return reader.ok() && reader.remaining() == 0;
}

Bytes ToBytes(const BoundingSphere& sphere) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const double value : {sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z(), sphere.radius_m}) {
    writer.PutF64(value);
  }
  return bytes;
}

bool FromBytes(ByteView bytes, BoundingSphere& sphere) {
  ByteReader reader(bytes);
  for (double* value : {&sphere.center_m.x(), &sphere.center_m.y(), &sphere.center_m.z(), &sphere.radius_m}) {
    *value = reader.GetF64();
  }
  return reader.ok() && reader.remaining() == 0;
}

namespace {

/// Imported maps may have infinite distances, from which no box follows.
bool IsFinite(const LevelOutline& outline) {
  if (!outline.up.allFinite()) return false;
  if (!outline.outline) return true;
  const UprightBox& box = outline.outline->box;
  return box.center_m.allFinite() && box.size_m.allFinite() && std::isfinite(box.yaw_rad) &&
         std::isfinite(outline.outline->support_height_m.value_or(0)) &&
         std::all_of(outline.outline->footprint_m.begin(), outline.outline->footprint_m.end(),
                     [](const Eigen::Vector2d& corner) { return corner.allFinite(); });
}

}  // namespace

Bytes ToBytes(const std::shared_ptr<const LevelOutline>& outline) {
  Bytes bytes;
  if (outline == nullptr || !IsFinite(*outline)) return bytes;
  ByteWriter writer(bytes);
  for (int axis = 0; axis < 3; ++axis) writer.PutF64(outline->up[axis]);
  writer.PutU8(outline->outline.has_value());
  if (!outline->outline) return bytes;
  const UprightBox& box = outline->outline->box;
  for (int axis = 0; axis < 3; ++axis) writer.PutF64(box.center_m[axis]);
  writer.PutF64(box.yaw_rad);
  for (int axis = 0; axis < 3; ++axis) writer.PutF64(box.size_m[axis]);
  writer.PutU8(outline->outline->support_height_m.has_value());
  if (outline->outline->support_height_m) writer.PutF64(*outline->outline->support_height_m);
  writer.PutVarint(outline->outline->footprint_m.size());
  for (const Eigen::Vector2d& corner : outline->outline->footprint_m) {
    writer.PutF64(corner.x());
    writer.PutF64(corner.y());
  }
  return bytes;
}

namespace {

/// Reads doubles and records whether all are finite.
struct FiniteReader {
  ByteReader& in;
  bool good = true;
  double Get() {
    const double value = in.GetF64();
    good = good && std::isfinite(value);
    return value;
  }
};

SubmapOutline ReadOutline(ByteReader& in, FiniteReader& numbers) {
  SubmapOutline outline;
  for (int axis = 0; axis < 3; ++axis) outline.box.center_m[axis] = numbers.Get();
  outline.box.yaw_rad = numbers.Get();
  for (int axis = 0; axis < 3; ++axis) outline.box.size_m[axis] = numbers.Get();
  if (in.GetU8() != 0) outline.support_height_m = numbers.Get();
  const std::uint64_t num_corners = in.GetVarint();
  if (num_corners > in.remaining() / (2 * sizeof(double))) {
    numbers.good = false;
    return outline;
  }
  outline.footprint_m.resize(num_corners);
  for (Eigen::Vector2d& corner : outline.footprint_m) {
    corner.x() = numbers.Get();
    corner.y() = numbers.Get();
  }
  return outline;
}

}  // namespace

bool FromBytes(ByteView bytes, std::shared_ptr<const LevelOutline>& outline) {
  outline = nullptr;
  if (bytes.empty()) return true;
  ByteReader reader(bytes);
  FiniteReader numbers{reader};
  LevelOutline read;
  for (int axis = 0; axis < 3; ++axis) read.up[axis] = numbers.Get();
  if (reader.GetU8() != 0) read.outline = ReadOutline(reader, numbers);
  if (!numbers.good || !reader.ok() || reader.remaining() != 0) return false;
  outline = std::make_shared<const LevelOutline>(std::move(read));
  return true;
}

Bytes ToBytes(const Region& region) {
  Bytes bytes;
  ByteWriter writer(bytes);
  writer.PutU8(static_cast<std::uint8_t>(region.index()));
  if (const auto* box = std::get_if<Eigen::AlignedBox3d>(&region)) {
    for (const auto* corner : {&box->min(), &box->max()}) {
      for (int axis = 0; axis < 3; ++axis) writer.PutF64((*corner)[axis]);
    }
  } else {
    writer.PutBytes(ToBytes(std::get<BoundingSphere>(region)));
  }
  return bytes;
}

bool FromBytes(ByteView bytes, Region& region) {
  if (bytes.empty() || bytes[0] > 1) return false;
  if (bytes[0] == 1) {
    region = BoundingSphere();
    return FromBytes(bytes.subspan(1), std::get<BoundingSphere>(region));
  }
  Eigen::AlignedBox3d box;
  ByteReader reader(bytes.subspan(1));
  for (auto* corner : {&box.min(), &box.max()}) {
    for (int axis = 0; axis < 3; ++axis) (*corner)[axis] = reader.GetF64();
  }
  region = box;
  return reader.ok() && reader.remaining() == 0;
}

Bytes ToBytes(const std::vector<ClassTotal>& counts) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const ClassTotal& entry : counts) {
    writer.PutU32(entry.id.value);
    writer.PutU64(entry.count);
  }
  return bytes;
}

bool FromBytes(ByteView bytes, std::vector<ClassTotal>& counts) {
  counts.clear();
  ByteReader reader(bytes);
  while (reader.remaining() > 0) {
    const std::uint32_t id = reader.GetU32();
    if (!std::in_range<std::uint16_t>(id)) return false;
    counts.push_back({ClassId(static_cast<std::uint16_t>(id)), reader.GetU64()});
  }
  return reader.ok();
}

Bytes ToBytes(const Sightings& sightings) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const Sighting& sighting : sightings.all()) {
    writer.PutText(sighting.session);
    writer.PutVarint(sighting.track_id);
    writer.PutU8(sighting.has_in_sight ? 1 : 0);
    writer.PutVarint(static_cast<std::uint64_t>(sighting.num_frames_missed));
    writer.PutVarint(static_cast<std::uint64_t>(sighting.last_frame));
  }
  return bytes;
}

bool FromBytes(ByteView bytes, Sightings& sightings) {
  std::vector<Sighting> all;
  ByteReader reader(bytes);
  while (reader.remaining() > 0) {
    Sighting& sighting = all.emplace_back();
    const ByteView session = reader.GetBytes(reader.GetVarint());
    sighting.session.assign(session.begin(), session.end());
    const std::uint64_t track_id = reader.GetVarint();
    const std::uint8_t has_in_sight = reader.GetU8();
    const std::uint64_t num_missed = reader.GetVarint(), last_frame = reader.GetVarint();
    const bool is_in_range = std::in_range<std::uint32_t>(track_id) && has_in_sight <= 1 &&
                             std::in_range<std::int32_t>(num_missed) && std::in_range<std::int64_t>(last_frame);
    if (!reader.ok() || !is_in_range) return false;
    sighting.track_id = static_cast<std::uint32_t>(track_id);
    sighting.has_in_sight = has_in_sight == 1;
    sighting.num_frames_missed = static_cast<std::int32_t>(num_missed);
    sighting.last_frame = static_cast<std::int64_t>(last_frame);
  }
  Result<Sightings> created = Sightings::Create(std::move(all));
  if (!created.ok()) return false;
  sightings = *std::move(created);
  return true;
}

}  // namespace dhpmap
