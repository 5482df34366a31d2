// SPDX-License-Identifier: BSD-3-Clause
// A program that uses the client and messages of its own: protobuf would end it if the messages were there twice.
#include <iostream>

#include "dhpmap/client.h"
#include "dhpmap/v1/map_service.pb.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto connected = dhpmap::client::Client::Connect(argv[1]);
  if (!connected.ok()) return std::cerr << connected.status().ToString() << "\n", 1;
  dhpmap::v1::Map map;
  map.set_name(connected->Maps().value().at(0).name);
  std::cout << map.ShortDebugString() << "\n";
}
