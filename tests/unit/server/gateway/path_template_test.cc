// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/path_template.h"

#include <gtest/gtest.h>

namespace dhpmap::gateway {
namespace {

TEST(PathTemplate, ParsesEveryPartOfTheGrammar) {
  const auto path = PathTemplate::Parse("/v1/{name=maps/*/submaps/*}/x/{id}/**:verb");
  ASSERT_TRUE(path.ok());
  EXPECT_EQ(path->Shape(), "/v1/maps/*/submaps/*/x/*/**:verb");
  EXPECT_EQ(path->verb(), "verb");
  ASSERT_EQ(path->variables().size(), 2u);
  EXPECT_EQ(path->variables()[0].field_path, "name");
  EXPECT_FALSE(path->variables()[0].is_one_segment(*path));
  EXPECT_TRUE(path->variables()[1].is_one_segment(*path));
}

TEST(PathTemplate, RefusesTemplatesOutsideTheGrammar) {
  for (const char* text : {"", "v1", "/", "/v1/", "/v1//x", "/{", "/{}", "/{a", "/{a=}", "/{a={b}}", "/**/x",
                           "/a:", "/a:b:c", "/{a=*}}", "/***", "/a*", "/:v"}) {
    EXPECT_FALSE(PathTemplate::Parse(text).ok()) << text;
  }
}

TEST(PathTemplate, MatchesAndDecodesVariables) {
  const auto path = PathTemplate::Parse("/v1/{name=maps/*}/{id}:go");
  EXPECT_EQ(path->Match("/v1/maps/a%20b/c%2Fd:go"), (std::vector<std::string>{"maps/a b", "c/d"}));
  EXPECT_EQ(path->Match("/v1/maps/a%2Fb/c:go"), (std::vector<std::string>{"maps/a%2Fb", "c"}));
  EXPECT_EQ(path->Match("/v1/maps/a/b%3Ac:go"), (std::vector<std::string>{"maps/a", "b:c"}));
  for (const char* other :
       {"/v1/maps/a/b", "/v1/maps/a/b:stop", "/v1/maps/a:go", "/v1/maps/a/b/c:go", "/v1/maps//b:go", "/v1/maps/a/:go",
        "/v1/maps/a/b:", "v1/maps/a/b:go", "/v1/mapsa/b/c:go", "/v1/maps/a/%:go", "", "/", ":go"}) {
    EXPECT_FALSE(path->Match(other)) << other;
  }
}

TEST(PathTemplate, DoubleStarTakesTheRest) {
  const auto path = PathTemplate::Parse("/files/{name=**}");
  EXPECT_EQ(path->Match("/files/a/b/c"), std::vector<std::string>{"a/b/c"});
  EXPECT_FALSE(path->Match("/files/"));
  EXPECT_FALSE(path->Match("/files"));
}

TEST(PathTemplate, TemplatesOfOneShapeMatchTheSamePaths) {
  const auto a = PathTemplate::Parse("/v1/{name=maps/*}:stats");
  const auto b = PathTemplate::Parse("/v1/maps/{id}:stats");
  EXPECT_EQ(a->Shape(), b->Shape());
  for (const char* path : {"/v1/maps/x:stats", "/v1/maps/x", "/v1/maps/:stats", "/v1/maps/x/y:stats"}) {
    EXPECT_EQ(a->Match(path).has_value(), b->Match(path).has_value()) << path;
  }
}

TEST(PathTemplate, ASlashInAValueCannotFakeASegment) {
  const auto path = PathTemplate::Parse("/v1/{name=maps/*/submaps/*}");
  EXPECT_FALSE(path->Match("/v1/maps%2Fa/submaps/1"));
  EXPECT_EQ(path->Match("/v1/maps/a%2Fsubmaps%2F2/submaps/1"),
            (std::vector<std::string>{"maps/a%2Fsubmaps%2F2/submaps/1"}));
}

TEST(PathTemplate, ReportsWhereATemplateIsWrong) {
  const auto path = PathTemplate::Parse("/v1/{a");
  EXPECT_NE(path.status().message().find("at character 7"), std::string::npos) << path.status().message();
  EXPECT_FALSE(PathTemplate::Parse("/v1" + std::string(40, '/')).ok());
  std::string deep;
  for (int i = 0; i < 40; ++i) deep += "/x";
  EXPECT_FALSE(PathTemplate::Parse(deep).ok()) << "more segments than a path may have";
}

}  // namespace
}  // namespace dhpmap::gateway
