// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/paging.h"

#include <gtest/gtest.h>

#include <vector>

#include "dhpmap/v1/submap_service.pb.h"

namespace dhpmap {
namespace {

const PageMark kNow{.history_id = 0xABCDEF, .revision = 20};

v1::ListSubmapsRequest Request(int page_size = 0, const std::string& token = "") {
  v1::ListSubmapsRequest request;
  request.set_parent("maps/room");
  request.set_page_size(page_size);
  request.set_page_token(token);
  return request;
}

v1::Submap Item(std::size_t name_bytes = 1) {
  v1::Submap submap;
  submap.set_display_name(std::string(name_bytes, 'x'));
  return submap;
}

/// The keys of a page of a list of `num_items`, and the token of the next.
std::pair<std::vector<int>, std::string> Page(const v1::ListSubmapsRequest& request, int num_items,
                                              std::size_t item_bytes = 1) {
  auto pager = Pager::Begin(request, kNow);
  EXPECT_TRUE(pager.ok());
  std::vector<int> keys;
  const auto after = SubmapIdFromPage(*pager);
  for (int key = *after ? static_cast<int>((*after)->value) + 1 : 0; key < num_items; ++key) {
    if (!pager->Takes(Item(item_bytes), std::to_string(key))) break;
    keys.push_back(key);
  }
  return {keys, pager->NextToken()};
}

TEST(Paging, PagesFormTheListInOrder) {
  for (const int num_items : {0, 1, 6, 7, 8, 14, 15}) {
    std::vector<int> all;
    std::string token;
    int num_pages = 0;
    do {
      const auto [keys, next] = Page(Request(7, token), num_items);
      all.insert(all.end(), keys.begin(), keys.end());
      token = next;
      ++num_pages;
    } while (!token.empty());
    ASSERT_EQ(all.size(), static_cast<std::size_t>(num_items));
    for (int i = 0; i < num_items; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)], i);
    EXPECT_EQ(num_pages, std::max(1, (num_items + 6) / 7)) << "no empty page at the end";
  }
}

TEST(Paging, APageContainsAtMostAThousandItems) {
  EXPECT_EQ(Page(Request(), 1500).first.size(), 1000u);
  EXPECT_EQ(Page(Request(5000), 1500).first.size(), 1000u);
  EXPECT_TRUE(Page(Request(), 1000).second.empty());
}

TEST(Paging, APageOfLargeItemsIsShorterButNeverEmpty) {
  EXPECT_EQ(Page(Request(), 100, 100'000).first.size(), 10u);
  EXPECT_EQ(Page(Request(), 3, 3'000'000).first.size(), 1u);
}

TEST(Paging, ATokenIsValidForOneRequest) {
  const std::string token = Page(Request(2), 10).second;
  EXPECT_TRUE(Pager::Begin(Request(5, token), kNow).ok()) << "the size may change";
  v1::ListSubmapsRequest other = Request(2, token);
  other.add_class_ids(3);
  EXPECT_EQ(Pager::Begin(other, kNow).status().reason(), Reason("BAD_PAGE_TOKEN"));
  for (const std::string& bad : {std::string("x"), token.substr(1), token + "x", token.substr(0, token.size() - 1),
                                 std::string("1.2.3.4"), std::string("...."), std::string(1000, '1')}) {
    const auto pager = Pager::Begin(Request(2, bad), kNow);
    const bool refused = !pager.ok() || !SubmapIdFromPage(*pager).ok();
    EXPECT_TRUE(refused || bad == token) << bad;
  }
}

TEST(Paging, ATokenOfALostStateIsRefusedWithAReason) {
  const std::string token = Page(Request(2), 10).second;
  const auto begin = [&token](const PageMark& now) { return Pager::Begin(Request(2, token), now).status(); };
  EXPECT_TRUE(begin({.history_id = kNow.history_id, .revision = 25}).ok()) << "the map went on";
  EXPECT_EQ(begin({.history_id = kNow.history_id, .revision = 19}).reason(), Reason("HISTORY_LOST"));
  EXPECT_EQ(begin({.history_id = 1, .revision = 20}).reason(), Reason("HISTORY_LOST"));
  EXPECT_EQ(begin({.history_id = 1, .revision = 20}).code(), StatusCode::kOutOfRange);
}

TEST(Paging, ATokenOfAStateLostInACrashStaysInvalid) {
  const std::string token = Page(Request(2), 10).second;
  const PageMark later{.history_id = kNow.history_id, .revision = 5000};
  const auto begin = [&](const LostRevisions& lost) { return Pager::Begin(Request(2, token), later, lost).status(); };
  EXPECT_TRUE(begin({{10, 19}, {21, 4000}}).ok());
  EXPECT_EQ(begin({{10, 15}, {20, 20}, {4000, 4001}}).reason(), Reason("HISTORY_LOST"));
  EXPECT_EQ(begin({{18, 1000}}).code(), StatusCode::kOutOfRange);
}

TEST(Paging, ANegativeSizeIsRefused) {
  const Status status = Pager::Begin(Request(-1), kNow).status();
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].field, "page_size");
}

}  // namespace
}  // namespace dhpmap
