#include <gyrostat/core/fields.hpp>

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/filters/sr_rsukf.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat::fields_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Range, ReadsAsAnInterval) {
  EXPECT_EQ(ranges::any.to_string(), "(-inf, inf)");
  EXPECT_EQ(ranges::positive.to_string(), "(0, inf)");
  EXPECT_EQ(ranges::non_negative.to_string(), "[0, inf)");
  EXPECT_EQ(ranges::at_least_one.to_string(), "[1, inf)");
  EXPECT_EQ(ranges::stationary.to_string(), "(-1, 1)");
  EXPECT_EQ(ranges::fraction.to_string(), "[0, 1]");
  EXPECT_EQ(ranges::flag.to_string(), "[0, 1], whole numbers");
  EXPECT_EQ(ranges::count.to_string(), "[1, inf), whole numbers");
  EXPECT_EQ((Range{.from = -7, .to = 0.5, .open_from = true}.to_string()), "(-7, 0.5]");
}

TEST(Range, AnOpenEndLeavesItsPointOut) {
  const double above = std::nextafter(-1.0, 0.0), below = std::nextafter(1.0, 0.0);
  EXPECT_FALSE(ranges::stationary.contains(-1.0));
  EXPECT_FALSE(ranges::stationary.contains(1.0));
  EXPECT_TRUE(ranges::stationary.contains(above));
  EXPECT_TRUE(ranges::stationary.contains(below));
}

TEST(Range, AClosedEndHoldsItsPointAndNothingBeyond) {
  EXPECT_TRUE(ranges::fraction.contains(0.0));
  EXPECT_TRUE(ranges::fraction.contains(1.0));
  EXPECT_FALSE(ranges::fraction.contains(std::nextafter(0.0, -1.0)));
  EXPECT_FALSE(ranges::fraction.contains(std::nextafter(1.0, 2.0)));
}

TEST(Range, WholeNumbersLeaveTheRestOut) {
  EXPECT_TRUE(ranges::count.contains(1.0));
  EXPECT_TRUE(ranges::count.contains(1e15));
  EXPECT_FALSE(ranges::count.contains(1.5));
  EXPECT_FALSE(ranges::count.contains(0.0));
  EXPECT_FALSE(ranges::flag.contains(0.5));
}

TEST(Range, NoRangeHoldsNanOrInfinity) {
  for (const Range& range : {ranges::any, ranges::positive, ranges::flag, ranges::stationary})
    for (const double value : {no_value, infinity, -infinity}) EXPECT_FALSE(range.contains(value));
}

struct Base {
  double a = 1.0;
  static constexpr auto fields() {
    return std::array{Field{"a", &Base::a, "s", ranges::positive, "first"}};
  }
};
struct Other {
  double b = 2.0, c = 3.0;
  static constexpr auto fields() {
    return std::array{Field{"b", &Other::b, "dps", ranges::any, "second"},
                      Field{"c", &Other::c, "1", ranges::flag, "third"}};
  }
};
struct Joined : Base, Other {
  static constexpr auto fields() {
    return join_fields<Joined, double>(Base::fields(), Other::fields());
  }
};

TEST(JoinFields, KeepsOrderAndTextAndReachesTheMembersOfEveryBase) {
  constexpr auto fields = Joined::fields();
  static_assert(fields.size() == 3);
  Joined p;
  std::string names;
  for (const auto& field : fields) {
    names += field.name;
    p.*(field.member) *= 10.0;
  }
  EXPECT_EQ(names, "abc");
  EXPECT_EQ(p.a, 10.0);
  EXPECT_EQ(p.b, 20.0);
  EXPECT_EQ(p.c, 30.0);
  EXPECT_EQ(fields[0].unit, "s");
  EXPECT_EQ(fields[2].doc, "third");
  EXPECT_TRUE(fields[2].range.whole);
}

TEST(CastParameters, CarriesEveryFieldToTheOtherScalar) {
  filters::SrRsukfParameters<double> p;
  for (const auto& field : p.fields()) p.*(field.member) += 0.125;
  const auto cast = cast_parameters<long double>(p);
  const auto from = p.fields();
  const auto to = cast.fields();
  ASSERT_EQ(from.size(), to.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    EXPECT_EQ(from[i].name, to[i].name);
    EXPECT_EQ(static_cast<long double>(p.*(from[i].member)), cast.*(to[i].member)) << from[i].name;
  }
}

TEST(WrapDegrees, GivesTheSameAngleBetweenMinus180And180) {
  for (double angle = -1000.0; angle < 1000.0; angle += 0.5) {
    const double wrapped = wrap_degrees(angle);
    EXPECT_GE(wrapped, -180.0);
    EXPECT_LT(wrapped, 180.0);
    EXPECT_EQ(std::remainder(angle - wrapped, 360.0), 0.0);
  }
  EXPECT_EQ(wrap_degrees(180.0), -180.0);
  EXPECT_EQ(wrap_degrees(-180.0), -180.0);
}

TEST(NearestName, IsTheOneWithTheFewestEdits) {
  const std::vector<std::string> names = {"kf", "kf_ma", "sr_ukf", "sr_rsukf"};
  EXPECT_EQ(nearest_name("srukf", names), "sr_ukf");
  EXPECT_EQ(nearest_name("kfma", names), "kf_ma");
  EXPECT_EQ(nearest_name("kf", names), "kf");
  EXPECT_EQ(nearest_name("kf", {}), "");
}

TEST(Registry, AnUnknownNameIsAnInputErrorThatNamesPlaceAndNearest) {
  try {
    (void)filter_types().named("sr_ufk", "study.json: filters[2]");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("study.json: filters[2]"),
                               testing::HasSubstr("'sr_ufk'"), testing::HasSubstr("'sr_ukf'")));
  }
}

TEST(Registry, GivesEachPluginByItsName) {
  for (const auto& id : filter_types().ids()) EXPECT_EQ(filter_types().named(id, "here").id, id);
}

}  // namespace
}  // namespace gyrostat::fields_test
