// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <utility>

#include "server/auth/map_owners.h"
#include "storage/auth_tables.h"

namespace dhpmap::auth {

/// The owners of all maps in a database that several servers share. A map that one server makes counts at all of them.
/// Nothing is kept in memory; errors are those of AuthTables.
class MapOwnersTable final : public MapOwners {
 public:
  explicit MapOwnersTable(std::shared_ptr<AuthTables> tables) : tables_(std::move(tables)) {}

  Status Add(std::uint64_t history_id, const std::string& principal) override {
    return tables_->AddMapMaker(history_id, principal);
  }
  [[nodiscard]] Result<std::optional<std::string>> OwnerOf(std::uint64_t history_id) const override {
    return tables_->MakerOf(history_id);
  }
  [[nodiscard]] Result<std::set<std::uint64_t>> MapsOf(const std::string& principal) const override {
    DHPMAP_ASSIGN_OR_RETURN(const auto maps, tables_->MapsMadeBy(principal));
    return std::set<std::uint64_t>(maps.begin(), maps.end());
  }
  [[nodiscard]] std::size_t size() const override { return 0; }
  Status Keep(const std::set<std::uint64_t>&) override { return Status::Ok(); }

 private:
  const std::shared_ptr<AuthTables> tables_;
};

}  // namespace dhpmap::auth
