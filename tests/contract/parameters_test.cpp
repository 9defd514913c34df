#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/filters/list.hpp>
#include <gyrostat/generators/effect.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/acceleration/list.hpp>
#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::parameters_test {
namespace {

/// What `list`, JSON and the sensitivity bounds rely on, of every parameter struct.
template <class P>
void expect_well_described(const std::string& owner) {
  const P defaults;
  std::set<std::string_view> names;
  for (const auto& field : P::fields()) {
    const auto where = owner + "." + std::string(field.name);
    EXPECT_FALSE(field.name.empty()) << owner;
    EXPECT_TRUE(names.insert(field.name).second) << where << " stands twice";
    EXPECT_FALSE(field.unit.empty()) << where << " has no unit";
    EXPECT_FALSE(field.doc.empty()) << where << " has no description";
    EXPECT_LT(field.range.from, field.range.to) << where;
    EXPECT_TRUE(field.range.contains(defaults.*(field.member)))
        << where << " = " << defaults.*(field.member) << " is not in " << field.range.to_string();
  }
}

/// No two fields reach the same member.
template <class P>
void expect_one_member_a_field(const std::string& owner) {
  P p;
  const auto fields = P::fields();
  for (std::size_t i = 0; i < fields.size(); ++i) p.*(fields[i].member) = static_cast<double>(i);
  for (std::size_t i = 0; i < fields.size(); ++i)
    EXPECT_EQ(p.*(fields[i].member), static_cast<double>(i)) << owner << "." << fields[i].name;
}

template <class P>
void check(const std::string& owner) {
  expect_well_described<P>(owner);
  expect_one_member_a_field<P>(owner);
}

template <class List>
void check_plugins() {
  std::set<std::string> titles;
  List::for_each([&](auto plugin) {
    using Type = typename decltype(plugin)::type;
    check<Type>(std::string(plugin.id));
    EXPECT_TRUE(titles.insert(std::string(Type::title)).second)
        << plugin.id << ": title not unique";
    EXPECT_FALSE(Type::title.empty()) << plugin.id;
  });
}

TEST(ParameterContract, FiltersAreWellDescribed) {
  std::set<std::string> titles;
  Filters::for_each([&](auto plugin) {
    using F = typename decltype(plugin)::type;
    check<typename F::Parameters>(std::string(plugin.id));
    EXPECT_TRUE(titles.insert(std::string(F::title)).second) << plugin.id << ": title not unique";
  });
}

/// Calibration and study hand parameters over by name, so a name means one thing to all filters.
TEST(ParameterContract, AParameterOfOneNameHasOneUnitRangeAndMeaning) {
  std::map<std::string_view, std::array<std::string, 3>> known;
  for (const auto& filter : filter_types())
    for (const auto& field : filter.fields) {
      const std::array text = {std::string(field.unit), field.range.to_string(),
                               std::string(field.doc)};
      EXPECT_EQ(known.emplace(field.name, text).first->second, text)
          << filter.id << "." << field.name;
    }
}

TEST(ParameterContract, EffectsAreWellDescribed) { check_plugins<Effects>(); }
TEST(ParameterContract, TemperaturesAreWellDescribed) { check_plugins<Temperatures>(); }
TEST(ParameterContract, AccelerationsAreWellDescribed) { check_plugins<Accelerations>(); }
TEST(ParameterContract, MotionsAreWellDescribed) { check_plugins<Motions>(); }

TEST(ParameterContract, ScenarioPartsAreWellDescribed) {
  check<Sampling>("sampling");
  check<Arima111<double>>("random_error");
  check<ThermalDrift<double>>("thermal_drift");
  check<Compass>("compass");
  check<MagneticDisturbance>("disturbance");
}

TEST(ParameterContract, MetricsHaveTitleAndUnit) {
  std::set<std::string> titles;
  for (const auto& metric : metric_types()) {
    EXPECT_FALSE(metric.unit.empty()) << metric.id;
    EXPECT_TRUE(titles.insert(metric.title).second) << metric.id;
  }
}

TEST(ParameterContract, IdsAreUniqueAndReadAsFileStems) {
  for (const auto& ids : {filter_types().ids(), effect_types().ids(), temperature_types().ids(),
                          motion_types().ids(), acceleration_types().ids(), metric_types().ids()}) {
    EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
    for (const auto& id : ids)
      EXPECT_EQ(id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos);
  }
}

}  // namespace
}  // namespace gyrostat::parameters_test
