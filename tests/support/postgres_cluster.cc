// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/postgres_cluster.h"

#include <pwd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

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

pid_t StartShell(const std::string& command) {
  const pid_t child = fork();
  if (child != 0) return child;
  execl("/bin/sh", "sh", "-c", ("exec " + command + " >/dev/null 2>&1").c_str(), nullptr);
  _exit(127);
}

}  // namespace

PostgresCluster* PostgresCluster::Get() {
  static const std::unique_ptr<PostgresCluster> cluster = [] {
    std::unique_ptr<PostgresCluster> made(new PostgresCluster());
    return made->Start() ? std::move(made) : nullptr;
  }();
  return cluster.get();
}

bool PostgresCluster::Start() {
  bin_ = FindPrograms();
  if (bin_.empty()) return false;
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
  server_ = StartShell(AsSomebody(user) + bin_ + "/postgres -D " + data +
                       " -c listen_addresses= -c unix_socket_directories=" + folder_.path().string() +
                       " -c fsync=off -c full_page_writes=off -c shared_buffers=32MB -c max_connections=60");
  const std::string is_ready = bin_ + "/pg_isready -h " + folder_.path().string();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!Succeeds(is_ready)) {
    if (waitpid(server_, nullptr, WNOHANG) != 0 || std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

PostgresCluster::~PostgresCluster() {
  if (server_ <= 0) return;
  kill(server_, SIGQUIT);
  waitpid(server_, nullptr, 0);
}

std::string PostgresCluster::Url() const { return "postgresql://postgres@/postgres?host=" + folder_.path().string(); }

void PostgresCluster::CutConnections() const {
  (void)Succeeds(
      bin_ + "/psql -h " + folder_.path().string() +
      " -U postgres -c 'SELECT pg_terminate_backend(pid, 5000) FROM pg_stat_activity WHERE application_name = "
      "$$dhpmap-server$$'");
}

}  // namespace dhpmap::testing
