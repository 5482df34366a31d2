// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "server/config/command_line.h"
#include "server/config/config_loader.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

std::set<std::string> Fields(const Status& status) {
  std::set<std::string> fields;
  for (const FieldViolation& violation : status.violations()) fields.insert(violation.field);
  return fields;
}

std::string WriteFile(const testing::TempDir& dir, const std::string& text) {
  const std::string path = (dir.path() / "config.yaml").string();
  std::ofstream(path) << text;
  return path;
}

TEST(ServerConfig, DefaultsAreValid) { EXPECT_TRUE(ServerConfig{}.Validate().ok()); }

TEST(ServerConfig, EveryBadKeyIsNamedAtOnce) {
  ServerConfig config;
  config.grpc.address = "localhost";
  config.http.address = "0.0.0.0:80";
  config.log.level = "loud";
  config.mapping.publish_frames = 0;
  config.store.commit_s = -1;
  config.map_defaults.voxel_size_m = 0;
  EXPECT_EQ(Fields(config.Validate()),
            (std::set<std::string>{"grpc.address", "http.address", "log.level", "mapping.publish_frames",
                                   "store.commit_s", "map_defaults.voxel_size_m"}));
}

TEST(ServerConfig, OriginsHaveTheFormThatBrowsersSend) {
  ServerConfig config;
  for (const char* origins : {"", "https://fleet.example", "http://localhost:3000, https://a-b.example:8443",
                              "http://[::1]:3000", "http://127.0.0.1:8081"}) {
    config.http.allowed_origins = origins;
    EXPECT_TRUE(config.Validate().ok()) << origins;
  }
  for (const char* origins : {"*", "null", "fleet.example", "https://fleet.example/", "https://*.example",
                              "https://Fleet.example", "https://fleet.example:443", "http://fleet.example:80",
                              "https://fleet.example:", "ftp://fleet.example", "https://a.example,b.example"}) {
    config.http.allowed_origins = origins;
    EXPECT_EQ(Fields(config.Validate()), std::set<std::string>{"http.allowed_origins"}) << origins;
  }
}

TEST(ServerConfig, OtherMachinesAreAdmittedOnlyIfConfigured) {
  ServerConfig config;
  for (const char* address : {"127.0.0.1:0", "localhost:1", "[::1]:65535", "127.1.2.3:50051"}) {
    config.grpc.address = address;
    EXPECT_TRUE(config.Validate().ok()) << address;
  }
  for (const char* address : {"0.0.0.0:1", "[::]:1", "192.168.1.1:1", "127.evil.org:1", "localhost.evil.org:1"}) {
    config.grpc.address = address;
    config.insecure = false;
    EXPECT_FALSE(config.Validate().ok()) << address;
    config.insecure = true;
    EXPECT_TRUE(config.Validate().ok()) << address;
  }
  for (const char* address : {"", "127.0.0.1", ":1", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:x"}) {
    config.grpc.address = address;
    EXPECT_FALSE(config.Validate().ok()) << address;
  }
}

TEST(ServerConfig, KeysOfADatabaseServerAreLookedForOnceItIsAsked) {
  ServerConfig config;
  config.grpc.address = "0.0.0.0:1";
  config.db = "postgresql://dhpmap@db/maps";
  EXPECT_EQ(Fields(config.Validate()), std::set<std::string>{"grpc.address"}) << "TLS is missing anyway";
  config.insecure_no_tls = true;
  EXPECT_TRUE(config.Validate().ok());
  EXPECT_TRUE(CheckExposure(config, /*has_tls=*/false, /*has_keys=*/true).ok());
  EXPECT_FALSE(CheckExposure(config, /*has_tls=*/false, /*has_keys=*/false).ok());
  config.db = "maps.db";
  EXPECT_FALSE(config.Validate().ok());
}

TEST(ConfigLoader, APrintedConfigLoadsUnchanged) {
  ServerConfig config;
  config.db = "a \"quoted\" file: #1.db";
  config.grpc.num_threads = 7;
  config.store.commit_s = 0.1;
  config.insecure = true;
  config.map_defaults = OutdoorLidarConfig();
  const std::string text = ToYaml(config);
  const auto values = ParseYaml(text);
  ASSERT_TRUE(values.ok()) << values.status().ToString();
  ServerConfig loaded;
  ASSERT_TRUE(ApplyKeyValues(*values, "a test", loaded).ok());
  EXPECT_EQ(ToYaml(loaded), text);
  EXPECT_EQ(loaded.db, config.db);
  EXPECT_EQ(loaded.map_defaults.truncation_m, 0.6);
}

TEST(ConfigLoader, TheShippedFileListsEveryKeyWithItsDefault) {
  const auto text = ReadConfigFile((testing::SourceDir() / "deploy/dhpmap.yaml").string());
  ASSERT_TRUE(text.ok());
  const auto shipped = ParseYaml(*text);
  const auto defaults = ParseYaml(ToYaml(ServerConfig{}));
  ASSERT_TRUE(shipped.ok()) << shipped.status().ToString();
  EXPECT_EQ(*shipped, *defaults);
  EXPECT_NE(text->find(ToYaml(ServerConfig{})), std::string::npos) << "the comments differ from --print-config";
}

TEST(ConfigLoader, EveryKeyIsExplainedInOneShortLine) {
  int num_keys = 0;
  const auto look = [&](const char* key, auto&, double, double, const std::string& help) {
    ++num_keys;
    EXPECT_FALSE(help.empty()) << key;
    EXPECT_LE(help.size(), 100u) << key << ": " << help;
  };
  ServerConfig config;
  VisitServerFields(config, look);
  VisitFields(config.map_defaults, look);
  EXPECT_GT(num_keys, 80);
}

TEST(ConfigLoader, UnknownKeysAndBadValuesAreNamedTogether) {
  const auto values = ParseYaml(
      "db: x.db\ngrpc: {adress: a, num_threads: many}\nmap_defaults:\n  voxel_size_m: small\n  voxel: 1\nnope: 3\n"
      "insecure: maybe\n");
  ASSERT_TRUE(values.ok());
  ServerConfig config;
  const Status status = ApplyKeyValues(*values, "a test", config);
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(Fields(status), (std::set<std::string>{"grpc.adress", "grpc.num_threads", "map_defaults.voxel_size_m",
                                                   "map_defaults.voxel", "nope", "insecure"}));
}

TEST(ConfigLoader, KeysOfVersion01NameTheirSuccessors) {
  const auto values = ParseYaml("http: {head_timeout_s: 3}\nstore: {busy_timeout_ms: 70}\n");
  ASSERT_TRUE(values.ok());
  ServerConfig config;
  const Status status = ApplyKeyValues(*values, "a test", config);
  ASSERT_EQ(status.violations().size(), 2u);
  for (const FieldViolation& violation : status.violations()) {
    const bool is_http = violation.field.starts_with("http");
    EXPECT_EQ(violation.description,
              is_http ? "is now called http.header_timeout_s" : "is now called store.busy_timeout_s, in seconds");
  }
}

TEST(ConfigLoader, ARetiredMapKeyMayStayAtItsDefault) {
  const std::string retired = "map_defaults.tracking.weigh_scores";
  const KeyValues in_environment = KeysFromEnvironment({EnvironmentName(retired) + "=false"});
  EXPECT_EQ(in_environment, (KeyValues{{retired, "false"}}));
  ServerConfig config;
  EXPECT_TRUE(ApplyKeyValues(in_environment, "a test", config).ok());
  const auto values = ParseYaml("map_defaults: {tracking: {weigh_scores: true}}\n");
  ASSERT_TRUE(values.ok());
  EXPECT_EQ(Fields(ApplyKeyValues(*values, "a test", config)), std::set<std::string>{retired});
}

TEST(ConfigLoader, AFileThatIsNoMappingIsRefused) {
  EXPECT_FALSE(ParseYaml("- a\n- b\n").ok());
  EXPECT_FALSE(ParseYaml("a: [1, 2]\n").ok());
  EXPECT_FALSE(ParseYaml("a: {b\n").ok());
  EXPECT_FALSE(ParseYaml("just text").ok());
  EXPECT_TRUE(ParseYaml("").ok());
  EXPECT_TRUE(ParseYaml("# nothing\ngrpc:\n").ok());
}

TEST(ConfigLoader, AmbiguousOrUnterminatedYamlIsRefusedWithItsLine) {
  const struct {
    const char* text;
    const char* message;
  } cases[] = {
      {"db: x\nstore: &s\n  commit_s: 1\n  more: *s\n", "line 4: 'store.more' is an alias of what it is in"},
      {"&all\ndb: x\nmore: *all\n", "line 3: 'more' is an alias of what it is in"},
      {"db: x\n\ndb: y\n", "line 3: 'db' is in line 1 already"},
      {"store:\n  commit_s: 1\nhttp: {num_threads: 2}\nstore:\n  retry_s: 2\n", "line 4: 'store' is in line 1 already"},
      {"store:\n  commit_s: 1\n  commit_s: 1\n", "line 3: 'store.commit_s' is in line 2 already"},
      {"store: {commit_s: 1}\nstore.commit_s: 2\n", "line 2: 'store.commit_s' is in line 1 already"},
      {"db: x\n---\ndb: y\n", "line 3: a second document begins"},
      {"a:\n  - 1\n", "line 1: 'a' is a list"},
  };
  for (const auto& [text, message] : cases) {
    const auto values = ParseYaml(text);
    ASSERT_FALSE(values.ok()) << text;
    EXPECT_EQ(values.status().reason(), Reason("BAD_CONFIG"));
    EXPECT_NE(values.status().message().find(message), std::string::npos) << text << values.status().ToString();
  }
}

TEST(ConfigLoader, AliasesCannotExpandToAHugeDocument) {
  std::string text = "a0: &a0 {x: 1, y: 2}\n";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "*a" + std::to_string(i - 1), now = std::to_string(i);
    text += "a" + now + ": &a" + now + " {x: " + before + ", y: " + before + "}\n";
  }
  const auto values = ParseYaml(text);
  ASSERT_FALSE(values.ok());
  EXPECT_NE(values.status().message().find("more than 10000 keys"), std::string::npos) << values.status().ToString();
}

TEST(ConfigLoader, AnAliasHasTheValueOfItsAnchor) {
  const auto values = ParseYaml("db: &name x\nmore: *name\n");
  ASSERT_TRUE(values.ok()) << values.status().ToString();
  EXPECT_EQ(*values, (KeyValues{{"db", "x"}, {"more", "x"}}));
}

TEST(CommandLine, FlagsPrecedeEnvironmentFileAndDefaults) {
  const testing::TempDir dir;
  const std::string path =
      WriteFile(dir, "db: file.db\nhttp: {num_threads: 2}\ngrpc: {num_threads: 2}\nstore: {commit_s: 7}\n");
  const auto invocation = ParseCommandLine({"--config", path, "--set", "grpc.num_threads=5", "--log-level", "debug"},
                                           {"DHPMAP_GRPC_NUM_THREADS=3", "DHPMAP_HTTP_NUM_THREADS=3",
                                            "DHPMAP_MAP_DEFAULTS_TRACKING_IOU_THRESHOLD=0.5", "HOME=/root"});
  ASSERT_TRUE(invocation.ok()) << invocation.status().ToString();
  EXPECT_FALSE(invocation->is_done);
  const ServerConfig& config = invocation->config;
  EXPECT_EQ(config.db, "file.db");
  EXPECT_EQ(config.store.commit_s, 7);
  EXPECT_EQ(config.http.num_threads, 3);
  EXPECT_EQ(config.grpc.num_threads, 5);
  EXPECT_EQ(config.map_defaults.tracking.iou_threshold, 0.5);
  EXPECT_EQ(config.log.level, "debug");
  EXPECT_EQ(config.mapping.publish_frames, ServerConfig{}.mapping.publish_frames);
}

TEST(CommandLine, MistakesAreErrors) {
  EXPECT_EQ(ParseCommandLine({}, {}).status().code(), StatusCode::kInvalidArgument);  // no database
  EXPECT_EQ(ParseCommandLine({"--db", "x", "--nope"}, {}).status().code(), StatusCode::kInvalidArgument);
  EXPECT_NE(ParseCommandLine({"--bd=x"}, {}).status().message().find("did you mean '--db'?"), std::string::npos);
  EXPECT_EQ(ParseCommandLine({"--db", "x", "--config", "/no/such/file"}, {}).status().code(), StatusCode::kNotFound);
  for (const char* of_clients : {"DHPMAP_SERVER=127.0.0.1:1", "DHPMAP_AUTHOR=anna"}) {
    EXPECT_TRUE(ParseCommandLine({"--db", "x"}, {of_clients}).ok()) << of_clients;
  }
  EXPECT_EQ(Fields(ParseCommandLine({"--db", "x"}, {"DHPMAP_NOPE=1"}).status()), std::set<std::string>{"DHPMAP_NOPE"});
  EXPECT_EQ(Fields(ParseCommandLine({"--db", "x", "--set", "nope"}, {}).status()), std::set<std::string>{"nope"});
  EXPECT_EQ(Fields(ParseCommandLine({"--db", "x", "--grpc", "0.0.0.0:1"}, {}).status()),
            std::set<std::string>{"grpc.address"});
  EXPECT_TRUE(ParseCommandLine({"--db", "x", "--grpc", "0.0.0.0:1", "--insecure"}, {}).ok());
}

TEST(CommandLine, BadKeysOfFileEnvironmentAndFlagsAreNamedAtOnce) {
  const testing::TempDir dir;
  const std::string file = WriteFile(dir, "store:\n  commit_x: 1\n");
  const auto parsed = ParseCommandLine(
      {"--config", file, "--db", "x", "--set", "store.commit_s=soon", "--set", "log.level=loud"}, {"DHPMAP_NO_SUCH=1"});
  EXPECT_EQ(Fields(parsed.status()),
            (std::set<std::string>{"store.commit_x", "DHPMAP_NO_SUCH", "store.commit_s", "log.level"}));
}

TEST(CommandLine, ParsesCheckConfigAndNoBackup) {
  const auto usual = ParseCommandLine({"--db", "x"}, {});
  ASSERT_TRUE(usual.ok());
  EXPECT_FALSE(usual->is_check);
  EXPECT_TRUE(usual->config.store.backup_before_upgrade);
  const auto other = ParseCommandLine({"--db", "x", "--check-config", "--no-backup"}, {});
  ASSERT_TRUE(other.ok());
  EXPECT_TRUE(other->is_check);
  EXPECT_FALSE(other->is_done);
  EXPECT_FALSE(other->config.store.backup_before_upgrade);
  EXPECT_FALSE(ParseCommandLine({"--check-config"}, {}).ok()) << "without a database there is no start";
}

TEST(ServerConfig, ChangedKeysAreNamed) {
  const ServerConfig before;
  EXPECT_TRUE(ChangedKeys(before, before).empty());
  ServerConfig after;
  after.log.level = "debug";
  after.store.commit_s += 1;
  after.grpc.num_threads += 1;
  after.map_defaults.voxel_size_m *= 2;
  EXPECT_EQ(ChangedKeys(before, after),
            (std::vector<std::string>{"grpc.num_threads", "log.level", "store.commit_s", "map_defaults"}));
}

TEST(CommandLine, PublicAddressesNeedTlsAndKeysOrAnExplicitWaiver) {
  const testing::TempDir dir;
  const std::string db = (dir.path() / "x.db").string();
  const auto starts = [&](std::vector<std::string> flags, const std::vector<std::string>& environment = {}) {
    flags.insert(flags.end(), {"--db", db, "--http", "0.0.0.0:1"});
    return ParseCommandLine(flags, environment).status();
  };
  const Status nothing = starts({});
  EXPECT_NE(nothing.ToString().find("no TLS"), std::string::npos) << nothing.ToString();
  EXPECT_NE(nothing.ToString().find("no keys"), std::string::npos);
  EXPECT_FALSE(starts({"--insecure-no-tls"}).ok());
  EXPECT_FALSE(starts({"--insecure-no-auth"}).ok());
  EXPECT_TRUE(starts({"--insecure-no-tls", "--insecure-no-auth"}).ok());
  EXPECT_TRUE(starts({"--insecure-no-tls", "--set", "auth.keys=k"}).ok()) << "keys are named: whether they can be read "
                                                                             "is seen at the start";
  EXPECT_FALSE(starts({"--set", "auth.keys=k"}).ok()) << "and never without TLS";
  for (const char* variable : {"DHPMAP_INSECURE=true", "DHPMAP_INSECURE_NO_TLS=true", "DHPMAP_INSECURE_NO_AUTH=true"}) {
    EXPECT_EQ(starts({}, {variable}).reason(), Reason("BAD_CONFIG")) << variable;
    EXPECT_FALSE(starts({"--insecure"}, {variable}).ok()) << "of an environment, " << variable << " is no key";
  }
  EXPECT_TRUE(starts({"--insecure-no-tls", "--config", WriteFile(dir, "insecure_no_auth: true\n")}).ok());
  EXPECT_EQ(KeyFileOf(ServerConfig{.db = db}), "") << "nothing is there";
  std::ofstream(db + ".keys") << "";
  EXPECT_EQ(KeyFileOf(ServerConfig{.db = db}), db + ".keys") << "beside the database";
  EXPECT_TRUE(starts({"--insecure-no-tls"}).ok());
  ServerConfig named{.db = db};
  named.auth.keys = "k";
  EXPECT_EQ(KeyFileOf(named), "k");
  std::filesystem::remove(db + ".keys");
  std::filesystem::create_symlink("nowhere", db + ".keys");
  EXPECT_EQ(KeyFileOf(ServerConfig{.db = db}), db + ".keys") << "a link is refused later, and opens nothing";
}

TEST(ServerConfig, TlsAndKeysAreRequiredSeparately) {
  ServerConfig config;
  config.grpc.address = "192.168.1.1:1";
  EXPECT_TRUE(CheckExposure(config, true, true).ok());
  EXPECT_EQ(Fields(CheckExposure(config, true, false)), std::set<std::string>{"grpc.address"});
  EXPECT_EQ(CheckExposure(config, true, false).ToString().find("TLS"), std::string::npos);
  EXPECT_EQ(CheckExposure(config, false, true).ToString().find("no keys"), std::string::npos);
  EXPECT_FALSE(CheckExposure(config, false, true).ok());
  config.insecure = true;
  EXPECT_TRUE(CheckExposure(config, false, false).ok());
}

TEST(CommandLine, PrintConfigShowsEffectiveValuesWithoutADatabase) {
  const auto invocation = ParseCommandLine({"--print-config", "--http", "127.0.0.1:9"}, {});
  ASSERT_TRUE(invocation.ok());
  EXPECT_TRUE(invocation->is_done);
  ServerConfig in_force;
  in_force.http.address = "127.0.0.1:9";
  EXPECT_EQ(invocation->text, ToYaml(in_force)) << "which loads as the same: see above";
  const auto help = ParseCommandLine({"--help"}, {});
  ASSERT_TRUE(help.ok());
  EXPECT_NE(help->text.find("--print-config"), std::string::npos);
}

}  // namespace
}  // namespace dhpmap
