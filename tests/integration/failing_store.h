// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "storage/store.h"

namespace dhpmap::testing {

/// A memory store whose disk can be full for a while. Thread-safe.
class FailingStore final : public MapStore {
 public:
  void set_full(bool is_full) { is_full_ = is_full; }
  [[nodiscard]] int num_refused() const { return num_refused_; }

  Result<std::vector<StoredMap>> ListMaps() override { return store_->ListMaps(); }
  Result<StoredMap> GetMap(const std::string& name) override { return store_->GetMap(name); }
  Status CreateMap(const MapSnapshot& snapshot) override { return is_full_ ? Full() : store_->CreateMap(snapshot); }
  Status Commit(const MapSnapshot& before, const MapSnapshot& after, Durability durability) override {
    return is_full_ ? Full() : store_->Commit(before, after, durability);
  }
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override { return store_->LoadMap(name); }
  Status DeleteMap(const std::string& name) override { return is_full_ ? Full() : store_->DeleteMap(name); }

 private:
  Status Full() {
    ++num_refused_;
    return ResourceExhausted("the disk is full").WithReason("DISK_FULL");
  }

  std::unique_ptr<MapStore> store_ = MakeMemoryStore();
  std::atomic<bool> is_full_ = false;
  std::atomic<int> num_refused_ = 0;
};

}  // namespace dhpmap::testing
