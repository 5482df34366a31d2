// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "storage/store.h"

namespace dhpmap::testing {

/// A store that passes every call on to another one. Tests derive from it and override what they are about. It calls
/// Commit for no other call: a class that changes commits overrides CommitEdit, too.
class WrappedStore : public MapStore {
 public:
  /// Around a store of its own.
  explicit WrappedStore(std::unique_ptr<MapStore> store = MakeMemoryStore()) : own_(std::move(store)), inner_(*own_) {}
  /// `store` outlives it.
  explicit WrappedStore(MapStore& store) : inner_(store) {}

  Fleet* fleet() override { return inner_.fleet(); }
  using MapStore::ListMaps;
  Result<std::vector<StoredMap>> ListMaps(const std::string& after, std::size_t max) override {
    return inner_.ListMaps(after, max);
  }
  Result<std::vector<std::string>> ListMapNames(const std::string& after, std::size_t max) override {
    return inner_.ListMapNames(after, max);
  }
  Result<StoredMap> GetMap(const std::string& name) override { return inner_.GetMap(name); }
  Status CreateMap(const MapSnapshot& snapshot) override { return inner_.CreateMap(snapshot); }
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    return inner_.Commit(before, after, durability);
  }
  Result<ChangeList> ListChanges(const std::string& name, std::int64_t after_revision, std::size_t max_bytes) override {
    return inner_.ListChanges(name, after_revision, max_bytes);
  }
  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    return inner_.CommitEdit(before, after, edit);
  }
  Result<std::vector<LoggedEdit>> ListEdits(const std::string& name, const EditQuery& query) override {
    return inner_.ListEdits(name, query);
  }
  Result<std::optional<StoredAnswer>> FindAnswer(const std::string& name, const std::string& request_id) override {
    return inner_.FindAnswer(name, request_id);
  }
  Result<StateDelta> LoadEdit(const std::string& name, std::int64_t revision) override {
    return inner_.LoadEdit(name, revision);
  }
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override { return inner_.LoadMap(name); }
  Result<StateToRead> LoadToRead(const std::string& name) override { return inner_.LoadToRead(name); }
  Result<StateToRead> ReadSince(const StateToRead& before) override { return inner_.ReadSince(before); }
  Status DeleteMap(const std::string& name) override { return inner_.DeleteMap(name); }
  Status Reserve(const std::string& name, const NumberMarks& marks) override { return inner_.Reserve(name, marks); }
  Result<VerifyReport> VerifyMap(const std::string& name, bool repair, const std::stop_token& stop) override {
    return inner_.VerifyMap(name, repair, stop);
  }
  Result<std::unique_ptr<StoreBackup>> Backup(const std::stop_token& stop) override { return inner_.Backup(stop); }
  Result<std::unique_ptr<StoreBackup>> ExportMap(const std::string& name, const std::stop_token& stop) override {
    return inner_.ExportMap(name, stop);
  }
  Result<std::unique_ptr<MapImport>> ImportMap() override { return inner_.ImportMap(); }

 protected:
  MapStore& inner() { return inner_; }

 private:
  const std::unique_ptr<MapStore> own_;  // null: another's
  MapStore& inner_;
};

}  // namespace dhpmap::testing
