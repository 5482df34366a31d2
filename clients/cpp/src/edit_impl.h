// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "clients/cpp/calls/caller.h"
#include "dhpmap/edit.h"
#include "dhpmap/v1/edit_service.pb.h"

namespace dhpmap::client {

/// The list of collected edits.
struct Edit::Impl {
  Impl(std::shared_ptr<Caller> through, const std::string& map, const EditOptions& how);

  std::shared_ptr<Caller> caller;
  EditOptions options;
  v1::ApplyEditsRequest request;

  v1::Edit& Add() { return *request.add_edits(); }
  v1::Edit& Add(const Target& object);
  [[nodiscard]] std::string NameOf(const Target& object) const;
  /// The object that the last edit creates.
  [[nodiscard]] NewObject Made() const { return {request.edits_size() - 1}; }
  [[nodiscard]] Result<Edited> Send(const v1::ApplyEditsRequest& edits) const;
};

}  // namespace dhpmap::client
