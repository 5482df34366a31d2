// SPDX-License-Identifier: BSD-3-Clause
#include "storage/history/logged_edit.h"

#include "storage/codec/edit_codec.h"

namespace dhpmap {
namespace {

Status DamagedLog(const std::string& map, std::int64_t revision) {
  return DataLoss("map '" + map + "': revision " + std::to_string(revision) + " of the log of its edits is damaged")
      .WithReason("DAMAGED_EDITS");
}

}  // namespace

bool IsBeyond(const EditLogLimits& limits, std::int64_t num_edits, std::int64_t num_bytes, std::int64_t oldest_ns,
              std::int64_t now_ns) {
  return num_edits > limits.max_edits || num_bytes > limits.max_bytes ||
         static_cast<double>(now_ns - oldest_ns) > limits.max_age_s * 1e9;
}

std::int64_t LogBytesOf(const EditRecord& edit, std::size_t summary_bytes) {
  constexpr std::size_t kRowBytes = 64;
  const EditSource& source = edit.entry.source;
  return static_cast<std::int64_t>(kRowBytes + source.author.size() + source.request_id.size() + summary_bytes +
                                   edit.answer.size());
}

EditRow EditRowOf(std::int64_t map_key, const EditRecord& edit, std::int64_t now_ns) {
  const EditEntry& entry = edit.entry;
  EditRow row{.map_key = map_key,
              .revision = entry.revision,
              .time_ns = entry.time_ns,
              .kind = entry.summary.kind,
              .source = entry.source,
              .summary = {EncodeEditSummary(entry)},
              .answer = {Bytes(edit.answer.begin(), edit.answer.end())},
              .seen_ns = now_ns,
              .seal = {}};
  row.seal = Edits().SealOf(row);
  return row;
}

Status CheckEdit(bool is_read, const EditRow& row, const std::string& map) {
  return is_read && Edits().IsIntact(row, row.seal) ? Status::Ok() : DamagedLog(map, row.revision);
}

Result<LoggedEdit> LoggedEditOf(const EditRow& row, const std::string& map) {
  LoggedEdit edit{.entry = {.revision = row.revision, .time_ns = row.time_ns, .source = row.source, .summary = {}}};
  edit.entry.summary.kind = row.kind;
  if (!DecodeEditSummary(row.summary.bytes, edit.entry).ok()) return DamagedLog(map, row.revision);
  return edit;
}

StoredAnswer AnswerOf(const EditRow& row) {
  return {.revision = row.revision,
          .request_fingerprint = row.source.request_fingerprint,
          .answer = std::string(row.answer.bytes.begin(), row.answer.bytes.end())};
}

}  // namespace dhpmap
