// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/auth/maker_rows.h"

namespace dhpmap::postgres {
namespace {

constexpr char kWriteMakerTask[] = "store who has made a map";
constexpr char kReadMakerTask[] = "read who has made a map";
const std::string kAddMaker =
    "INSERT INTO map_makers (history_id, principal) VALUES ($1, $2) ON CONFLICT (history_id) DO UPDATE SET principal = "
    "excluded.principal";
const std::string kMakerOf = "SELECT principal FROM map_makers WHERE history_id = $1";
const std::string kMadeBy =
    "SELECT history_id FROM map_makers m WHERE principal = $1 AND EXISTS (SELECT 1 FROM maps WHERE maps.history_id = "
    "m.history_id)";
const std::string kForgetMakers =
    "DELETE FROM map_makers m WHERE NOT EXISTS (SELECT 1 FROM maps WHERE maps.history_id = m.history_id)";

}  // namespace

Status WriteMapMaker(Connection& connection, std::uint64_t history_id, const std::string& principal) {
  Call call{&kAddMaker};
  call.values.Add(history_id).Add(principal);
  return connection.Query(call, kWriteMakerTask).status();
}

Result<std::optional<std::string>> ReadMakerOf(Connection& connection, std::uint64_t history_id) {
  Call call{&kMakerOf};
  call.values.Add(history_id);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadMakerTask));
  return answer.Next() ? std::optional(answer.Text()) : std::nullopt;
}

Result<std::vector<std::uint64_t>> ReadMapsMadeBy(Connection& connection, const std::string& principal) {
  Call call{&kMadeBy};
  call.values.Add(principal);
  DHPMAP_ASSIGN_OR_RETURN(Answer answer, connection.Query(call, kReadMakerTask));
  std::vector<std::uint64_t> maps;
  while (answer.Next()) maps.push_back(static_cast<std::uint64_t>(answer.Int()));
  return maps;
}

Status ForgetMakersOfGoneMaps(Connection& connection) {
  return connection.Query(Call{&kForgetMakers}, kWriteMakerTask).status();
}

}  // namespace dhpmap::postgres
