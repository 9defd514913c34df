#include <gyrostat/experiments/findings/report/rank_picture.hpp>

#include <cmath>

#include <gmock/gmock.h>

namespace gyrostat::rank_picture_test {
namespace {

Study four_methods() {
  Study study;
  study.cells.emplace_back();
  for (const char* id : {"a", "b", "c", "x"})
    study.cells[0].methods.push_back({id, "kf", ParameterSource::truth, {}, {}});
  return study;
}

CellRanking ranking(double critical_difference) {
  CellRanking r;
  for (const auto& [id, rank] : {std::pair("c", 3.0), std::pair("a", 1.0), std::pair("b", 1.5),
                                 std::pair("x", double(NAN))}) {
    r.methods.emplace_back();
    r.methods.back().method = id;
    r.methods.back().mean_rank = rank;
  }
  r.critical_difference = critical_difference;
  r.not_separable = {{0, 2}};
  return r;
}

std::vector<Mark> marks(const Picture& picture, bool strong) {
  auto all = picture.marks;
  std::erase_if(all,
                [&](const Mark& m) { return m.kind != Mark::Kind::line || m.strong != strong; });
  return all;
}

TEST(RankPicture, ABarJoinsWhatTheCriticalDifferenceSpans) {
  const MethodColours colours(four_methods());
  const auto picture = rank_picture(ranking(0.6), colours, "r");
  const auto bars = marks(picture, true);
  ASSERT_EQ(bars.size(), 1U);
  EXPECT_THAT(bars[0].x, testing::ElementsAre(1.0, 1.5));
  EXPECT_EQ(bars[0].labels[0], "a, b");
  EXPECT_THAT(picture.y.names, testing::ElementsAre("c", "a", "b", "x", "alike in rank"));
  EXPECT_EQ(picture_file(picture).find("nan"), std::string::npos);

  const auto wide = marks(rank_picture(ranking(2.5), colours, "r"), true);
  ASSERT_EQ(wide.size(), 1U) << "one bar over all";
  EXPECT_THAT(wide[0].x, testing::ElementsAre(1.0, 3.0));
  EXPECT_EQ(marks(rank_picture(ranking(1.6), colours, "r"), true).size(), 2U);
  EXPECT_TRUE(marks(rank_picture(ranking(NAN), colours, "r"), true).empty());
}

TEST(RankPicture, ALineLinksWhatIsNotSeparable) {
  const auto links = marks(rank_picture(ranking(0.6), MethodColours(four_methods()), "r"), false);
  ASSERT_EQ(links.size(), 1U);
  EXPECT_THAT(links[0].x, testing::ElementsAre(3.0, 1.5));
  EXPECT_THAT(links[0].y, testing::ElementsAre(0.0, 2.0));
}

}  // namespace
}  // namespace gyrostat::rank_picture_test
