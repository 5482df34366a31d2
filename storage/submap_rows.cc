// SPDX-License-Identifier: BSD-3-Clause
#include "storage/submap_rows.h"

#include <string>
#include <utility>

#include "storage/codec/bytes.h"
#include "storage/codec/crc32c.h"

namespace dhpmap {
namespace {

using sqlite::Database;
using sqlite::Statement;

constexpr char kReadTask[] = "read the submaps";
constexpr char kWriteTask[] = "write a submap";

constexpr char kSelect[] =
    "SELECT submap_key, submap_id, panoptic, class_id, class_is_fixed, display_name, pose, sphere, voxel_size_m, "
    "truncation_m, class_counts, instance_confidence, activity, is_confirmed, num_frames_observed, num_frames_missed, "
    "num_frames_overlooked, first_observed_ns, last_observed_ns, track_id, revision, num_tsdf_blocks, "
    "num_label_blocks, checksum, blob_bytes FROM submaps WHERE map_key = ? ORDER BY submap_id";

constexpr char kUpsert[] =
    "INSERT INTO submaps (map_key, submap_id, panoptic, class_id, class_is_fixed, display_name, pose, sphere, "
    "voxel_size_m, truncation_m, class_counts, instance_confidence, activity, is_confirmed, num_frames_observed, "
    "num_frames_missed, num_frames_overlooked, first_observed_ns, last_observed_ns, track_id, revision, "
    "num_tsdf_blocks, num_label_blocks, checksum) VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?) "
    "ON CONFLICT (map_key, submap_id) DO UPDATE SET panoptic = excluded.panoptic, class_id = excluded.class_id, "
    "class_is_fixed = excluded.class_is_fixed, display_name = excluded.display_name, pose = excluded.pose, "
    "sphere = excluded.sphere, voxel_size_m = excluded.voxel_size_m, truncation_m = excluded.truncation_m, "
    "class_counts = excluded.class_counts, instance_confidence = excluded.instance_confidence, "
    "activity = excluded.activity, is_confirmed = excluded.is_confirmed, "
    "num_frames_observed = excluded.num_frames_observed, num_frames_missed = excluded.num_frames_missed, "
    "num_frames_overlooked = excluded.num_frames_overlooked, first_observed_ns = excluded.first_observed_ns, "
    "last_observed_ns = excluded.last_observed_ns, track_id = excluded.track_id, revision = excluded.revision, "
    "num_tsdf_blocks = excluded.num_tsdf_blocks, num_label_blocks = excluded.num_label_blocks, "
    "checksum = excluded.checksum RETURNING submap_key";

// Poses and spheres as bytes: SQLite's REAL turns -0.0 into 0 and NaN into NULL.

Bytes PoseBytes(const Transform& T) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) writer.PutF64(T.matrix()(row, column));
  }
  return bytes;
}

Bytes SphereBytes(const BoundingSphere& sphere) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const double value : {sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z(), sphere.radius_m}) {
    writer.PutF64(value);
  }
  return bytes;
}

Bytes CountBytes(const std::vector<ClassTotal>& counts) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const ClassTotal& entry : counts) {
    writer.PutU32(entry.id.value);
    writer.PutU64(entry.count);
  }
  return bytes;
}

bool ReadPose(ByteView bytes, Transform& T) {
  ByteReader reader(bytes);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) T.matrix()(row, column) = reader.GetF64();
  }
  return reader.ok() && reader.remaining() == 0;
}

bool ReadSphere(ByteView bytes, BoundingSphere& sphere) {
  ByteReader reader(bytes);
  for (double* value : {&sphere.center_m.x(), &sphere.center_m.y(), &sphere.center_m.z(), &sphere.radius_m}) {
    *value = reader.GetF64();
  }
  return reader.ok() && reader.remaining() == 0;
}

bool ReadCounts(ByteView bytes, std::vector<ClassTotal>& counts) {
  ByteReader reader(bytes);
  while (reader.remaining() > 0) {
    const ClassId id(static_cast<std::uint16_t>(reader.GetU32()));
    counts.push_back({id, reader.GetU64()});
  }
  return reader.ok();
}

/// Over everything that the row stands for, and its map.
std::uint32_t Checksum(std::int64_t map_key, const SubmapInfo& info, const BoundingSphere& sphere,
                       const SubmapCounts& counts) {
  Bytes bytes;
  ByteWriter writer(bytes);
  for (const std::int64_t value :
       {map_key, std::int64_t{info.id.value}, static_cast<std::int64_t>(info.panoptic),
        std::int64_t{info.class_id.value}, std::int64_t{info.class_is_fixed}, static_cast<std::int64_t>(info.activity),
        std::int64_t{info.is_confirmed}, info.num_frames_observed, std::int64_t{info.num_frames_missed},
        std::int64_t{info.num_frames_overlooked}, info.first_observed_ns, info.last_observed_ns,
        std::int64_t{info.track_id}, info.revision, counts.num_tsdf_blocks, counts.num_label_blocks}) {
    writer.PutU64(static_cast<std::uint64_t>(value));
  }
  writer.PutText(info.display_name);
  writer.PutBytes(PoseBytes(info.T_map_submap));
  writer.PutBytes(SphereBytes(sphere));
  writer.PutF64(info.voxel_size_m);
  writer.PutF64(info.truncation_m);
  writer.PutF32(info.instance_confidence);
  writer.PutBytes(CountBytes(info.class_counts));
  return Crc32c(bytes);
}

/// The row that a statement of kSelect is at.
Result<SubmapRow> ReadRow(const Statement& row, std::int64_t map_key) {
  SubmapRow read{.key = row.Int(0), .info = {}, .sphere = {}, .counts = {row.Int(21), row.Int(22), row.Int(24)}};
  SubmapInfo& info = read.info;
  info.id = SubmapId(static_cast<std::uint32_t>(row.Int(1)));
  info.panoptic = static_cast<Panoptic>(row.Int(2));
  info.class_id = ClassId(static_cast<std::uint16_t>(row.Int(3)));
  info.class_is_fixed = row.Int(4) != 0;
  info.display_name = row.Text(5);
  info.voxel_size_m = row.Real(8);
  info.truncation_m = row.Real(9);
  info.instance_confidence = static_cast<float>(row.Real(11));
  info.activity = static_cast<Activity>(row.Int(12));
  info.is_confirmed = row.Int(13) != 0;
  info.num_frames_observed = row.Int(14);
  info.num_frames_missed = static_cast<std::int32_t>(row.Int(15));
  info.num_frames_overlooked = static_cast<std::int32_t>(row.Int(16));
  info.first_observed_ns = row.Int(17);
  info.last_observed_ns = row.Int(18);
  info.track_id = static_cast<std::uint32_t>(row.Int(19));
  info.revision = row.Int(20);
  if (!ReadPose(row.Blob(6), info.T_map_submap) || !ReadSphere(row.Blob(7), read.sphere) ||
      !ReadCounts(row.Blob(10), info.class_counts) ||
      Checksum(map_key, info, read.sphere, read.counts) != row.Int(23)) {
    return DataLoss("submap " + std::to_string(info.id.value) + ": its row has a wrong checksum");
  }
  return read;
}

}  // namespace

SubmapCounts CountBlocks(const Submap& submap) {
  SubmapCounts counts;
  for (const BlockEntry& entry : submap.blocks().entries()) {
    counts.num_tsdf_blocks += entry.tsdf != nullptr;
    counts.num_label_blocks += entry.labels != nullptr;
  }
  return counts;
}

Result<std::vector<SubmapRow>> ReadSubmaps(Database& database, std::int64_t map_key) {
  DHPMAP_ASSIGN_OR_RETURN(Statement select, database.Prepare(kSelect, kReadTask));
  select.Bind(map_key);
  std::vector<SubmapRow> rows;
  for (;;) {
    DHPMAP_ASSIGN_OR_RETURN(const bool has_row, select.Step());
    if (!has_row) return rows;
    DHPMAP_ASSIGN_OR_RETURN(SubmapRow row, ReadRow(select, map_key));
    rows.push_back(std::move(row));
  }
}

SubmapRowWriter::SubmapRowWriter(Statement find, Statement upsert, Statement set_bytes, Statement erase,
                                 Statement write_box, Statement erase_box)
    : find_(std::move(find)),
      upsert_(std::move(upsert)),
      set_bytes_(std::move(set_bytes)),
      erase_(std::move(erase)),
      write_box_(std::move(write_box)),
      erase_box_(std::move(erase_box)) {}

Result<SubmapRowWriter> SubmapRowWriter::Prepare(Database& database) {
  DHPMAP_ASSIGN_OR_RETURN(
      Statement find, database.Prepare("SELECT submap_key, num_tsdf_blocks, num_label_blocks, blob_bytes FROM submaps "
                                       "WHERE map_key = ? AND submap_id = ?",
                                       kWriteTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement upsert, database.Prepare(kUpsert, kWriteTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement set_bytes,
                          database.Prepare("UPDATE submaps SET blob_bytes = ? WHERE submap_key = ?", kWriteTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase,
                          database.Prepare("DELETE FROM submaps WHERE submap_key = ?", "delete a submap"));
  DHPMAP_ASSIGN_OR_RETURN(
      Statement write_box,
      database.Prepare("INSERT OR REPLACE INTO submap_boxes VALUES (?, ?, ?, ?, ?, ?, ?, ?)", kWriteTask));
  DHPMAP_ASSIGN_OR_RETURN(Statement erase_box,
                          database.Prepare("DELETE FROM submap_boxes WHERE submap_key = ?", kWriteTask));
  return SubmapRowWriter(std::move(find), std::move(upsert), std::move(set_bytes), std::move(erase),
                         std::move(write_box), std::move(erase_box));
}

Result<std::optional<SubmapRowWriter::Stored>> SubmapRowWriter::Find(std::int64_t map_key, SubmapId id) {
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, find_.Bind(map_key).Bind(id.value).Step());
  if (!has_row) return std::optional<Stored>();
  const Stored stored{find_.Int(0), {find_.Int(1), find_.Int(2), find_.Int(3)}};
  find_.Reset();
  return std::optional<Stored>(stored);
}

Result<std::int64_t> SubmapRowWriter::Write(std::int64_t map_key, const Submap& submap) {
  const SubmapInfo& info = submap.info();
  const SubmapCounts counts = CountBlocks(submap);
  const Bytes pose = PoseBytes(info.T_map_submap), sphere = SphereBytes(submap.bounding_sphere());
  const Bytes class_counts = CountBytes(info.class_counts);
  upsert_.Bind(map_key).Bind(info.id.value).Bind(static_cast<int>(info.panoptic)).Bind(info.class_id.value);
  upsert_.Bind(info.class_is_fixed).Bind(info.display_name).Bind(pose).Bind(sphere);
  upsert_.Bind(info.voxel_size_m).Bind(info.truncation_m).Bind(class_counts);
  upsert_.Bind(static_cast<double>(info.instance_confidence)).Bind(static_cast<int>(info.activity));
  upsert_.Bind(info.is_confirmed).Bind(info.num_frames_observed).Bind(info.num_frames_missed);
  upsert_.Bind(info.num_frames_overlooked).Bind(info.first_observed_ns).Bind(info.last_observed_ns);
  upsert_.Bind(info.track_id).Bind(info.revision).Bind(counts.num_tsdf_blocks).Bind(counts.num_label_blocks);
  upsert_.Bind(Checksum(map_key, info, submap.bounding_sphere(), counts));
  DHPMAP_ASSIGN_OR_RETURN(const bool has_row, upsert_.Step());
  if (!has_row) return Internal("writing a submap gave no key");
  const std::int64_t key = upsert_.Int(0);
  DHPMAP_RETURN_IF_ERROR(upsert_.Run());

  const BoundingSphere in_map = submap.BoundingSphereInMap();
  if (in_map.IsEmpty()) {
    DHPMAP_RETURN_IF_ERROR(erase_box_.Bind(key).Run());
    return key;
  }
  write_box_.Bind(key);
  for (int axis = 0; axis < 3; ++axis) {
    write_box_.Bind(in_map.center_m[axis] - in_map.radius_m).Bind(in_map.center_m[axis] + in_map.radius_m);
  }
  DHPMAP_RETURN_IF_ERROR(write_box_.Bind(map_key).Run());
  return key;
}

Status SubmapRowWriter::SetBlobBytes(std::int64_t submap_key, std::int64_t blob_bytes) {
  return set_bytes_.Bind(blob_bytes).Bind(submap_key).Run();
}

Status SubmapRowWriter::Erase(std::int64_t submap_key) { return erase_.Bind(submap_key).Run(); }

}  // namespace dhpmap
