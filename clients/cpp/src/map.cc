// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/map.h"

#include <algorithm>
#include <utility>

#include "clients/cpp/calls/caller.h"
#include "clients/cpp/calls/pages.h"
#include "clients/cpp/src/convert/edits.h"
#include "clients/cpp/src/convert/objects.h"
#include "clients/cpp/src/edit_impl.h"
#include "clients/cpp/src/feed_impl.h"
#include "clients/cpp/src/stream_source.h"
#include "clients/cpp/src/watch_impl.h"

namespace dhpmap::client {
namespace {

/// Builds an UndoEditsRequest or RedoEditsRequest.
template <typename Request>
Request UndoRequest(const Caller& caller, const std::string& map, const UndoOptions& options) {
  Request request;
  request.set_map(map);
  request.set_author(options.author.empty() ? caller.author() : options.author);
  request.set_request_id(NewRequestId());
  if (options.revision != 0) request.set_edit(map + "/edits/" + std::to_string(options.revision));
  else request.set_count(options.count);
  return request;
}

}  // namespace

Map::Map(std::shared_ptr<Caller> caller, std::string resource_name)
    : Queries(MakeCalledSource(caller, resource_name)),
      caller_(std::move(caller)),
      resource_name_(std::move(resource_name)) {}

std::string Map::name() const { return resource_name_.substr(resource_name_.find('/') + 1); }

Result<MapInfo> Map::Info() const {
  v1::GetMapRequest request;
  request.set_name(resource_name_);
  const auto answer = caller_->Call(&v1::MapService::Stub::GetMap, request);
  if (!answer.ok()) return answer.status();
  return FromProto(answer->map());
}

Result<ObjectList> Map::Objects() const {
  v1::ListSubmapsRequest request;
  request.set_parent(resource_name_);
  ObjectList list;
  const auto add = [&list](const v1::ListSubmapsResponse& page) {
    list.revision = list.revision == 0 ? page.revision() : std::min(list.revision, page.revision());
    for (const v1::Submap& submap : page.submaps()) list.objects.push_back(FromProto(submap));
    return true;
  };
  Status status = ForEachPage(*caller_, &v1::SubmapService::Stub::ListSubmaps, request, add);
  if (!status.ok()) return status;
  return list;
}

Result<Object> Map::Get(std::int64_t object) const {
  v1::GetSubmapRequest request;
  request.set_name(SubmapName(resource_name_, object));
  const auto answer = caller_->Call(&v1::SubmapService::Stub::GetSubmap, request);
  if (!answer.ok()) return answer.status();
  return FromProto(answer->submap());
}

Result<Pinned> Map::Pin() const {
  auto source = std::make_shared<StreamSource>(caller_, resource_name_, StreamSource::OldPin::kRenew);
  const Result<std::int64_t> revision = source->Pin(0);
  if (!revision.ok()) return revision.status();
  return Pinned(std::move(source), *revision);
}

Pinned Map::At(std::int64_t revision) const { return {MakeCalledSource(caller_, resource_name_, revision), revision}; }

EventualMap Map::Eventual() const { return EventualMap(MakeEventualSource(caller_, resource_name_)); }

client::Loop Map::Loop() const {
  return client::Loop(std::make_shared<StreamSource>(caller_, resource_name_, StreamSource::OldPin::kRefuse));
}

client::Edit Map::Edit(const EditOptions& options) const {
  return client::Edit(std::make_unique<client::Edit::Impl>(caller_, resource_name_, options));
}

Result<Undone> Map::Undo(const UndoOptions& options) const {
  const auto request = UndoRequest<v1::UndoEditsRequest>(*caller_, resource_name_, options);
  const auto answer = caller_->Call(&v1::EditService::Stub::UndoEdits, request);
  if (!answer.ok()) return answer.status();
  return UndoneOf(*answer);
}

Result<Undone> Map::Redo(const UndoOptions& options) const {
  const auto request = UndoRequest<v1::RedoEditsRequest>(*caller_, resource_name_, options);
  const auto answer = caller_->Call(&v1::EditService::Stub::RedoEdits, request);
  if (!answer.ok()) return answer.status();
  return UndoneOf(*answer);
}

client::Watch Map::Watch(const WatchOptions& options) const {
  return client::Watch(std::make_unique<client::Watch::Impl>(caller_, resource_name_, options));
}

Result<client::Feed> Map::Feed(const FeedOptions& options) const {
  auto opened = client::Feed::Impl::Open(caller_, resource_name_, options);
  if (!opened.ok()) return opened.status();
  return client::Feed(*std::move(opened));
}

Result<std::int64_t> Map::FinishMapping(double deadline_s) const {
  v1::FinishMappingRequest request;
  request.set_map(resource_name_);
  const auto answer = caller_->Call(&v1::MappingService::Stub::FinishMapping, request, deadline_s);
  if (!answer.ok()) return answer.status();
  return answer->revision();
}

}  // namespace dhpmap::client
