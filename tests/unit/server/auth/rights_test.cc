// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/rights.h"

#include <gtest/gtest.h>

#include <string>

#include "dhpmap/v1/edit_service.pb.h"
#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/mapping_service.pb.h"
#include "dhpmap/v1/query_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"

namespace dhpmap::auth {
namespace {

const CallNeeds& Needs(const std::string& method) {
  static const auto table = CallTable::OfLinkedServices();
  return *table->Find("/dhpmap.v1." + method);
}

Principal Anna(Role role, std::vector<std::string> maps = {"*"}) {
  return {.name = "anna",
          .key_id = "0",
          .role = role,
          .maps = NamePatterns::Make(std::move(maps)).value(),
          .sessions = NamePatterns::Make({"anna", "anna-*"}).value()};
}

Reason Asked(const Principal& principal, const std::string& method, google::protobuf::Message&& request) {
  return CheckRequest(principal, Needs(method), request).reason();
}

template <typename Request>
Request Of(const char* map, bool only_tries = false) {
  Request request;
  request.set_map(map);
  if constexpr (requires { request.set_validate_only(true); }) request.set_validate_only(only_tries);
  return request;
}

TEST(Rights, AViewerMayTryAnEditButNotMakeIt) {
  const Principal viewer = Anna(Role::kViewer), editor = Anna(Role::kEditor);
  EXPECT_TRUE(CheckRole(viewer, Needs("EditService/ApplyEdits")).ok()) << "it may only try: the message tells";
  EXPECT_EQ(Asked(viewer, "EditService/ApplyEdits", Of<v1::ApplyEditsRequest>("maps/a", true)), Reason());
  EXPECT_EQ(Asked(viewer, "EditService/ApplyEdits", Of<v1::ApplyEditsRequest>("maps/a")), Reason("ROLE_NOT_ALLOWED"));
  EXPECT_EQ(Asked(editor, "EditService/ApplyEdits", Of<v1::ApplyEditsRequest>("maps/a")), Reason());
  EXPECT_EQ(CheckRole(editor, Needs("MapService/DeleteMap")).reason(), Reason("ROLE_NOT_ALLOWED"));
  EXPECT_EQ(CheckRole(Anna(Role::kRobot), Needs("MapService/CreateMap")).reason(), Reason());
}

TEST(Rights, TheMapOfARequestIsFoundInAnyField) {
  const Principal narrow = Anna(Role::kAdmin, {"site-*"});
  const auto asked = [&](const char* method, google::protobuf::Message&& request) {
    return CheckRequest(narrow, Needs(method), request).reason();
  };
  for (const bool is_in : {true, false}) {
    const Reason expected = is_in ? Reason() : Reason("MAP_NOT_ALLOWED");
    const std::string id = is_in ? "site-a" : "home", name = "maps/" + id;
    v1::CreateMapRequest create;
    create.set_map_id(id);
    EXPECT_EQ(asked("MapService/CreateMap", std::move(create)), expected);
    v1::UpdateMapRequest update;
    update.mutable_map()->set_name(name);
    EXPECT_EQ(asked("MapService/UpdateMap", std::move(update)), expected) << "in the map that is to be";
    v1::GetSubmapRequest submap;
    submap.set_name(name + "/submaps/3");
    EXPECT_EQ(asked("SubmapService/GetSubmap", std::move(submap)), expected);
    v1::StreamQueriesRequest query;
    query.mutable_query_relations()->set_map(name);
    EXPECT_EQ(asked("QueryService/StreamQueries", std::move(query)), expected) << "in the query of a message";
    v1::StreamQueriesRequest pin;
    pin.mutable_pin()->set_map(name);
    EXPECT_EQ(asked("QueryService/StreamQueries", std::move(pin)), expected);
  }
}

TEST(Rights, AnInvalidMapNameNeedsAKeyForAllMaps) {
  for (const char* name :
       {"site-a", "maps", "maps/", "maps//site-a", "/maps/site-a", "maps/../site-a", "MAPS/site-a"}) {
    EXPECT_EQ(Asked(Anna(Role::kViewer, {"site-*"}), "QueryService/QueryPoints", Of<v1::QueryPointsRequest>(name)),
              Reason("MAP_NOT_ALLOWED"))
        << name;
    EXPECT_EQ(Asked(Anna(Role::kViewer), "QueryService/QueryPoints", Of<v1::QueryPointsRequest>(name)), Reason())
        << name;
  }
}

TEST(Rights, AMissingAndAForbiddenMapLookTheSame) {
  const Principal narrow = Anna(Role::kViewer, {"a"});
  EXPECT_EQ(CheckMap(narrow, "there").ToString(), CheckMap(narrow, "nowhere").ToString());
}

TEST(Rights, CallsAboutAllMapsNeedAKeyForAllMaps) {
  EXPECT_TRUE(CheckRole(Anna(Role::kAdmin), Needs("MapService/BackupMaps")).ok());
  EXPECT_EQ(CheckRole(Anna(Role::kAdmin, {"*", "!secret"}), Needs("MapService/BackupMaps")).reason(),
            Reason("MAP_NOT_ALLOWED"));
  EXPECT_TRUE(CheckRole(Anna(Role::kViewer, {"a"}), Needs("MapService/ListMaps")).ok()) << "which leaves others out";
}

TEST(Rights, TheAuthorIsTheCaller) {
  const Principal editor = Anna(Role::kEditor);
  v1::ApplyEditsRequest request = Of<v1::ApplyEditsRequest>("maps/a");
  EXPECT_TRUE(CheckRequest(editor, Needs("EditService/ApplyEdits"), request).ok());
  EXPECT_EQ(request.author(), "anna") << "filled in";
  for (const char* own : {"anna", "anna/laptop", "anna/"}) {
    request.set_author(own);
    EXPECT_TRUE(CheckRequest(editor, Needs("EditService/ApplyEdits"), request).ok()) << own;
    EXPECT_EQ(request.author(), own);
  }
  for (const char* foreign : {"bert", "annabel", "ann", "Anna", " anna", "/anna"}) {
    request.set_author(foreign);
    EXPECT_EQ(CheckRequest(editor, Needs("EditService/ApplyEdits"), request).reason(), Reason("NOT_YOUR_NAME"))
        << foreign;
    EXPECT_TRUE(CheckRequest(Anna(Role::kAdmin), Needs("EditService/ApplyEdits"), request).ok()) << "for replays";
  }
  v1::ListEditsRequest list;
  list.set_parent("maps/a");
  list.set_author("bert");
  EXPECT_EQ(Asked(editor, "EditService/ListEdits", std::move(list)), Reason()) << "a filter claims nothing";
}

TEST(Rights, ASessionBelongsToItsRobot) {
  const auto feeds = [](const char* session, bool takes_over = false) {
    v1::IntegrateFramesRequest request;
    request.set_map("maps/a");
    request.set_session(session);
    request.set_take_over(takes_over);
    return Asked(Anna(Role::kRobot), "MappingService/IntegrateFrames", std::move(request));
  };
  EXPECT_EQ(feeds("anna"), Reason());
  EXPECT_EQ(feeds("anna-2"), Reason());
  EXPECT_EQ(feeds("bert"), Reason("NOT_YOUR_SESSION"));
  EXPECT_EQ(feeds(""), Reason()) << "as nobody in particular, if nobody else feeds";
  EXPECT_EQ(feeds("", true), Reason("NOT_YOUR_SESSION")) << "in place of whoever that is";
  for (const char* session : {"", "bert"}) {
    v1::EndSessionRequest end = Of<v1::EndSessionRequest>("maps/a");
    end.set_session(session);
    EXPECT_EQ(Asked(Anna(Role::kRobot), "MappingService/EndSession", std::move(end)), Reason("NOT_YOUR_SESSION"));
  }
}

}  // namespace
}  // namespace dhpmap::auth
