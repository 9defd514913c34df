#include <gyrostat/diagnosis/compare/comparison.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/error.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/compare/segments.hpp>
#include <gyrostat/diagnosis/compare/trace_study.hpp>
#include <gyrostat/diagnosis/compare/two_samples.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_to_compare = 4096;
constexpr double most_apart = 0.01;  ///< rates of sampling
/// A held-out part is read in so many pieces, so that their spread is known.
constexpr std::size_t pieces_of_a_part = 4;
/// Differences that are clear and matter to nobody: of white noise, of the walk, of an effect.
constexpr double least_of_white = 0.03, least_of_walk = 0.25, least_of_effect = 0.05;

using Studies = std::vector<std::unique_ptr<TraceStudy>>;

/// What one side of the comparison shows of an effect.
struct Found {
  std::vector<Effect> effects;
  double log_odds = 0.0;
};

/// In at least half of the traces; the parameters are those of the trace that shows it best.
Found found_in(const Studies& side, std::string_view name) {
  Found found;
  double best = -1.0;
  std::size_t traces = 0;
  for (const auto& study : side) {
    const auto effects = study->effects(name);
    if (effects.empty()) continue;
    ++traces;
    const double odds = study->log_odds(name);
    found.log_odds += odds;
    if (odds > best) best = odds, found.effects = effects;
  }
  if (2 * traces < side.size()) return {};
  return found;
}

std::vector<std::string> names_in(const Studies& side) {
  std::vector<std::string> names;
  for (const auto& cause : cause_types())
    if (!found_in(side, cause.id).effects.empty()) names.emplace_back(cause.id);
  return names;
}

/// The size that an effect is known by: of what it has in dps, the largest.
double size_of(const std::vector<Effect>& effects) {
  double size = 0.0;
  for (const auto& effect : effects)
    for (std::size_t i = 0; i < effect.fields().size(); ++i)
      if (effect.fields()[i].unit == "dps") size = std::max(size, std::abs(effect.value(i)));
  return size;
}

bool differ_enough(const std::vector<Effect>& a, const std::vector<Effect>& b) {
  if (a.size() != b.size()) return true;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].fields().size(); ++i) {
      const double x = a[k].value(i), y = b[k].value(i);
      if (std::abs(x - y) > least_of_effect * std::max(std::abs(x), std::abs(y))) return true;
    }
  return false;
}

Eigen::MatrixXd readings_of(const SegmentReader& reader,
                            const std::vector<std::vector<double>>& segments) {
  Eigen::MatrixXd all(reader.instrument().size(), static_cast<Eigen::Index>(segments.size()));
  tbb::parallel_for(std::size_t{0}, segments.size(), [&](std::size_t k) {
    all.col(static_cast<Eigen::Index>(k)) = reader.read(segments[k]);
  });
  return all;
}

class Comparing {
 public:
  Comparing(const std::vector<Trace>& recordings, const std::vector<Trace>& simulated,
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
  void match();
  void find_sets();
  void read_segments();
  void test_segments();
  void say_the_power();
  void compare_sets();
  void compare_noise();
  void keep(Difference difference, double loss_real, double loss_simulated, double parameters);
  /// Log odds with which the traces of a side would show these effects, had they been added.
  double would_show(const Studies& side, std::string_view name, const std::vector<Effect>& effects);
  void judge();

  /// All segments of a side; of what is added to simulated traces, where `addition` says so.
  std::vector<std::vector<double>> segments(const Studies& side, Part part, std::size_t samples,
                                            const Addition* addition = nullptr) const;
  Series mended(std::size_t trace, const Addition& addition) const;

  const std::vector<Trace>& recordings_;
  const std::vector<Trace>& simulated_;
  const ComparisonOptions& options_;
  const DiagnosisProgress& progress_;
  const Interrupt& interrupt_;
  std::vector<std::string> without_;
  Studies real_, sim_;
  std::size_t segment_ = 0, piece_ = 0;
  double resolution_dps_ = 0.0;
  std::unique_ptr<SegmentReader> whole_, pieces_;
  Eigen::MatrixXd real_segments_, sim_segments_, real_pieces_, sim_pieces_;
  double compared_ = 1.0;
  Comparison result_;
  double share_ = 0.0;
};

void Comparing::match() {
  if (recordings_.empty()) throw InputError("recordings", "there are none");
  if (simulated_.empty()) throw InputError("--simulated", "there are no traces");
  const Trace& first = recordings_.front();
  result_.rate_hz = first.series.rate_hz();
  std::size_t shortest = first.series.size();
  for (const auto* side : {&recordings_, &simulated_})
    for (const auto& trace : *side) {
      if (trace.series.size() < fewest_to_compare)
        throw InputError(trace.name, fmt::format("{} samples; at least {} are needed to compare a "
                                                 "simulator with a recording",
                                                 trace.series.size(), fewest_to_compare));
      const double rate = trace.series.rate_hz();
      if (std::abs(rate / result_.rate_hz - 1.0) > most_apart)
        throw InputError(
            trace.name,
            fmt::format("sampled at {:.6g} Hz, {} at {:.6g} Hz; simulate at the rate of "
                        "the recording (within 1 %), since a filter between rates would "
                        "pass for an effect",
                        rate, first.name, result_.rate_hz));
      const auto& z = trace.series.gyro_dps;
      const auto there = std::find_if(z.begin(), z.end(), [](double v) { return !is_missing(v); });
      if (std::all_of(there, z.end(), [&](double v) { return is_missing(v) || v == *there; }))
        throw InputError(trace.name, "gyro_dps never changes; there is nothing to compare");
      shortest = std::min(shortest, trace.series.size());
    }
  segment_ = shortest / Conditions::blocks;
  result_.real_traces = recordings_.size();
  result_.simulated_traces = simulated_.size();
  without_ = options_.without;
  for (const auto* side : {&recordings_, &simulated_})
    for (const auto& trace : *side) {
      const Conditions conditions(trace.series);
      segment_ = std::min(segment_, longest_segment(conditions));
      for (const auto& cause : cause_types()) {
        if (std::find(without_.begin(), without_.end(), cause.id) != without_.end()) continue;
        if (auto why = cause.why_not_assessable(conditions); !why.empty()) {
          without_.emplace_back(cause.id);
          result_.not_assessable.push_back({std::string(cause.id), trace.name + ": " + why});
        }
      }
    }
  constexpr std::size_t held_out_blocks = 2;
  piece_ = held_out_blocks * segment_ / pieces_of_a_part;
  result_.segment_s = static_cast<double>(segment_) / result_.rate_hz;
  compared_ = std::max(
      1.0, static_cast<double>(cause_types().size()) - static_cast<double>(without_.size()) + 2.0);
}

void Comparing::find_sets() {
  const auto traces = static_cast<double>(recordings_.size() + simulated_.size());
  double done = 0.0;
  for (const auto* side : {&recordings_, &simulated_})
    for (const auto& trace : *side) {
      auto& studies = side == &recordings_ ? real_ : sim_;
      studies.push_back(std::make_unique<TraceStudy>(
          trace.series, options_.seed, without_, interrupt_,
          [&](const std::string& what, double share) {
            tell("looking for effects", 0.5 * (done + share) / traces, trace.name + ", " + what);
          }));
      resolution_dps_ = std::max(resolution_dps_, studies.back()->resolution_dps());
      done += 1.0;
    }
  result_.in_recording = names_in(real_);
  result_.in_simulator = names_in(sim_);
}

Series Comparing::mended(std::size_t trace, const Addition& addition) const {
  return sim_[trace]->mended(addition, {options_.seed, static_cast<std::uint32_t>(trace)});
}

std::vector<std::vector<double>> Comparing::segments(const Studies& side, Part part,
                                                     std::size_t samples,
                                                     const Addition* addition) const {
  std::vector<std::vector<double>> all;
  for (std::size_t k = 0; k < side.size(); ++k) {
    const auto& study = *side[k];
    const bool adds = addition != nullptr && !addition->is_nothing();
    const auto error = study.error_dps(
        adds ? mended(k, *addition).gyro_dps : study.series().gyro_dps, resolution_dps_);
    for (auto& segment : segments_of(study.conditions(), error, part, samples))
      all.push_back(std::move(segment));
  }
  return all;
}

void Comparing::read_segments() {
  tell("reading segments", 0.52);
  whole_ = std::make_unique<SegmentReader>(result_.rate_hz, segment_);
  pieces_ = std::make_unique<SegmentReader>(result_.rate_hz, piece_);
  real_segments_ = readings_of(*whole_, segments(real_, Part::train, segment_));
  sim_segments_ = readings_of(*whole_, segments(sim_, Part::train, segment_));
  real_pieces_ = readings_of(*pieces_, segments(real_, Part::held_out, piece_));
  sim_pieces_ = readings_of(*pieces_, segments(sim_, Part::held_out, piece_));
  result_.segments_real = static_cast<std::size_t>(real_segments_.cols());
  result_.segments_simulated = static_cast<std::size_t>(sim_segments_.cols());
  constexpr Eigen::Index fewest = 3;
  if (std::min({real_segments_.cols(), sim_segments_.cols(), real_pieces_.cols(),
                sim_pieces_.cols()}) < fewest)
    throw InputError((real_segments_.cols() < fewest ? recordings_ : simulated_).front().name,
                     "too many samples are missing to cut it into segments");
}

void Comparing::test_segments() {
  tell("comparing segments", 0.56);
  const auto& instrument = whole_->instrument();
  const auto test = two_samples(instrument, real_segments_, sim_segments_, options_.seed);
  result_.p_before = result_.p_after = test.p;
  for (const auto& lens : instrument.lenses())
    for (Eigen::Index i = lens.first; i < lens.first + lens.count; ++i) {
      if (test.p_adjusted[i] > thresholds::departure) continue;
      const auto& at = instrument.at()[static_cast<std::size_t>(i)];
      result_.where.push_back({std::string(lens.id), std::string(lens.channel),
                               std::string(lens.coordinate), std::string(lens.unit), at.from, at.to,
                               test.real[i], test.simulated[i], test.p_adjusted[i]});
    }
}

void Comparing::say_the_power() {
  tell("simulating the power of the test", 0.6);
  auto all = segments(real_, Part::train, segment_);
  for (auto& segment : segments(sim_, Part::train, segment_)) all.push_back(std::move(segment));
  Eigen::MatrixXd plain(real_segments_.rows(), real_segments_.cols() + sim_segments_.cols());
  plain << real_segments_, sim_segments_;
  for (const double louder : {0.02, 0.05, 0.1, 0.2, 0.5}) {
    auto scaled = all;
    for (auto& segment : scaled) {
      const double mean = std::accumulate(segment.begin(), segment.end(), 0.0) /
                          static_cast<double>(segment.size());
      for (double& value : segment) value = mean + (1.0 + louder) * (value - mean);
    }
    result_.power.push_back(
        {louder,
         power_of_two_samples(whole_->instrument(), plain, readings_of(*whole_, scaled),
                              real_segments_.cols(), 0.5 * options_.significance, options_.seed)});
  }
}

double Comparing::would_show(const Studies& side, std::string_view name,
                             const std::vector<Effect>& effects) {
  double odds = 0.0;
  for (std::size_t k = 0; k < side.size(); ++k) {
    const auto& study = *side[k];
    const auto with =
        study.mended({.effects = effects}, {options_.seed, static_cast<std::uint32_t>(k)});
    const TraceStudy shown(with, options_.seed, without_, interrupt_, {});
    odds += shown.log_odds(name);
  }
  return odds;
}

/// The common form costs least where it lies between both.
void Comparing::keep(Difference difference, double loss_real, double loss_simulated,
                     double parameters) {
  const double both = loss_real + loss_simulated;
  difference.log_odds = both > 0.0 ? loss_real * loss_simulated / both : 0.0;
  difference.p =
      std::min(1.0, compared_ * chi_squared_upper_tail(2.0 * difference.log_odds, parameters));
  if (difference.p <= 0.5 * options_.significance) result_.differences.push_back(difference);
}

void Comparing::compare_sets() {
  std::size_t done = 0;
  for (const auto& cause : cause_types()) {
    tell("comparing effects",
         0.65 + 0.2 * static_cast<double>(done++) / static_cast<double>(cause_types().size()),
         std::string(cause.id));
    const auto real = found_in(real_, cause.id), simulated = found_in(sim_, cause.id);
    if (real.effects.empty() && simulated.effects.empty()) continue;
    Difference difference{.effect = std::string(cause.id),
                          .how = Differs::lacks,
                          .real = real.effects,
                          .simulated = simulated.effects,
                          .addition = {}};
    if (simulated.effects.empty() || real.effects.empty()) {
      const bool lacks = simulated.effects.empty();
      const double shown =
          would_show(lacks ? sim_ : real_, cause.id, lacks ? real.effects : simulated.effects);
      difference.how = lacks ? Differs::lacks : Differs::too_much;
      if (lacks) difference.addition.effects = real.effects;
      const auto before = result_.differences.size();
      keep(difference, lacks ? real.log_odds : shown, lacks ? shown : simulated.log_odds, 1.0);
      if (result_.differences.size() == before)
        result_.undecided.push_back(
            {difference.effect,
             fmt::format("found in the {} (log odds {:.1f}); the {} would show it with log odds of "
                         "{:.1f}, which is too little to say that it is not there",
                         lacks ? "recording" : "simulated traces",
                         lacks ? real.log_odds : simulated.log_odds,
                         lacks ? "simulated traces" : "recording", shown)});
      continue;
    }
    if (!differ_enough(real.effects, simulated.effects)) continue;
    double loss_real = 0.0, loss_simulated = 0.0;
    if (cause.id == "quantization" || cause.id == "saturation") {
      loss_real = loss_simulated = 1e3;  // read off the values
    } else {
      for (const auto& study : real_) loss_real += study->loss_with(cause.id, simulated.effects);
      for (const auto& study : sim_) loss_simulated += study->loss_with(cause.id, real.effects);
    }
    const double ratio = size_of(real.effects) / std::max(1e-300, size_of(simulated.effects));
    difference.how = ratio > 1.0 + least_of_effect   ? Differs::too_little
                     : ratio < 1.0 - least_of_effect ? Differs::too_much
                                                     : Differs::other_form;
    keep(difference, loss_real, loss_simulated,
         std::max(1.0, static_cast<double>(cause.free_parameters.size())));
  }
}

void Comparing::compare_noise() {
  tell("comparing effects", 0.85, std::string(white_noise));
  const auto mean_of = [](const Studies& side, double (TraceStudy::*value)() const) {
    double square = 0.0;
    for (const auto& study : side) square += std::pow((*study.*value)(), 2);
    return std::sqrt(square / static_cast<double>(side.size()));
  };
  const auto one = [&](std::string_view name, double (TraceStudy::*value)() const,
                       double (TraceStudy::*loss)(double) const, double least) {
    const double real = mean_of(real_, value), simulated = mean_of(sim_, value);
    if (std::abs(real - simulated) <= least * std::max(real, simulated)) return;
    Difference difference{.effect = std::string(name),
                          .how = real > simulated ? Differs::too_little : Differs::too_much,
                          .real = {},
                          .simulated = {},
                          .real_std = real,
                          .simulated_std = simulated,
                          .addition = {}};
    const double more = std::sqrt(std::max(0.0, real * real - simulated * simulated));
    (name == white_noise ? difference.addition.white_std_dps
                         : difference.addition.walk_dps_per_sqrt_s) = more;
    double loss_real = 0.0, loss_simulated = 0.0;
    for (const auto& study : real_) loss_real += (*study.*loss)(simulated);
    for (const auto& study : sim_) loss_simulated += (*study.*loss)(real);
    keep(difference, loss_real, loss_simulated, 1.0);
  };
  one(white_noise, &TraceStudy::white_std_dps, &TraceStudy::loss_with_white, least_of_white);
  one(random_walk, &TraceStudy::walk_dps_per_sqrt_s, &TraceStudy::loss_with_walk, least_of_walk);
}

void append(const Addition& more, Addition& to) {
  to.white_std_dps = std::hypot(to.white_std_dps, more.white_std_dps);
  to.walk_dps_per_sqrt_s = std::hypot(to.walk_dps_per_sqrt_s, more.walk_dps_per_sqrt_s);
  to.effects.insert(to.effects.end(), more.effects.begin(), more.effects.end());
}

void Comparing::judge() {
  const SegmentGap gap(pieces_->instrument(), real_pieces_, sim_pieces_);
  result_.gap_before = result_.gap_after = gap(sim_pieces_);
  const auto after = [&](const Addition& addition) {
    return readings_of(*pieces_, segments(sim_, Part::held_out, piece_, &addition));
  };
  const auto closed = [&](double to) {
    return result_.gap_before > 0.0 ? 1.0 - to / result_.gap_before : 0.0;
  };
  auto& differences = result_.differences;
  for (auto& difference : differences) {
    tell("adding each effect", 0.9, difference.effect);
    difference.gap_after =
        difference.addition.is_nothing() ? result_.gap_before : gap(after(difference.addition));
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
    result_.enrichments.push_back({difference.effect, gap(after(result_.addition))});
  }
  const double level = 0.5 * options_.significance;
  const bool seen = result_.p_before <= level;
  if (!result_.addition.is_nothing()) {
    const auto last = after(result_.addition);
    result_.gap_after = gap(last);
    result_.closed = closed(result_.gap_after);
    const auto interval = gap.closed(last, options_.seed);
    result_.closed_low = std::min(interval[0], result_.closed);
    result_.closed_high = std::max(interval[1], result_.closed);
    const auto mended_segments =
        readings_of(*whole_, segments(sim_, Part::train, segment_, &result_.addition));
    result_.p_after =
        two_samples(whole_->instrument(), real_segments_, mended_segments, options_.seed).p;
    for (std::size_t k = 0; k < sim_.size(); ++k)
      result_.with_added.push_back(mended(k, result_.addition));
  }
  if (differences.empty()) {
    if (seen) result_.verdict = Verdict::unknown(), result_.verdict_set = {Verdict::unknown()};
    return;
  }
  const bool mendable = std::none_of(differences.begin(), differences.end(),
                                     [](const auto& d) { return d.addition.is_nothing(); });
  const bool unexplained =
      seen && mendable && result_.p_after <= level && result_.closed < thresholds::recovery;
  result_.verdict = unexplained ? Verdict::unknown() : Verdict::cause(differences.front().effect);
  if (unexplained) result_.verdict_set.push_back(Verdict::unknown());
  for (const auto& difference : differences)
    result_.verdict_set.push_back(Verdict::cause(difference.effect));
}

Comparison Comparing::run() {
  match();
  find_sets();
  read_segments();
  test_segments();
  say_the_power();
  compare_sets();
  compare_noise();
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

Comparison compare(const std::vector<Trace>& recordings, const std::vector<Trace>& simulated,
                   const ComparisonOptions& options, const DiagnosisProgress& progress,
                   const Interrupt& interrupt) {
  return Comparing(recordings, simulated, options, progress, interrupt).run();
}

}  // namespace gyrostat::gap
