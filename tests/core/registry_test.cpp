#include <gyrostat/core/registry.hpp>

#include <gtest/gtest.h>

namespace gyrostat::registry_test {

struct Made {
  static constexpr std::string_view kind = "thing";
  std::string id;
  int number = 0;

  static void describe_all(std::deque<Made>& to) { to.push_back({"ours", 1}); }
};

TEST(Registry, WhatAProgramAddedCanBeDescribedAnewWhereItStands) {
  auto& things = Registry<Made>::all();
  things.add_or_replace({"theirs", 2});
  const auto* before = things.find("theirs");
  things.add_or_replace({"theirs", 3});
  EXPECT_EQ(things.find("theirs"), before);
  EXPECT_EQ(before->number, 3);
  EXPECT_EQ(things.size(), 2U);
  EXPECT_THROW(things.add({"theirs", 4}), InputError);
  EXPECT_THROW(things.add_or_replace({"ours", 4}), InputError);
  EXPECT_EQ(things.find("ours")->number, 1);
}

}  // namespace gyrostat::registry_test
