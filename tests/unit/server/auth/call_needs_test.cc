// SPDX-License-Identifier: BSD-3-Clause
// Every rpc says who may call it; who that is shows in permissions.txt, so that a change of it is seen in review. Made
// anew by WRITE_PERMISSIONS=1 unit_server_auth_test --gtest_filter=CallTable.*
#include "server/auth/call_needs.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/permission.pb.h"
#include "server/auth/rights.h"
#include "tests/support/places.h"

namespace dhpmap::auth {
namespace {

using google::protobuf::FileDescriptorProto;

std::string MapsOf(const CallNeeds& needs) {
  std::string text;
  for (const auto& [meaning, path] : needs.fields) {
    if (meaning != v1::Access::MAP && meaning != v1::Access::MAP_ID) continue;
    text += text.empty() ? "" : ",";
    for (std::size_t i = 0; i < path.size(); ++i) text += (i > 0 ? "." : "") + path[i]->name();
  }
  return text.empty() ? v1::Access::Maps_Name(needs.maps) : text;
}

std::string_view RightOf(Role role, const CallNeeds& needs) {
  if (needs.is_public) return "all";
  CallNeeds for_good = needs;
  for_good.can_only_try = false;
  if (RoleHas(role, for_good)) return "yes";
  return RoleHas(role, needs) ? "try" : "no";
}

std::string Table(const CallTable& table) {
  std::ostringstream text;
  text << "# rpc: what it needs; viewer, editor, robot, admin (yes, no, try: with validate_only); the maps it is "
          "about\n";
  for (const auto& [path, needs] : table.calls()) {
    text << path << ": " << v1::Access::Need_Name(needs.need);
    for (const Role role : kRoles) text << ' ' << RightOf(role, needs);
    text << ' ' << MapsOf(needs) << '\n';
  }
  return text.str();
}

TEST(CallTable, EqualsTheReviewedTable) {
  const std::filesystem::path file = dhpmap::testing::SourceDir() / "tests/unit/server/auth/permissions.txt";
  const auto table = CallTable::OfLinkedServices();
  ASSERT_TRUE(table.ok()) << table.status().ToString();
  if (std::getenv("WRITE_PERMISSIONS") != nullptr) std::ofstream(file) << Table(*table);
  std::ifstream golden(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(golden), {}), Table(*table));
}

TEST(CallTable, HasEveryRpcOfThePackage) {
  const auto table = CallTable::OfLinkedServices();
  ASSERT_TRUE(table.ok());
  int num_rpcs = 0;
  // Reads the sources, so that an unlinked file is found, too.
  for (const auto& entry : std::filesystem::directory_iterator(dhpmap::testing::SourceDir() / "proto/dhpmap/v1")) {
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) num_rpcs += line.starts_with("  rpc ") ? 1 : 0;
  }
  constexpr int kOfGrpc = 4;
  EXPECT_EQ(table->calls().size(), static_cast<std::size_t>(num_rpcs + kOfGrpc));
}

/// A service with one rpc and the given options.
class OneRpc {
 public:
  OneRpc(Need need, v1::Access::Maps maps, Meaning meaning, bool is_text = true) {
    FileDescriptorProto file;
    file.set_name("one.proto");
    file.set_package("one");
    auto* request = file.add_message_type();
    request->set_name("R");
    auto* field = request->add_field();
    field->set_name("f");
    field->set_number(1);
    field->set_type(is_text ? google::protobuf::FieldDescriptorProto::TYPE_STRING
                            : google::protobuf::FieldDescriptorProto::TYPE_INT32);
    field->set_label(google::protobuf::FieldDescriptorProto::LABEL_OPTIONAL);
    if (meaning != 0) field->mutable_options()->SetExtension(v1::means, meaning);
    auto* service = file.add_service();
    service->set_name("S");
    auto* rpc = service->add_method();
    rpc->set_name("Call");
    rpc->set_input_type(".one.R");
    rpc->set_output_type(".one.R");
    if (need != 0) rpc->mutable_options()->SetExtension(v1::needs, need);
    if (maps != 0) rpc->mutable_options()->SetExtension(v1::maps, maps);
    service_ = pool_.BuildFile(file)->service(0);
  }
  [[nodiscard]] Status Check() const { return CallTable::Make({service_}).status(); }

 private:
  google::protobuf::DescriptorPool pool_{google::protobuf::DescriptorPool::generated_pool()};
  const google::protobuf::ServiceDescriptor* service_;
};

TEST(CallTable, AnRpcWithoutNeedsIsRefused) {
  using A = v1::Access;
  EXPECT_TRUE(OneRpc(A::READ, A::MAPS_UNSPECIFIED, A::MAP).Check().ok());
  EXPECT_TRUE(OneRpc(A::READ, A::NONE, A::MEANING_UNSPECIFIED).Check().ok());
  const Status no_need = OneRpc(A::NEED_UNSPECIFIED, A::MAPS_UNSPECIFIED, A::MAP).Check();
  EXPECT_EQ(no_need.code(), StatusCode::kFailedPrecondition);
  ASSERT_EQ(no_need.violations().size(), 1u);
  EXPECT_EQ(no_need.violations()[0].field, "/one.S/Call");
  EXPECT_FALSE(OneRpc(A::READ, A::MAPS_UNSPECIFIED, A::MEANING_UNSPECIFIED).Check().ok()) << "which map?";
  EXPECT_FALSE(OneRpc(A::READ, A::MAPS_UNSPECIFIED, A::AUTHOR).Check().ok()) << "which map?";
  EXPECT_FALSE(OneRpc(A::READ, A::MAPS_UNSPECIFIED, A::MAP, false).Check().ok()) << "a number names no map";
}

}  // namespace
}  // namespace dhpmap::auth
