// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/map_import.h"

#include <utility>

namespace dhpmap {
namespace {

Status TooLarge(std::int64_t max_bytes) {
  return ResourceExhausted("the file is larger than " + std::to_string(max_bytes >> 20) +
                           " MiB, which is as much as is taken in")
      .WithReason("BODY_TOO_LARGE");
}

Status NotAsAnnounced(std::int64_t num_bytes, std::int64_t announced) {
  return InvalidArgument("the file has " + std::to_string(num_bytes) + " bytes and not " + std::to_string(announced) +
                         ", as was announced")
      .WithReason("BAD_MAP")
      .WithViolation("total_bytes", "is not what has come in");
}

}  // namespace

std::unique_ptr<CountedPlace> CountedPlace::TryTake(std::atomic<int>& count, int max) {
  if (count.fetch_add(1) >= max) {
    --count;
    return nullptr;
  }
  return std::unique_ptr<CountedPlace>(new CountedPlace(count));
}

Result<std::unique_ptr<IncomingMap>> MapRegistry::BeginImport(ImportRequest request) {
  if (request.total_bytes < 0) {
    return InvalidArgument("a file has no size below 0")
        .WithReason("BAD_MAP")
        .WithViolation("total_bytes", "must not be negative");
  }
  if (request.total_bytes > options_.max_import_bytes) return TooLarge(options_.max_import_bytes);
  if (!request.name.empty()) {
    DHPMAP_RETURN_IF_ERROR(ValidateMapName(request.name));
    DHPMAP_RETURN_IF_ERROR(CheckIsFree(request.name));
  }
  auto place = CountedPlace::TryTake(num_imports_, options_.max_imports);
  if (place == nullptr) {
    return ResourceExhausted("as many maps come in as may at once: try again later").WithReason("TOO_BUSY");
  }
  DHPMAP_ASSIGN_OR_RETURN(auto import, store_.ImportMap());
  return std::make_unique<IncomingMap>(*this, std::move(request), options_.max_import_bytes, std::move(place),
                                       std::move(import));
}

IncomingMap::IncomingMap(MapRegistry& registry, ImportRequest request, std::int64_t max_bytes,
                         std::unique_ptr<CountedPlace> place, std::unique_ptr<MapImport> import)
    : registry_(registry),
      request_(std::move(request)),
      max_bytes_(max_bytes),
      place_(std::move(place)),
      import_(std::move(import)) {}

Status IncomingMap::Write(std::string_view piece) {
  num_bytes_ += static_cast<std::int64_t>(piece.size());
  if (num_bytes_ > max_bytes_) return TooLarge(max_bytes_);
  if (request_.total_bytes > 0 && num_bytes_ > request_.total_bytes) {
    return NotAsAnnounced(num_bytes_, request_.total_bytes);
  }
  return import_->Write(piece);
}

Status IncomingMap::Prepare(const std::stop_token& stop) {
  if (request_.total_bytes > 0 && num_bytes_ != request_.total_bytes) {
    return NotAsAnnounced(num_bytes_, request_.total_bytes);
  }
  DHPMAP_ASSIGN_OR_RETURN(name_, import_->LookThrough(stop));
  if (!request_.name.empty()) name_ = request_.name;
  if (request_.check_name) DHPMAP_RETURN_IF_ERROR(request_.check_name(name_));
  DHPMAP_ASSIGN_OR_RETURN(held_, registry_.HoldName(name_));
  return import_->Bring(stop);
}

Result<MapSummary> IncomingMap::Show() {
  DHPMAP_RETURN_IF_ERROR(import_->Add(name_));
  held_.reset();
  return registry_.Get(name_);
}

}  // namespace dhpmap
