// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "json_test.pb.h"
#include "server/json/writer.h"

namespace dhpmap::json {

/// A message with every kind of field set, to the ends of their ranges.
inline test::Everything FullMessage() {
  test::Everything m;
  m.set_i32(-7);
  m.set_i64(std::numeric_limits<std::int64_t>::min());
  m.set_u32(std::numeric_limits<std::uint32_t>::max());
  m.set_u64(std::numeric_limits<std::uint64_t>::max());
  m.set_s32(std::numeric_limits<std::int32_t>::min());
  m.set_f64(1);
  m.set_real(0.1f);
  m.set_real_double(1e-300);
  m.set_flag(true);
  m.set_text("quote \" back \\ tab \t euro \xE2\x82\xAC nul \x01");
  m.set_raw(std::string("\x00\xFF\x10", 3));
  m.set_shade(test::DARK);
  m.mutable_child()->set_maybe(0);
  for (const std::int64_t i : {1, -2, 3}) m.add_many_i64(i);
  for (const float f : {0.5f, -1e20f, std::numeric_limits<float>::infinity()}) m.add_many_real(f);
  m.add_many_text("");
  m.add_many_text("b");
  m.add_many_shade(test::LIGHT);
  m.add_many_shade(static_cast<test::Shade>(99));
  m.add_many_child()->set_text("x");
  m.add_many_child();
  (*m.mutable_counts())["one"] = 1;
  (*m.mutable_children())[-5].set_flag(true);
  (*m.mutable_by_flag())[true] = "yes";
  m.mutable_choice_child()->set_u32(3);
  m.mutable_time()->set_seconds(1700000000);
  m.mutable_span()->set_nanos(5000000);
  m.mutable_mask()->add_paths("map_from_submap.translation_m");
  m.mutable_boxed()->set_value(0);
  m.mutable_boxed_text()->set_value("boxed");
  (*m.mutable_structure()->mutable_fields())["k"].set_number_value(2);
  m.mutable_value()->set_null_value(google::protobuf::NULL_VALUE);
  m.mutable_any()->PackFrom(m.child());
  m.add_times()->set_seconds(5);
  m.set_renamed("r");
  return m;
}

inline std::string Written(const test::Everything& message) {
  std::string text;
  Append(message, &text);
  return text;
}

}  // namespace dhpmap::json
