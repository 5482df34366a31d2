// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/linked_protos.h"

#include <google/protobuf/message.h>

#include "dhpmap/v1/auth_service.pb.h"
#include "dhpmap/v1/edit_service.pb.h"
#include "dhpmap/v1/errors.pb.h"
#include "dhpmap/v1/fleet_service.pb.h"
#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/mapping_service.pb.h"
#include "dhpmap/v1/query_service.pb.h"
#include "dhpmap/v1/server_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "dhpmap/v1/watch_service.pb.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace dhpmap::gateway {

void LinkProtos() {
  google::protobuf::LinkMessageReflection<v1::Map>();
  google::protobuf::LinkMessageReflection<v1::GetMapRequest>();
  google::protobuf::LinkMessageReflection<v1::IntegrateFramesRequest>();
  google::protobuf::LinkMessageReflection<v1::QueryPointsRequest>();
  google::protobuf::LinkMessageReflection<v1::GetSubmapRequest>();
  google::protobuf::LinkMessageReflection<v1::ApplyEditsRequest>();
  google::protobuf::LinkMessageReflection<v1::WatchMapRequest>();
  google::protobuf::LinkMessageReflection<v1::WhoAmIRequest>();
  google::protobuf::LinkMessageReflection<v1::GetServerStatusRequest>();
  google::protobuf::LinkMessageReflection<v1::GetFleetRequest>();
  google::protobuf::LinkMessageReflection<v1::Error>();
  google::protobuf::LinkMessageReflection<google::rpc::ErrorInfo>();
  google::protobuf::LinkMessageReflection<google::rpc::Status>();
}

}  // namespace dhpmap::gateway
