// What a diagnosis says in words, of diagnoses made by hand.

#include <gyrostat/diagnosis/answer.hpp>

#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/diagnosis/diagnosis_tables.hpp>
#include <gyrostat/diagnosis/physical.hpp>

namespace gyrostat::gap {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Diagnosis with_two_effects() {
  Diagnosis d;
  d.duration_s = 3600.0;
  d.rate_hz = 100.0;
  d.gap_before = 4.0;
  d.gap_after = 1.0;
  d.closed = 0.75;
  d.closed_low = 0.6;
  d.closed_high = 0.8;
  d.verdict = Verdict::cause("vibration");
  for (const char* name : {"vibration", "quantization"}) {
    Included found;
    found.effect = name;
    found.inclusion = 0.99;
    found.parameters = {Effect(effect_types().named(name, "test"))};
    d.effects.push_back(found);
  }
  d.verdict_set = {Verdict::cause("vibration"), Verdict::cause("quantization")};
  d.enrichments = {{"", 4.0}, {"vibration", 2.0}, {"quantization", 1.0}};
  d.transfer = {{"kf", "nis", "1", 1.0, 2.0, 1.1, Moved::closer},
                {"kf", "innovation_std", "dps", 1.0, 2.0, 3.0, Moved::away},
                {"stf", "nis", "1", 1.0, 2.0, 2.0, Moved::nowhere}};
  return d;
}

TEST(Answer, IsPlainAndFirst) {
  const auto text = answer(with_two_effects());
  EXPECT_THAT(text, AllOf(HasSubstr("vibration (narrow-band random vibration)"),
                          HasSubstr("quantization (values lie on a grid)"), HasSubstr("75 %")));
  for (const char* jargon : {"spreads", "nat", "recovers", "p = ", "held-out"})
    EXPECT_THAT(text, Not(HasSubstr(jargon)));
}

TEST(Answer, SaysWhatNothingExplains) {
  auto d = with_two_effects();
  d.verdict = Verdict::unknown();
  EXPECT_THAT(answer(d), AllOf(HasSubstr("no effect of the catalogue explains"),
                               HasSubstr("Nearest: vibration")));
  d.effects.clear();
  EXPECT_THAT(answer(d), Not(HasSubstr("Nearest")));
  d.verdict = Verdict::none();
  EXPECT_EQ(answer(d), "The simulator already makes recordings like this one.");
}

TEST(Answer, SaysWhenItDidWhatItNeverDidBefore) {
  auto d = with_two_effects();
  EXPECT_EQ(transient_in_words(d), "");
  d.transient = {
      .from_s = 54.8, .to_s = 55.3, .frequency_hz = 54.375, .rms_dps = 0.1104, .p_value = 2e-13};
  EXPECT_THAT(transient_in_words(d), AllOf(HasSubstr("Between 54.80 and 55.30 s"),
                                           HasSubstr("54.4 Hz"), HasSubstr("0.11 dps rms")));
  EXPECT_THAT(in_words(d, "a.csv"), HasSubstr(transient_in_words(d)));
}

TEST(Answer, SaysWhereNamesLeaveMoreThanChance) {
  auto d = with_two_effects();
  EXPECT_THAT(answer(d), Not(HasSubstr("besides or instead")));
  d.unexplained = {{"time", 0.3}, {"spectrum", 0.01}};
  EXPECT_THAT(answer(d), Not(HasSubstr("besides or instead")));
  d.unexplained.back().p_value = 0.001;
  EXPECT_THAT(answer(d), HasSubstr("still misses the recording by more than chance"));
  d.unexplained.clear();
  d.p_after = 0.001;
  EXPECT_THAT(answer(d), HasSubstr("still misses the recording by more than chance"));
}

TEST(Answer, SaysWhatTheNextRecordingWouldTell) {
  auto d = with_two_effects();
  d.next = {.what = "a night at rest",
            .first = "vibration",
            .second = "sinusoidal",
            .expected_power = 0.9};
  EXPECT_THAT(next_in_words(d), HasSubstr("To tell vibration from sinusoidal: a night at rest"));
  d.next.first = "none";
  EXPECT_THAT(next_in_words(d), HasSubstr("To tell whether sinusoidal is there: a night at rest"));
  d.next.expected_power = 0.6;
  EXPECT_THAT(next_in_words(d), HasSubstr("tells whether sinusoidal is there; the best, a night"));
}

TEST(Answer, NothingCloserIsNotCalledCloser) {
  auto d = with_two_effects();
  d.closed = -0.2;
  EXPECT_THAT(answer(d), AllOf(HasSubstr("no closer"), Not(HasSubstr("%"))));
}

TEST(Answer, CountsWhatMovedAway) {
  EXPECT_EQ(transfer_in_words(with_two_effects()),
            "Of 3 numbers that the filters show, 1 comes nearer to the recording, 1 moves away "
            "and 1 stays as it was.");
  auto d = with_two_effects();
  d.transfer = {d.transfer[0], d.transfer[0], d.transfer[1], d.transfer[1]};
  EXPECT_EQ(transfer_in_words(d),
            "Of 4 numbers that the filters show, 2 come nearer to the recording, 2 move away and "
            "0 stay as they were.");
  d.enrichments.resize(1);
  EXPECT_EQ(transfer_in_words(d), "");
}

// An effect's inclusion and the posterior of a cause differ where the set leaves something open.
TEST(Answer, EachProbabilityHasItsName) {
  auto d = with_two_effects();
  d.causes.resize(1);
  d.causes[0].scenario.effects = d.effects[0].parameters;
  EXPECT_THAT(evidence_in_words(d), HasSubstr("Inclusion probability: vibration 0.99"));
  for (const auto& table : diagnosis_tables(d, "r"))
    for (const auto& column : table.columns) EXPECT_NE(column.name, "probability");
  EXPECT_EQ(diagnosis_tables(d, "r").front().columns[1].name, "posterior probability");
}

TEST(Answer, ReadingsAreToldInTheirUnits) {
  const Physical deviation("ln(dps²)"), density("ln(dps²/Hz)"), ratio("ln(1)"), plain("deg");
  EXPECT_EQ(deviation.unit, "dps");
  EXPECT_NEAR(deviation(std::log(0.01)), 0.1, 1e-12);
  EXPECT_EQ(density.unit, "dps/√Hz");
  EXPECT_NEAR(density(std::log(0.04)), 0.2, 1e-12);
  EXPECT_EQ(ratio.unit, "1");
  EXPECT_NEAR(ratio(std::log(3.0)), 3.0, 1e-12);
  EXPECT_EQ(plain.unit, "deg");
  EXPECT_EQ(plain(-0.5), -0.5);
}

}  // namespace
}  // namespace gyrostat::gap
