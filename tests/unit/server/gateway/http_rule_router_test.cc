// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/http_rule_router.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "google/api/annotations.pb.h"
#include "tests/support/places.h"

namespace dhpmap::gateway {
namespace {

using google::protobuf::DescriptorPool;

const HttpRuleRouter& Router() {
  static const auto router = HttpRuleRouter::FromLinkedServices();
  return *router;
}

/// A path that matches the template, and the values of its variables.
std::string SamplePath(const PathTemplate& path) {
  std::string text;
  int number = 0;
  for (const auto& segment : path.segments()) {
    text += '/';
    text += segment.kind == PathTemplate::Kind::kLiteral ? segment.text : "s" + std::to_string(++number);
  }
  return path.verb().empty() ? text : text + ':' + path.verb();
}

TEST(HttpRuleRouter, FindsEveryBindingOfEveryRpc) {
  ASSERT_TRUE(HttpRuleRouter::FromLinkedServices().ok());
  for (const Route& route : Router().routes()) {
    const std::string path = SamplePath(route.path);
    const RouteMatch match = Router().Find(route.http_method, path);
    ASSERT_EQ(match.route, &route) << route.http_method << " " << path;
    ASSERT_EQ(match.values.size(), route.variables.size());
    EXPECT_NE(Router().AllowedMethods(path).find(route.http_method), std::string::npos);
  }
}

TEST(HttpRuleRouter, EveryRpcOfEveryProtoFileHasARoute) {
  std::set<std::string> routed;
  for (const Route& route : Router().routes()) routed.insert(route.method->full_name());
  int num_files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testing::SourceDir() / "proto/dhpmap/v1")) {
    const std::string name = "dhpmap/v1/" + entry.path().filename().string();
    const auto* file = DescriptorPool::generated_pool()->FindFileByName(name);
    ASSERT_NE(file, nullptr) << name << " is not linked in: add it to linked_protos.cc";
    ++num_files;
    for (int i = 0; i < file->service_count(); ++i) {
      for (int k = 0; k < file->service(i)->method_count(); ++k) {
        EXPECT_EQ(routed.count(file->service(i)->method(k)->full_name()), 1u)
            << file->service(i)->method(k)->full_name();
      }
    }
  }
  EXPECT_GE(num_files, 5);
}

TEST(HttpRuleRouter, GivesTheRightPathVariables) {
  const auto match = Router().Find("PATCH", "/v1/maps/home/submaps/12");
  ASSERT_NE(match.route, nullptr);
  EXPECT_EQ(match.route->rpc_path, "/dhpmap.v1.SubmapService/UpdateSubmap");
  EXPECT_EQ(json::ToString(match.route->variables[0]), "submap.name");
  EXPECT_EQ(match.values[0], "maps/home/submaps/12");
  EXPECT_EQ(match.route->body, Route::Body::kField);
  EXPECT_NE(match.route->update_mask, nullptr);
}

TEST(HttpRuleRouter, DistinguishesVerbs) {
  EXPECT_EQ(Router().Find("GET", "/v1/maps/a").route->rpc_path, "/dhpmap.v1.MapService/GetMap");
  EXPECT_EQ(Router().Find("GET", "/v1/maps/a/stats").route->rpc_path, "/dhpmap.v1.MapService/GetMapStats");
  EXPECT_EQ(Router().Find("GET", "/v1/maps/a/mesh").route->rpc_path, "/dhpmap.v1.SubmapService/GetSubmapMesh");
  EXPECT_TRUE(Router().Find("GET", "/v1/maps/a/mesh").route->file);
  EXPECT_EQ(Router().Find("GET", "/v1/maps/a:nothing").route, nullptr);
  EXPECT_EQ(Router().Find("DELETE", "/v1/maps/a:verify").route, nullptr) << "must not delete a map";
  EXPECT_EQ(Router().AllowedMethods("/v1/maps/a/stats"), "GET, HEAD");
  EXPECT_EQ(Router().AllowedMethods("/v1/maps/a"), "DELETE, GET, HEAD, PATCH");
  EXPECT_EQ(Router().AllowedMethods("/v2/maps/a"), "");
}

TEST(HttpRuleRouter, HeadFindsGet) {
  EXPECT_EQ(Router().Find("HEAD", "/v1/maps").route, Router().Find("GET", "/v1/maps").route);
}

/// A service of one RPC a rule, with Submap updates as requests, so that rules other than ours can be tried.
class OwnService {
 public:
  explicit OwnService(const std::vector<google::api::HttpRule>& rules) : pool_(DescriptorPool::generated_pool()) {
    google::protobuf::FileDescriptorProto file;
    file.set_name("own.proto");
    file.set_package("own");
    file.add_dependency("dhpmap/v1/submap_service.proto");
    auto* service = file.add_service();
    service->set_name("Own");
    for (const auto& rule : rules) {
      auto* method = service->add_method();
      method->set_name("M" + std::to_string(service->method_size()));
      method->set_input_type(".dhpmap.v1.UpdateSubmapRequest");
      method->set_output_type(".dhpmap.v1.UpdateSubmapResponse");
      *method->mutable_options()->MutableExtension(google::api::http) = rule;
    }
    file_ = pool_.BuildFile(file);
  }

  [[nodiscard]] Result<HttpRuleRouter> Route() const { return HttpRuleRouter::FromServices({file_->service(0)}); }

 private:
  DescriptorPool pool_;
  const google::protobuf::FileDescriptor* file_;
};

google::api::HttpRule Get(const std::string& path) {
  google::api::HttpRule rule;
  rule.set_get(path);
  return rule;
}

TEST(HttpRuleRouter, RefusesTwoRulesThatMatchTheSame) {
  const OwnService service({Get("/v1/{submap.name=a/*}"), Get("/v1/a/{submap.etag}")});
  const auto router = service.Route();
  ASSERT_FALSE(router.ok());
  EXPECT_NE(router.status().message().find("own.Own.M2"), std::string::npos) << router.status().message();
}

TEST(HttpRuleRouter, PrefersTheMoreSpecificRule) {
  const OwnService service({Get("/v1/{submap.name=**}"), Get("/v1/a/{submap.name}"), Get("/v1/a/b"), Get("/v1/*/b")});
  const auto router = service.Route();
  ASSERT_TRUE(router.ok()) << router.status().message();
  EXPECT_EQ(router->Find("GET", "/v1/a/b").route->method->name(), "M3");
  EXPECT_EQ(router->Find("GET", "/v1/a/c").route->method->name(), "M2");
  EXPECT_EQ(router->Find("GET", "/v1/c/b").route->method->name(), "M4");
  EXPECT_EQ(router->Find("GET", "/v1/x/y/z").route->method->name(), "M1");
  EXPECT_EQ(router->Find("GET", "/v1/x/y/z").values, std::vector<std::string>{"x/y/z"});
}

TEST(HttpRuleRouter, RefusesRulesWithUnknownFields) {
  google::api::HttpRule bad_body = Get("/v1/x");
  bad_body.set_body("nothing");
  google::api::HttpRule bad_answer = Get("/v1/x");
  bad_answer.set_response_body("nothing");
  for (const auto& rule : {Get("/v1/{nothing}"), Get("/v1/{submap}"), Get("/v1/{submap.name.x}"), Get("no-slash"),
                           Get("/v1/{submap.name"), google::api::HttpRule(), bad_body, bad_answer}) {
    const OwnService service({rule});
    const auto router = service.Route();
    EXPECT_FALSE(router.ok()) << rule.ShortDebugString();
  }
}

TEST(HttpRuleRouter, KnowsPutCustomAndAdditionalBindings) {
  google::api::HttpRule rule;
  rule.set_put("/v1/{submap.name=a/*}");
  rule.set_body("submap");
  rule.set_response_body("submap");
  auto* custom = rule.add_additional_bindings()->mutable_custom();
  custom->set_kind("PURGE");
  custom->set_path("/v1/{submap.name=a/*}");
  const OwnService service({rule});
  const auto router = service.Route();
  ASSERT_TRUE(router.ok()) << router.status().message();
  EXPECT_EQ(router->Find("PUT", "/v1/a/1").route->response_field->name(), "submap");
  EXPECT_NE(router->Find("PURGE", "/v1/a/1").route, nullptr);
  EXPECT_EQ(router->AllowedMethods("/v1/a/1"), "PURGE, PUT");
}

}  // namespace
}  // namespace dhpmap::gateway
