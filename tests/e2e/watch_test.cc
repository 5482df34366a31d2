// SPDX-License-Identifier: BSD-3-Clause
// Watching maps with real processes: server-sent events, the command, and what many watchers cost.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <regex>
#include <set>

#include "tests/e2e/rendered_dataset.h"
#include "tests/e2e/same_maps.h"
#include "tests/e2e/server_process.h"
#include "tests/integration/watcher.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/http/http_client.h"

namespace dhpmap::testing {
namespace {

constexpr double kBytesPerMiB = 1 << 20;

/// A server with a mapped room.
class Watching : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteRenderedDataset(root() / "dataset", 6);
    Start();
    Map();
  }
  /// At the same address each time.
  void Start() {
    server_.emplace(root(), root() / "maps.db", address_);
    ASSERT_TRUE(server_->is_serving()) << server_->process().Stderr();
  }
  void Map() {
    const Outcome mapped = server_->Dhpmap({"map", (root() / "dataset").string(), "--map", "room"});
    ASSERT_EQ(mapped.exit_code, 0) << mapped.err;
  }
  void Rename(const std::string& name) {
    const Outcome renamed = server_->Dhpmap({"edit", "rename", "room", "1", name});
    ASSERT_EQ(renamed.exit_code, 0) << renamed.err;
  }
  [[nodiscard]] std::filesystem::path root() const { return temp_.path(); }
  [[nodiscard]] int http_port() const {
    return std::stoi(server_->http_url().substr(server_->http_url().rfind(':') + 1));
  }
  double Gauge(const std::string& name) {
    const Outcome page = RunProgram(root(), {"curl", "--silent", "--fail", server_->http_url() + "/metrics"});
    EXPECT_EQ(page.exit_code, 0) << page.err;
    const std::size_t at = page.out.find("\n" + name + " ");
    EXPECT_NE(at, std::string::npos) << name;
    return at == std::string::npos ? -1 : std::stod(page.out.substr(at + name.size() + 2));
  }
  /// What a client gets that asks for events, up to the first that tells of the map as it is now.
  std::string Events(const std::string& query, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"curl", "--silent", "--no-buffer", "--header", "Accept: text/event-stream"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.push_back(server_->http_url() + "/v1/maps/room:watch" + query);
    const std::string newest = "-" + std::to_string(GetMap(*server_, "room").revision()) + "\n";
    const Process curl(root(), arguments);
    std::string events;
    EXPECT_TRUE(Eventually([&] {
      events = curl.Stdout();
      const std::size_t at = events.find(newest);
      const std::size_t end = at == std::string::npos ? at : events.find("\n\n", at);
      if (end != std::string::npos) events.resize(end);
      return end != std::string::npos;
    })) << events;
    return events;
  }
  /// Asks for the map's events over HTTP; progress is told so seldom that no test sees it twice.
  static bool Ask(http::HttpClient& client, const std::string& accept = "text/event-stream") {
    return client.SendRaw("GET /v1/maps/room:watch?progress_interval_s=300 HTTP/1.1\r\nHost: localhost\r\nAccept: " +
                          accept + "\r\n\r\n");
  }
  /// What comes, up to `text` or the end.
  static std::string ReadUpTo(http::HttpClient& client, const std::string& text) {
    std::string all;
    Eventually([&] {
      const std::string more = client.ReadSome();
      all += more;
      return more.empty() || all.find(text) != std::string::npos;
    });
    return all;
  }
  static bool Hears(http::HttpClient& client, const std::string& text) {
    return ReadUpTo(client, text).find(text) != std::string::npos;
  }
  static std::vector<std::string> IdsOf(const std::string& events) {
    std::vector<std::string> ids;
    const std::regex pattern("\nid: ([0-9a-f]{16}-[0-9]+)\n");
    for (std::sregex_iterator it(events.begin(), events.end(), pattern), end; it != end; ++it) ids.push_back((*it)[1]);
    return ids;
  }

  TempDir temp_;
  const std::string address_ = AddressToComeBackTo();
  std::optional<ServerProcess> server_;
};

TEST_F(Watching, AsServerSentEventsItGoesOnAfterTheLastEventId) {
  const std::string all = Events("?start_revision=1", {"--include"});
  EXPECT_NE(all.find("Content-Type: text/event-stream"), std::string::npos) << all;
  EXPECT_NE(all.find("event: progress\n"), std::string::npos);
  const std::vector<std::string> ids = IdsOf(all);
  ASSERT_GE(ids.size(), 3u) << all;
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size()) << "each once";
  const std::string& middle = ids[ids.size() / 2];
  // As a browser's EventSource that connects again: with the URL that it began with.
  const std::string rest = Events("?start_revision=1", {"--header", "Last-Event-ID: " + middle});
  const std::string after_middle = all.substr(all.find("event: change", all.find("id: " + middle)));
  EXPECT_NE(rest.find(after_middle), std::string::npos) << "the first event only says where it begins";
}

TEST_F(Watching, AsServerSentEventsTheyTellOfFilesThatGoOut) {
  http::HttpClient client(http_port());
  ASSERT_TRUE(Ask(client));
  std::string events = client.ReadSome();
  EXPECT_EQ(events.find("MAP_FILE"), std::string::npos) << events;
  const Outcome fetched = RunProgram(
      root(), {"curl", "-sf", "-o", (root() / "room.dhpmap").string(), server_->http_url() + "/v1/maps/room:export"});
  ASSERT_EQ(fetched.exit_code, 0) << fetched.err;
  events += ReadUpTo(client, "\"SENT\"");
  EXPECT_NE(events.find("event: progress\n"), std::string::npos) << events;
  EXPECT_NE(events.find("\"MAP_FILE\""), std::string::npos) << events;
  const std::string size = std::to_string(std::filesystem::file_size(root() / "room.dhpmap"));
  EXPECT_TRUE(std::regex_search(events, std::regex("\"done_?[bB]ytes\": ?\"" + size + "\""))) << size << events;
}

TEST_F(Watching, APositionThatIsLostOrCompactedIsGoneToHttp) {
  const auto status_of = [this](const std::string& query, const std::string& header) {
    return RunProgram(root(), {"curl", "--silent", "--output", "/dev/null", "--write-out", "%{http_code}", "--header",
                               header, server_->http_url() + "/v1/maps/room:watch" + query})
        .out;
  };
  EXPECT_EQ(status_of("", "Last-Event-ID: 00000000deadbeef-3"), "410");
  EXPECT_EQ(status_of("?start_revision=100000", "Accept: text/event-stream"), "410");
  EXPECT_EQ(status_of("", "Last-Event-ID: nonsense"), "400");
  setenv("DHPMAP_WATCH_HISTORY_CHANGES", "1", 1);
  server_.reset();
  Start();
  unsetenv("DHPMAP_WATCH_HISTORY_CHANGES");
  Rename("first");
  EXPECT_EQ(status_of("?start_revision=1", "Accept: text/event-stream"), "410");
}

TEST_F(Watching, NoIdleTimeoutEndsOneThatIsSilent) {
  setenv("DHPMAP_HTTP_IDLE_TIMEOUT_S", "0.2", 1);
  server_.reset();
  Start();
  unsetenv("DHPMAP_HTTP_IDLE_TIMEOUT_S");
  std::optional<http::HttpClient> client;
  ASSERT_TRUE(Eventually([&] {  // one that has not asked in time, on a busy machine, is idle, too
    client.emplace(http_port());
    return Ask(*client) && Hears(*client, "event: progress");
  }));
  http::HttpClient idle(http_port());
  EXPECT_TRUE(idle.IsClosedByServer()) << "and has been silent for a shorter time";
  Rename("still there");
  EXPECT_TRUE(Hears(*client, "still there"));
}

TEST_F(Watching, EndsWithoutWaitingForAHeartbeatWhenTheClientIsGone) {
  static_assert(kPatience < std::chrono::seconds(300), "when the next heartbeat is due");
  for (const char* accept : {"text/event-stream", "application/json"}) {
    auto client = std::make_unique<http::HttpClient>(http_port());
    ASSERT_TRUE(Ask(*client, accept));
    EXPECT_TRUE(Hears(*client, "200 OK"));
    EXPECT_EQ(Gauge("dhpmap_watchers"), 1);
    client = nullptr;
    EXPECT_TRUE(Eventually([&] { return Gauge("dhpmap_watchers") == 0; }));
  }
}

TEST_F(Watching, FiveHundredIdleWatchersTakeNeitherThreadsNorMuchMemory) {
  constexpr int kNumOfEach = 250;
  {  // so that what is made once is there
    http::HttpClient client(http_port());
    ASSERT_TRUE(Ask(client) && !client.ReadSome().empty());
  }
  ASSERT_TRUE(Eventually([&] { return Gauge("dhpmap_watchers") == 0; }));
  const double memory_before = Gauge("dhpmap_anonymous_memory_bytes"), threads_before = Gauge("process_threads");
  std::vector<std::unique_ptr<http::HttpClient>> over_http;
  std::vector<std::unique_ptr<v1::WatchService::Stub>> stubs;
  std::vector<std::unique_ptr<Watcher>> over_grpc;
  for (int n = 0; n < kNumOfEach; ++n) {
    over_http.push_back(std::make_unique<http::HttpClient>(http_port()));
    ASSERT_TRUE(Ask(*over_http.back()));
    if (n % 50 == 0) stubs.push_back(v1::WatchService::NewStub(server_->Connect()));
    v1::WatchMapRequest request;
    request.set_map("maps/room");
    request.set_progress_interval_s(300);
    over_grpc.push_back(std::make_unique<Watcher>(*stubs.back(), request));
  }
  v1::WatchMapResponse message;
  for (const auto& watcher : over_grpc) ASSERT_TRUE(watcher->Read(message));
  for (const auto& client : over_http) ASSERT_NE(client->ReadSome(), "");
  EXPECT_EQ(Gauge("dhpmap_watchers"), 2 * kNumOfEach);
  const double memory = Gauge("dhpmap_anonymous_memory_bytes") - memory_before;
  const double threads = Gauge("process_threads") - threads_before;
  RecordProperty("mib", std::to_string(memory / kBytesPerMiB));
  std::printf("%d watchers: %.1f MiB, %.0f threads more\n", 2 * kNumOfEach, memory / kBytesPerMiB, threads);
  EXPECT_LT(memory, 100 * kBytesPerMiB);
  EXPECT_LT(threads, kNumOfEach / 4) << "gRPC makes some as it likes";
  Rename("woken");
  for (const auto& watcher : over_grpc) {
    ASSERT_TRUE(watcher->Read(message));
    EXPECT_EQ(message.change().submaps_size(), 1);
  }
  for (const auto& client : over_http) EXPECT_TRUE(Hears(*client, "woken"));
}

TEST_F(Watching, TheCommandTellsAndGoesOnByItselfWhenTheServerComesBack) {
  const Outcome told = server_->Dhpmap({"watch", "room", "--from", "1", "--until", "2"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_NE(told.out.find("revision 1:\n  created 0"), std::string::npos) << told.out;
  const Outcome as_json = server_->Dhpmap({"--json", "watch", "room", "--from", "1", "--until", "2"});
  EXPECT_NE(as_json.out.find("{\"position\":\""), std::string::npos) << as_json.out;
  EXPECT_EQ(server_->Dhpmap({"watch", "ghost"}).exit_code, 3);
  EXPECT_EQ(server_->Dhpmap({"watch", "room", "--from", "100000"}).exit_code, 2);

  Process command(root(), {Program("dhpmap"), "--server", address_, "watch", "room"});
  ASSERT_TRUE(Eventually([&] { return command.Stdout().find("is told") != std::string::npos; }));
  Rename("before");
  ASSERT_TRUE(Eventually([&] { return command.Stdout().find("'before'") != std::string::npos; }));
  EXPECT_EQ(server_->Dhpmap({"maps", "export", "room", (root() / "room.dhpmap").string()}).exit_code, 0);
  EXPECT_TRUE(Eventually([&] { return command.Stdout().find("export 1, map_file: sent, ") != std::string::npos; }))
      << command.Stdout();
  server_->process().Signal(SIGKILL);
  server_->process().Wait();
  server_.reset();
  Start();
  Rename("after");
  EXPECT_TRUE(Eventually([&] { return command.Stdout().find("'after'") != std::string::npos; })) << command.Stderr();
  EXPECT_NE(command.Stderr().find("the connection is lost"), std::string::npos) << command.Stderr();
  EXPECT_EQ(server_->Dhpmap({"maps", "delete", "room", "--yes"}).exit_code, 0);
  EXPECT_EQ(command.Wait(), 3) << "the map is deleted";
}

}  // namespace
}  // namespace dhpmap::testing
