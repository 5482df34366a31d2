// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/map_reader.h"

#include <limits>
#include <utility>

#include "storage/paging/map_layers.h"
#include "storage/postgres/commit/tile_writes.h"
#include "storage/postgres/reading/paged_submap.h"
#include "storage/postgres/rows/table_text.h"
#include "storage/rows/submap_rows.h"
#include "storage/submap_maker.h"

namespace dhpmap::postgres {
namespace {

constexpr char kReadStateTask[] = "read the map";
const std::string kTiles =
    "SELECT t.owner_id, t.x, t.y, t.z, t.layer, t.blob_key, b.blob_key IS NULL, coalesce(c.num_refs, 1) > 1, "
    "coalesce(b.num_blocks, 0), t.cells, t.extent, b.blob FROM tiles t LEFT JOIN tile_blobs b ON b.map_key = t.map_key "
    "AND b.blob_key = t.blob_key LEFT JOIN blob_counts c ON c.map_key = t.map_key AND c.blob_key = t.blob_key ";
const std::string kAllTiles = kTiles + "WHERE t.map_key = $1 ORDER BY t.owner_id, t.x, t.y, t.z, t.layer";
const std::string kOwnTiles = kTiles + "WHERE t.map_key = $1 AND t.owner_id = $2 ORDER BY t.x, t.y, t.z, t.layer";

TileRow TileOf(Answer& answer) {
  TileRow row;
  for (std::int32_t* axis : {&row.index.x, &row.index.y, &row.index.z}) *axis = static_cast<std::int32_t>(answer.Int());
  row.layer = answer.Int();
  row.blob_key = answer.Int();
  row.is_missing = answer.Int() != 0;
  row.is_shared = answer.Int() != 0;
  row.num_blocks = answer.Int();
  row.cells = static_cast<std::uint64_t>(answer.Int());
  row.extent = static_cast<std::uint64_t>(answer.Int());
  row.blob = answer.Blob();
  return row;
}

template <typename Row>
Status ReadRows(const Table<Row>& table, Answer& answer, std::vector<Row>& rows) {
  while (answer.Next()) {
    if (!ReadRow(table, answer, rows.emplace_back())) return DataLoss("a row of table " + std::string(table.table()));
  }
  return Status::Ok();
}

Result<std::vector<SubmapRow>> SubmapsOf(Answer& answer, const MapRow& map) {
  std::vector<SubmapRow> rows;
  while (answer.Next()) {
    SubmapRow& row = rows.emplace_back();
    if (ReadRow(Submaps(), answer, row) && Submaps().IsIntact(row, row.seal)) continue;
    return DataLoss("submap " + std::to_string(row.info.id.value) + ": its row has a wrong checksum");
  }
  if (static_cast<std::int64_t>(rows.size()) == map.num_submaps) return rows;
  return DataLoss("has " + std::to_string(rows.size()) + " submaps, not " + std::to_string(map.num_submaps));
}

/// Makes a map of its rows, which come by owner: those of the map itself first.
class StateMaker {
 public:
  StateMaker(const std::vector<SubmapRow>& rows, std::uint16_t store, ThreadPool& pool)
      : rows_(rows), maker_(store, pool) {}

  Status Add(Answer& answer) {
    const std::int64_t owner = answer.Int();
    if (owner == kMapsOwner) return layers_.Add(TileOf(answer));
    DHPMAP_RETURN_IF_ERROR(GoTo(owner));
    const bool has_row = next_ < rows_.size() && std::int64_t{rows_[next_].info.id.value} == owner;
    return has_row ? maker_.Add(TileOf(answer)) : DataLoss("has tiles of submap " + std::to_string(owner) + " alone");
  }
  Status Finish() {
    DHPMAP_RETURN_IF_ERROR(GoTo(std::numeric_limits<std::int64_t>::max()));
    return Status::Ok();
  }
  Result<MapLayers> Layers(const MapRow& map) { return layers_.Finish(map); }
  std::vector<std::shared_ptr<const Submap>>& submaps() { return submaps_; }

 private:
  /// Finishes the submaps before that one.
  Status GoTo(std::int64_t owner) {
    if (!has_begun_ && next_ < rows_.size()) maker_.Begin(rows_[next_]);
    has_begun_ = true;
    while (next_ < rows_.size() && std::int64_t{rows_[next_].info.id.value} < owner) {
      DHPMAP_ASSIGN_OR_RETURN(auto submap, maker_.Finish());
      submaps_.push_back(std::move(submap));
      if (++next_ < rows_.size()) maker_.Begin(rows_[next_]);
    }
    return Status::Ok();
  }

  const std::vector<SubmapRow>& rows_;
  SubmapMaker maker_;
  MapLayersMaker layers_;
  std::size_t next_ = 0;
  bool has_begun_ = false;
  std::vector<std::shared_ptr<const Submap>> submaps_;
};

std::shared_ptr<const MapSnapshot> StateOf(MapRow& map, std::vector<std::shared_ptr<const Submap>> submaps,
                                           MapLayers layers) {
  return std::make_shared<const MapSnapshot>(std::move(map.info), std::move(submaps), std::move(layers.free_space),
                                             VacatedSpace{std::move(layers.vacated), map.leaving()});
}

Result<std::shared_ptr<const MapSnapshot>> MakeState(Connection& connection, MapRow& map,
                                                     const std::vector<SubmapRow>& rows, std::uint16_t store,
                                                     ThreadPool& pool) {
  StateMaker maker(rows, store, pool);
  Call call{&kAllTiles};
  call.values.Add(map.key);
  DHPMAP_RETURN_IF_ERROR(
      connection.Stream(call, kReadStateTask, [&maker](Answer& row) -> Status { return maker.Add(row); }));
  DHPMAP_RETURN_IF_ERROR(maker.Finish());
  DHPMAP_ASSIGN_OR_RETURN(MapLayers layers, maker.Layers(map));
  return StateOf(map, std::move(maker.submaps()), std::move(layers));
}

/// The same with the tiles of objects left where they are.
Result<std::shared_ptr<const MapSnapshot>> MakePagedState(Connection& connection, MapRow& map,
                                                          const std::vector<SubmapRow>& rows, std::uint16_t store,
                                                          ThreadPool& pool, const std::shared_ptr<PageReader>& pages) {
  MapLayersMaker layers_maker;
  Call call{&kOwnTiles};
  call.values.Add(map.key).Add(kMapsOwner);
  DHPMAP_RETURN_IF_ERROR(connection.Stream(call, kReadStateTask, [&layers_maker](Answer& row) -> Status {
    (void)row.Int();  // the owner
    return layers_maker.Add(TileOf(row));
  }));
  DHPMAP_ASSIGN_OR_RETURN(MapLayers layers, layers_maker.Finish(map));
  const PagedMap paged{pages, map.key, map.info.revision};
  const auto shared = std::make_shared<SharedTiles>();
  SubmapMaker without_tiles(store, pool);
  std::vector<std::shared_ptr<const Submap>> submaps;
  submaps.reserve(rows.size());
  for (const SubmapRow& row : rows) {
    std::shared_ptr<const Submap>& submap = submaps.emplace_back();
    if (HasTiles(row)) {
      auto unread = std::make_shared<PagedSubmap>(paged, store, shared, map.info.name, row);
      DHPMAP_ASSIGN_OR_RETURN(submap, UnreadSubmap(row, std::move(unread)));
    } else {
      without_tiles.Begin(row);
      DHPMAP_ASSIGN_OR_RETURN(submap, without_tiles.Finish());
    }
  }
  return StateOf(map, std::move(submaps), std::move(layers));
}

}  // namespace

Result<OneState> OneState::Begin(Connection& connection) {
  DHPMAP_RETURN_IF_ERROR(connection.Execute("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY", kReadStateTask));
  return OneState(connection);
}

OneState::~OneState() {
  if (connection_ != nullptr && !connection_->IsBroken()) (void)connection_->Execute("COMMIT", kReadStateTask);
}

std::vector<Call> CallsForParts(std::int64_t map_key) {
  static const std::string texts[] = {SelectText(ConfigTable(), "WHERE map_key = $1 ORDER BY key"),
                                      SelectText(Classes(), "WHERE map_key = $1 ORDER BY class_id"),
                                      SelectText(Sessions(), "WHERE map_key = $1 ORDER BY session"),
                                      SelectText(MergedTable(), "WHERE map_key = $1 ORDER BY merged_id"),
                                      SelectText(PairTable(), "WHERE map_key = $1 ORDER BY first_id, second_id"),
                                      SelectText(KeptClearTable(), "WHERE map_key = $1 ORDER BY name")};
  std::vector<Call> calls;
  for (const std::string& text : texts) calls.emplace_back(Call{&text}).values.Add(map_key);
  return calls;
}

Result<MapParts> ReadParts(std::span<Answer> answers) {
  MapParts parts;
  DHPMAP_RETURN_IF_ERROR(ReadRows(ConfigTable(), answers[0], parts.config));
  DHPMAP_RETURN_IF_ERROR(ReadRows(Classes(), answers[1], parts.classes));
  DHPMAP_RETURN_IF_ERROR(ReadRows(Sessions(), answers[2], parts.sessions));
  DHPMAP_RETURN_IF_ERROR(ReadRows(MergedTable(), answers[3], parts.merged));
  DHPMAP_RETURN_IF_ERROR(ReadRows(PairTable(), answers[4], parts.pairs));
  DHPMAP_RETURN_IF_ERROR(ReadRows(KeptClearTable(), answers[5], parts.kept_clear));
  return parts;
}

Result<std::shared_ptr<const MapSnapshot>> ReadMapState(Connection& connection, const std::string& name,
                                                        std::int64_t map_key, std::uint16_t store, ThreadPool& pool,
                                                        const std::shared_ptr<PageReader>& pages) {
  static const std::string submaps = SelectText(Submaps(), "WHERE map_key = $1 ORDER BY submap_id");
  DHPMAP_ASSIGN_OR_RETURN(const OneState one_state, OneState::Begin(connection));
  std::vector<Call> calls = CallsForParts(map_key);
  calls.emplace_back(Call{&HeadByKey()}).values.Add(map_key);
  calls.emplace_back(Call{&submaps}).values.Add(map_key);
  Answers got = connection.Run(calls, kReadStateTask);
  if (!got.status.ok()) return got.status;
  MapHead head;
  if (!got.answers[6].Next()) return NoSuchMap(name);
  if (!ReadHead(got.answers[6], head)) return DamagedRows(name, "its row has a wrong checksum");
  const auto parts = ReadParts(std::span(got.answers).first(6));
  const Status filled = parts.ok() ? FillInfo(head.row, *parts) : parts.status();
  if (filled.code() == StatusCode::kDataLoss) return DamagedRows(name, filled.message());
  DHPMAP_RETURN_IF_ERROR(filled);
  const auto make = [&]() -> Result<std::shared_ptr<const MapSnapshot>> {
    DHPMAP_ASSIGN_OR_RETURN(const std::vector<SubmapRow> rows, SubmapsOf(got.answers[7], head.row));
    return pages == nullptr ? MakeState(connection, head.row, rows, store, pool)
                            : MakePagedState(connection, head.row, rows, store, pool, pages);
  };
  auto state = make();
  const StatusCode code = state.status().code();
  const bool is_damage = code == StatusCode::kDataLoss || code == StatusCode::kFailedPrecondition;
  return is_damage ? DamagedState(name, state.status()) : state;
}

}  // namespace dhpmap::postgres
