// What the catalogue of causes owes to the effects, and they to it.

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/evidence.hpp>
#include <gyrostat/diagnosis/likelihood/beside.hpp>
#include <gyrostat/diagnosis/model_fit.hpp>
#include <gyrostat/diagnosis/starts/signature.hpp>
#include <gyrostat/generators/effects/list.hpp>
#include <gyrostat/generators/environment/acceleration/list.hpp>
#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>

namespace gyrostat::gap {

/// Effects whose diagnosis forgets one thing each.
struct Whole {};
struct WithoutSignature {};
struct WithoutFreeParameters {};
struct WithoutStarts {};
struct WithoutNeeds {};
struct WithoutPlausibility {};
struct WithoutAnything {};

template <class E>
struct SaysSignature {
  static constexpr auto signature = Signature::repeated;
};
template <class E>
struct SaysFree {
  static constexpr std::array<double E::*, 0> free_parameters = {};
};
template <class E>
struct SaysStarts {
  static std::vector<E> starts(const Evidence&);
};
template <class E>
struct SaysNeeds {
  static std::string why_not_assessable(const Conditions&);
};
template <class E>
struct SaysPlausible {
  static bool is_what_it_is_called(const E&, const Conditions&);
};
template <class E, template <class> class... Says>
struct All : Says<E>... {};

template <>
struct Diagnosed<Whole>
    : All<Whole, SaysSignature, SaysFree, SaysStarts, SaysNeeds, SaysPlausible> {};
template <>
struct Diagnosed<WithoutSignature>
    : All<WithoutSignature, SaysFree, SaysStarts, SaysNeeds, SaysPlausible> {};
template <>
struct Diagnosed<WithoutFreeParameters>
    : All<WithoutFreeParameters, SaysSignature, SaysStarts, SaysNeeds, SaysPlausible> {};
template <>
struct Diagnosed<WithoutStarts>
    : All<WithoutStarts, SaysSignature, SaysFree, SaysNeeds, SaysPlausible> {};
template <>
struct Diagnosed<WithoutNeeds>
    : All<WithoutNeeds, SaysSignature, SaysFree, SaysStarts, SaysPlausible> {};
template <>
struct Diagnosed<WithoutPlausibility>
    : All<WithoutPlausibility, SaysSignature, SaysFree, SaysStarts, SaysNeeds> {};

static_assert(Diagnosable<Whole>);
static_assert(!SaysItsSignature<WithoutSignature> && !Diagnosable<WithoutSignature>);
static_assert(!SaysItsFreeParameters<WithoutFreeParameters> && !Diagnosable<WithoutFreeParameters>);
static_assert(!SaysHowItStarts<WithoutStarts> && !Diagnosable<WithoutStarts>);
static_assert(!SaysWhatItNeeds<WithoutNeeds> && !Diagnosable<WithoutNeeds>);
static_assert(!SaysWhatIsPlausible<WithoutPlausibility> && !Diagnosable<WithoutPlausibility>);
static_assert(!Diagnosable<WithoutAnything>);

namespace {

using testing::Contains;

/// Warm, turning about all axes and tilting, with a compass.
Series rich_recording() {
  Scenario s;
  s.sampling = {.duration_s = 1200.0, .rate_hz = 10.0};
  s.temperature = temperature::Cycle{.low_C = 20.0, .high_C = 60.0, .period_s = 400.0};
  s.motion = motion::Sinusoidal{80.0, 0.031};
  s.cross_motion_1 = motion::Sinusoidal{30.0, 0.07};
  s.cross_motion_2 = motion::Sinusoidal{20.0, 0.023};
  s.acceleration = acceleration::Tilting{};
  Series series;
  synthesise(s, {3, 0}, series);
  return series;
}

/// What a room that is still and warm records in a minute.
Series poor_recording() {
  Scenario s;
  s.sampling = {.duration_s = 60.0, .rate_hz = 20.0};
  s.temperature = temperature::QuietRoom{.start_C = 25.0, .end_C = 25.5};
  Series series;
  synthesise(s, {3, 0}, series);
  series.rate_ref_dps.clear();
  series.heading_deg.clear();
  return series;
}

TEST(CatalogueContract, EveryEffectOfOursIsInItUnderItsName) {
  std::vector<std::string> effects;
  Effects::for_each([&]<class Entry>(Entry) { effects.emplace_back(Entry::id); });
  // What a recording shows without a cause is none.
  std::erase_if(effects, [](const auto& id) { return id.starts_with("empirical_"); });
  EXPECT_EQ(cause_types().ids(), effects);
  for (const auto& cause : cause_types()) EXPECT_EQ(cause.effect().id(), cause.id);
}

TEST(CatalogueContract, FreeParametersAreTheEffectsOwn) {
  for (const auto& cause : cause_types()) {
    std::vector<std::string_view> names;
    for (const auto& field : cause.effect().fields()) names.push_back(field.name);
    for (const auto& free : cause.free_parameters) EXPECT_THAT(names, Contains(free)) << cause.id;
  }
}

TEST(CatalogueContract, WhatARecordingLacksIsSaidWhereItIsLacking) {
  const Conditions rich(rich_recording()), poor(poor_recording());
  for (const auto& cause : cause_types()) {
    EXPECT_EQ(cause.why_not_assessable(rich), "") << cause.id;
    const auto needs = [&](const auto channel) {
      const auto& all = cause.effect().type().needs;
      return std::find(all.begin(), all.end(), channel) != all.end();
    };
    if (needs(&Series::heading_deg) || needs(&Series::acc_x_mps2) ||
        needs(&Series::cross_rate_1_dps)) {
      EXPECT_NE(cause.why_not_assessable(poor), "") << cause.id;
    }
  }
}

void expect_sound(const CauseType& cause, const Effect& effect) {
  EXPECT_EQ(effect.id(), cause.id);
  for (std::size_t f = 0; f < effect.fields().size(); ++f)
    EXPECT_TRUE(std::isfinite(effect.value(f))) << cause.id << "." << effect.fields()[f].name;
}

TEST(CatalogueContract, StartsAreTheEffectWithSoundParameters) {
  const Series recording = rich_recording();
  const Simulator simulator(recording, 1);
  const auto& conditions = simulator.conditions();
  const auto baseline = fit_baseline(simulator, recording).scenario;
  Evidence evidence{simulator, recording, Scene(conditions, recording), baseline};
  for (const auto trace : {Trace::rate, Trace::heading}) take_undisturbed(evidence, trace);
  const SetFitter fitter(conditions, std::make_shared<const ReducedRate>(
                                         conditions, evidence.scene.rate_error_dps,
                                         std::make_shared<const RateGrid>(
                                             conditions, std::vector<char>(recording.size(), 0))));
  SetFit fit;
  fit.scenario = baseline;
  const Beside beside{conditions, fitter, fit};
  for (const auto& cause : cause_types()) {
    EXPECT_FALSE(cause.starts != nullptr && cause.guesses != nullptr) << cause.id;
    if (cause.starts != nullptr)
      for (const auto& start : cause.starts(evidence)) expect_sound(cause, start);
    if (cause.guesses == nullptr) continue;
    EXPECT_TRUE(cause.enter != nullptr || cause.signature == Signature::slow) << cause.id;
    for (const auto& guess : cause.guesses(beside)) expect_sound(cause, guess);
  }
}

}  // namespace
}  // namespace gyrostat::gap
