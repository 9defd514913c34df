#include <gyrostat/diagnosis/compare/comparison.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/compare/differences.hpp>
#include <gyrostat/diagnosis/compare/matched.hpp>
#include <gyrostat/diagnosis/compare/segmented_sides.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {
namespace {

void append(const Addition& more, Addition& to) {
  to.white_std_dps = std::hypot(to.white_std_dps, more.white_std_dps);
  to.walk_dps_per_sqrt_s = std::hypot(to.walk_dps_per_sqrt_s, more.walk_dps_per_sqrt_s);
  to.effects.insert(to.effects.end(), more.effects.begin(), more.effects.end());
}

class Comparing {
 public:
  Comparing(const std::vector<NamedSeries>& recordings, const std::vector<NamedSeries>& simulated,
            const ComparisonOptions& options, const DiagnosisProgress& progress,
            const Interrupt& interrupt)
      : recordings_(recordings),
        simulated_(simulated),
        options_(options),
        progress_(progress),
        interrupt_(interrupt) {}

  Comparison run();

 private:
  void tell(const std::string& phase, double share, const std::string& detail = {}) {
    interrupt_.check();
    share_ = std::max(share_, share);
    if (progress_) progress_({phase, detail, share_});
  }
  void find_sets(const Matched& matched);
  /// What each difference closes, alone and after those that close more.
  void mend(const SegmentedSides& sides);
  void judge();

  double level() const { return 0.5 * options_.significance; }
  bool segments_differ() const { return result_.p_before <= level(); }
  double closed(double gap_after) const {
    return result_.gap_before > 0.0 ? 1.0 - gap_after / result_.gap_before : 0.0;
  }

  const std::vector<NamedSeries>& recordings_;
  const std::vector<NamedSeries>& simulated_;
  const ComparisonOptions& options_;
  const DiagnosisProgress& progress_;
  const Interrupt& interrupt_;
  StudiedSide real_, sim_;
  Comparison result_;
  double share_ = 0.0;
};

void Comparing::find_sets(const Matched& matched) {
  const auto traces = static_cast<double>(recordings_.size() + simulated_.size());
  double done = 0.0;
  for (const auto* side : {&recordings_, &simulated_}) {
    auto& studied = side == &recordings_ ? real_ : sim_;
    studied.name = side->front().name;
    for (const auto& trace : *side) {
      studied.traces.push_back(std::make_unique<TraceStudy>(
          trace.series, options_.seed, matched.without, interrupt_,
          [&](const std::string& what, double share) {
            tell("looking for effects", 0.5 * (done + share) / traces, trace.name + ", " + what);
          }));
      done += 1.0;
    }
  }
  result_.in_recording = real_.names();
  result_.in_simulator = sim_.names();
}

void Comparing::mend(const SegmentedSides& sides) {
  result_.gap_before = result_.gap_after = sides.gap();
  auto& differences = result_.differences;
  for (auto& difference : differences) {
    tell("adding each effect", 0.9, difference.effect);
    difference.gap_after =
        difference.addition.is_nothing() ? result_.gap_before : sides.gap(difference.addition);
    difference.closed = closed(difference.gap_after);
  }
  std::stable_sort(differences.begin(), differences.end(), [](const auto& a, const auto& b) {
    return a.closed != b.closed ? a.closed > b.closed : a.log_odds > b.log_odds;
  });
  result_.enrichments.push_back({"", result_.gap_before});
  for (const auto& difference : differences) {
    if (difference.addition.is_nothing()) continue;
    tell("adding one effect after another", 0.94, difference.effect);
    append(difference.addition, result_.addition);
    result_.enrichments.push_back({difference.effect, sides.gap(result_.addition)});
  }
  result_.bands = sides.bands(result_.addition);
  if (result_.addition.is_nothing()) return;
  result_.gap_after = result_.enrichments.back().gap;
  result_.closed = closed(result_.gap_after);
  const auto interval = sides.closed(result_.addition);
  result_.closed_low = std::min(interval[0], result_.closed);
  result_.closed_high = std::max(interval[1], result_.closed);
  const auto after = sides.test(result_.addition);
  result_.p_after = after.p;
  result_.where_after = sides.departures(after);
  for (std::size_t k = 0; k < sim_.traces.size(); ++k)
    result_.with_added.push_back(sides.mended(k, result_.addition));
}

void Comparing::judge() {
  const auto& differences = result_.differences;
  if (differences.empty()) {
    if (segments_differ()) {
      result_.verdict = Verdict::unknown();
      result_.verdict_set = {Verdict::unknown()};
    }
    return;
  }
  const bool mendable = std::none_of(differences.begin(), differences.end(),
                                     [](const auto& d) { return d.addition.is_nothing(); });
  const bool unexplained = segments_differ() && mendable && result_.p_after <= level() &&
                           result_.closed < thresholds::recovery;
  result_.verdict = unexplained ? Verdict::unknown() : Verdict::cause(differences.front().effect);
  if (unexplained) result_.verdict_set.push_back(Verdict::unknown());
  for (const auto& difference : differences)
    result_.verdict_set.push_back(Verdict::cause(difference.effect));
}

Comparison Comparing::run() {
  auto matched = match(recordings_, simulated_, options_.without);
  result_.real_traces = recordings_.size();
  result_.simulated_traces = simulated_.size();
  result_.rate_hz = matched.rate_hz;
  result_.segment_s = matched.segment_s();
  result_.not_assessable = matched.not_assessable;
  find_sets(matched);

  tell("reading segments", 0.52);
  const SegmentedSides sides(real_, sim_, matched, options_.seed);
  result_.segments_real = sides.real_count();
  result_.segments_simulated = sides.simulated_count();
  tell("comparing segments", 0.56);
  const auto test = sides.test();
  result_.p_before = result_.p_after = test.p;
  result_.where = result_.where_after = sides.departures(test);
  tell("simulating the power of the test", 0.6);
  result_.power = sides.power(level());

  auto differences = differences_between(real_, sim_, matched,
                                         {.seed = options_.seed,
                                          .level = level(),
                                          .segments_differ = segments_differ(),
                                          .interrupt = interrupt_,
                                          .progress = [&](const std::string& effect, double share) {
                                            tell("comparing effects", 0.65 + 0.2 * share, effect);
                                          }});
  result_.differences = std::move(differences.found);
  result_.undecided = std::move(differences.undecided);
  mend(sides);
  judge();
  tell("done", 1.0);
  return std::move(result_);
}

}  // namespace

std::string_view name_of(Differs how) {
  switch (how) {
    case Differs::lacks:
      return "lacks";
    case Differs::too_little:
      return "too_little";
    case Differs::too_much:
      return "too_much";
    case Differs::other_form:
      return "other_form";
  }
  return "";
}

Comparison compare(const std::vector<NamedSeries>& recordings,
                   const std::vector<NamedSeries>& simulated, const ComparisonOptions& options,
                   const DiagnosisProgress& progress, const Interrupt& interrupt) {
  return Comparing(recordings, simulated, options, progress, interrupt).run();
}

}  // namespace gyrostat::gap
