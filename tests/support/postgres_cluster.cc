// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/postgres_cluster.h"

#include <fcntl.h>
#include <poll.h>
#include <pwd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

namespace dhpmap::testing {
namespace {

namespace fs = std::filesystem;

/// Where initdb and postgres are; empty if nowhere.
std::string FindPrograms() {
  std::error_code error;
  for (const auto& version : fs::directory_iterator("/usr/lib/postgresql", error)) {
    const fs::path bin = version.path() / "bin";
    if (fs::exists(bin / "initdb", error) && fs::exists(bin / "postgres", error)) return bin.string();
  }
  return "";
}

/// PostgreSQL refuses root: who is root has it run as somebody else, and ended with this process in any case.
std::string AsSomebody(const passwd* user) {
  std::string prefix = "setpriv --pdeathsig QUIT";
  if (user != nullptr) {
    prefix +=
        " --reuid=" + std::to_string(user->pw_uid) + " --regid=" + std::to_string(user->pw_gid) + " --clear-groups";
  }
  return prefix + " ";
}

bool Succeeds(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

/// What it writes to its standard error goes to `to`.
pid_t StartShell(const std::string& command, int to) {
  const pid_t child = fork();
  if (child != 0) return child;
  dup2(to, STDERR_FILENO);
  execl("/bin/sh", "sh", "-c", ("exec " + command + " >/dev/null").c_str(), nullptr);
  _exit(127);
}

/// Reads until the server says that it takes connections. False if it ends before, or says nothing for a minute.
bool WaitUntilReady(int from, std::string& said) {
  std::array<char, 4096> buffer{};
  while (said.find("ready to accept connections") == std::string::npos) {
    pollfd readable{.fd = from, .events = POLLIN, .revents = 0};
    if (poll(&readable, 1, 60'000) <= 0) return false;
    const ssize_t length = read(from, buffer.data(), buffer.size());
    if (length <= 0) return false;
    said.append(buffer.data(), static_cast<std::size_t>(length));
  }
  return true;
}

}  // namespace

PostgresCluster* PostgresCluster::Get() {
  static PostgresCluster cluster(FindPrograms());
  if (cluster.bin_.empty()) return nullptr;
  static const bool is_ready = cluster.Start();
  if (!is_ready) throw std::runtime_error("the PostgreSQL of " + cluster.bin_ + " does not start: " + cluster.said_);
  return &cluster;
}

bool PostgresCluster::Start() {
  const passwd* user = nullptr;
  if (geteuid() == 0) {
    user = getpwnam("postgres");
    if (user == nullptr) user = getpwnam("nobody");
    if (user == nullptr || chown(folder_.path().c_str(), user->pw_uid, user->pw_gid) != 0) return false;
  }
  const std::string somebody = "cd " + folder_.path().string() + " && " + AsSomebody(user);
  const std::string data = folder_.path().string() + "/data";
  const std::string init = somebody + bin_ + "/initdb -D " + data + " -U postgres -A trust -E UTF8 --no-sync --locale=";
  // A locale with an order of its own on purpose: ours is by bytes whatever the database's is.
  if (!Succeeds(init + "en_US.UTF-8") && !Succeeds("rm -rf " + data + "; " + init + "C.UTF-8")) return false;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return false;
  server_ = StartShell(AsSomebody(user) + bin_ + "/postgres -D " + data +
                           " -c listen_addresses= -c unix_socket_directories=" + folder_.path().string() +
                           " -c fsync=off -c full_page_writes=off -c shared_buffers=32MB -c max_connections=60" +
                           " -c lc_messages=C",
                       ends[1]);
  close(ends[1]);
  const bool is_ready = WaitUntilReady(ends[0], said_);
  close(ends[0]);  // what it logs later is lost, and does not block it
  return is_ready;
}

PostgresCluster::~PostgresCluster() {
  if (server_ <= 0) return;
  kill(server_, SIGQUIT);
  waitpid(server_, nullptr, 0);
}

std::string PostgresCluster::UrlOf(const std::string& database) const {
  return "postgresql://postgres@/" + database + "?host=" + folder_.path().string();
}

std::string PostgresCluster::Url() const { return UrlOf("postgres"); }

bool PostgresCluster::RunSql(const std::string& sql) const {
  return Succeeds(bin_ + "/psql -h " + folder_.path().string() + " -U postgres -c '" + sql + "'");
}

std::string PostgresCluster::NewDatabase() {
  const std::string name = "test_" + std::to_string(++num_databases_);
  if (!RunSql("CREATE DATABASE " + name)) throw std::runtime_error("PostgreSQL makes no database " + name);
  return UrlOf(name);
}

void PostgresCluster::CutConnections() const {
  (void)RunSql(
      "SELECT pg_terminate_backend(pid, 5000) FROM pg_stat_activity WHERE application_name LIKE $$dhpmap-server%$$");
}

}  // namespace dhpmap::testing
