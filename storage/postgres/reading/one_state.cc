// SPDX-License-Identifier: BSD-3-Clause
#include "storage/postgres/reading/one_state.h"

#include "mapping/base/guarded.h"

namespace dhpmap::postgres {
namespace {

constexpr char kOneStateTask[] = "read the map";

}  // namespace

Result<OneState> OneState::Begin(Connection& connection) {
  DHPMAP_RETURN_IF_ERROR(connection.Execute("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY", kOneStateTask));
  return OneState(connection);
}

OneState::~OneState() {
  if (connection_ == nullptr || connection_->IsBroken()) return;
  TellSafely([this] { (void)connection_->Execute("COMMIT", kOneStateTask); });
}

}  // namespace dhpmap::postgres
