// The pictures of a diagnosis made by hand.

#include <gyrostat/experiments/findings/diagnosis_pictures.hpp>
#include <gyrostat/experiments/findings/lens_pictures.hpp>

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include <gyrostat/experiments/findings/diagnosis_page.hpp>

namespace gyrostat::gap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Band band(const std::string& lens, const std::string& unit) {
  return {.lens = lens,
          .title = lens,
          .channel = "gyro_dps",
          .coordinate = "tau_s",
          .unit = unit,
          .at = {0.01, 0.1},
          .observed = {std::log(0.04), std::log(0.01)},
          .before = {std::log(0.09), std::log(0.01)},
          .before_spread = {0.1, 0.1},
          .after = {std::log(0.04), std::log(0.01)},
          .after_spread = {0.1, 0.1}};
}

Where off(const std::string& lens, double p) {
  return {lens, "gyro_dps", "tau_s", "ln(dps²)", 0.01, 0.01, std::log(0.04), std::log(0.09), p};
}

Diagnosis half_closed() {
  Diagnosis d;
  d.gap_before = 4.0;
  d.gap_after = 1.0;
  d.closed = 0.75;
  d.enrichments = {{"", 4.0}, {"vibration", 2.0}, {"quantization", 1.0}};
  d.bands = {band("calm", "ln(dps²)"), band("mended", "ln(dps²)"), band("allan", "ln(dps²)"),
             band("worse", "ln(dps²)")};
  d.where = {off("mended", 1e-9), off("allan", 1e-3), off("worse", 1e-9)};
  d.where_after = {off("allan", 1e-3), off("worse", 1e-9)};
  d.portrait.spectrum = {{1.0, 10.0}, {0.1, 0.2}, {0.1, 0.1}, {0.1, 0.2}};
  d.transfer = {{"kf", "innovation_std", "dps", 1.0, 2.0, 1.1, Moved::closer},
                {"stf", "innovation_std", "dps", 1.0, 2.0, 3.0, Moved::away},
                {"kf", "nis", "1", 1.0, 2.0, 1.0, Moved::closer}};
  Effect vibration(effect_types().named("vibration", "test"));
  d.enriched.effects = {vibration};
  return d;
}

TEST(DiagnosisPictures, AWaterfallGoesFromTheGapToTheRemainder) {
  const auto picture = waterfall_picture(half_closed());
  EXPECT_THAT(picture.y.names,
              ElementsAre("simulator as it stands", "with vibration", "with quantization", "left"));
  std::vector<double> from, to;
  for (const auto& mark : picture.marks) {
    from.push_back(mark.from.front());
    to.push_back(mark.x.front());
  }
  EXPECT_THAT(from, ElementsAre(0.0, 100.0, 50.0, 0.0));
  EXPECT_THAT(to, ElementsAre(100.0, 50.0, 25.0, 25.0));
  EXPECT_EQ(picture.x.unit, "%");
  EXPECT_TRUE(waterfall_picture(Diagnosis{}).marks.empty());
}

TEST(DiagnosisPictures, LensesThatAreStillOffComeFirst) {
  std::vector<std::string> order;
  for (const auto& lens : lens_pictures(half_closed())) order.push_back(lens.picture.title);
  EXPECT_THAT(order, ElementsAre("✗ Worse", "✗ Allan", "✓ Mended", "Calm"));
  EXPECT_THAT(lens_pictures(half_closed()).front().picture.note,
              HasSubstr("Still off: at averaging time τ = 0.01 s the recording has 0.2 dps, the "
                        "simulator 0.3 dps"));
}

TEST(DiagnosisPictures, WhatIsOffWhereItWasHeldBackIsNotMended) {
  auto d = half_closed();
  auto& band = d.bands[1];
  band.observed.back() = band.after.back() + 6.0 * band.after_spread.back();
  const auto all = lens_pictures(d);
  const auto mended = std::find_if(all.begin(), all.end(), [](const auto& lens) {
    return lens.picture.title.ends_with("Mended");
  });
  EXPECT_EQ(mended->picture.title, "✗ Mended");
  EXPECT_THAT(mended->picture.note, HasSubstr("Still off where it was held back."));
}

TEST(DiagnosisPictures, NoiseIsInPhysicalUnitsOnLogarithmicAxes) {
  const auto pictures = noise_pictures(half_closed());
  ASSERT_EQ(pictures.size(), 2U);
  for (const auto& picture : pictures) {
    EXPECT_TRUE(picture.x.logarithmic) << picture.id;
    EXPECT_TRUE(picture.y.logarithmic) << picture.id;
  }
  EXPECT_EQ(pictures[0].y.unit, "dps");
  EXPECT_NEAR(pictures[0].marks.back().y.front(), 0.2, 1e-12);
  EXPECT_EQ(pictures[1].y.unit, "dps/√Hz");
  EXPECT_THAT(pictures[1].marks.back().name, HasSubstr("vibration, 10 Hz"));
}

TEST(DiagnosisPictures, AMetricThatMovedAwayIsMarked) {
  const auto pictures = filter_pictures(half_closed());
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_THAT(pictures[0].y.names, ElementsAre("kf", "stf"));
  EXPECT_THAT(pictures[0].marks[1].labels, ElementsAre("", "away"));
}

TEST(DiagnosisPage, BeginsWithTheAnswerAndKeepsJargonForTheEnd) {
  auto d = half_closed();
  d.verdict = Verdict::cause("vibration");
  d.effects.push_back({.effect = "vibration", .parameters = d.enriched.effects});
  const auto page = diagnosis_page(d, "rec.csv, axis z");
  const auto answer = page.find("class=\"answer\"");
  ASSERT_NE(answer, std::string::npos);
  EXPECT_LT(page.find("<h1>rec.csv, axis z</h1>"), answer);
  EXPECT_LT(answer, page.find("<figure"));
  const auto details = page.find("How sure that is");
  for (const char* jargon : {"spreads", "[nat]", "recovers"}) {
    const auto first = page.find(jargon, answer);
    EXPECT_TRUE(first == std::string::npos || first > details) << jargon;
  }
}

}  // namespace
}  // namespace gyrostat::gap
