// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <random>
#include <string>
#include <thread>

namespace dhpmap::testing {

/// Forwards one connection to a port of this machine until it freezes. Then it forwards nothing more, but the
/// connection stays open, as with a stopped process.
class TcpProxy {
 public:
  explicit TcpProxy(int to_port);
  ~TcpProxy();
  TcpProxy(const TcpProxy&) = delete;
  TcpProxy& operator=(const TcpProxy&) = delete;

  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  void Freeze() { is_frozen_ = true; }
  /// How often the client has sent data after the server had.
  [[nodiscard]] int num_answers() const { return num_answers_; }

 private:
  void Run();

  const int to_port_;
  int port_ = 0;
  int listener_ = -1;
  std::atomic<bool> is_frozen_ = false, is_over_ = false;
  std::atomic<int> num_answers_ = 0;
  std::thread thread_;
};

/// Forwards connections to a port of this machine, one after the other. Cuts each after a random number of bytes, in
/// either direction.
class CuttingProxy {
 public:
  CuttingProxy(int to_port, std::uint32_t seed);
  ~CuttingProxy();
  CuttingProxy(const CuttingProxy&) = delete;
  CuttingProxy& operator=(const CuttingProxy&) = delete;

  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  void Run();
  void Forward(int client, int server, std::size_t num_bytes);

  const int to_port_;
  int port_ = 0;
  int listener_ = -1;
  std::mt19937 random_;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

}  // namespace dhpmap::testing
