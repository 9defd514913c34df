#include <gyrostat/diagnosis/next_experiment.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/diagnosis/gap/scoring.hpp>
#include <gyrostat/diagnosis/simulator.hpp>
#include <gyrostat/diagnosis/verdict.hpp>
#include <gyrostat/generators/environment/motion/list.hpp>
#include <gyrostat/generators/environment/temperature/list.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t replicas = 24;
constexpr std::size_t samples = 20000;  // of each imagined recording: its rate follows

struct Proposal {
  std::string what;
  Scenario conditions;
};

std::vector<Proposal> proposals(const Scenario& like, double recorded_s) {
  const auto still = temperature::QuietRoom{.start_C = 25.0, .end_C = 25.0};
  const auto make = [&](std::string what, double duration_s, const Temperature& temperature,
                        const Motion& motion) {
    Scenario s = like;
    s.effects.clear();
    s.sampling = {duration_s,
                  std::min(like.sampling.rate_hz, static_cast<double>(samples) / duration_s)};
    s.temperature = temperature;
    s.motion = motion;
    return Proposal{std::move(what), s};
  };
  const double hour = 3600.0, night = 10.0 * hour;
  return {make("static at constant temperature for 10 h", night, still, motion::Stationary{}),
          make(fmt::format("static at constant temperature for {:.3g} h", 4.0 * recorded_s / hour),
               4.0 * recorded_s, still, motion::Stationary{}),
          make("static, temperature cycles of 20 min between 23 and 57 °C for 2 h", 2 * hour,
               temperature::Cycle{23.0, 57.0, 1200.0}, motion::Stationary{}),
          make("static, temperature cycles of 2 h between 23 and 57 °C for 4 h", 4 * hour,
               temperature::Cycle{23.0, 57.0, 2 * hour}, motion::Stationary{}),
          make("rate table, +-80 dps in 32 s swings, for 20 min", 1200.0, still,
               motion::Sinusoidal{80.0, 1.0 / 32.0}),
          make("turns on the spot: 30 dps, rest, -30 dps, rest, in 60 s, for 20 min", 1200.0, still,
               motion::RateTable{30.0, 60.0})};
}

double power(const Scenario& conditions, const Scenario& first, const Scenario& second,
             std::uint64_t seed, const Interrupt& interrupt) {
  Series imagined;
  synthesise(conditions, {seed, 0}, imagined);
  const Simulator simulator(imagined, seed, interrupt);
  const auto readings = [&](const Scenario& scenario, std::uint32_t from) {
    return simulator.ensemble(scenario, from, replicas, train_alone)[0];
  };
  const auto a = readings(first, 0), b = readings(second, 0);
  const Ensemble yardstick(simulator.instrument(Part::train), a, {});
  double right = 0.0;
  for (const bool is_first : {true, false}) {
    const auto imagined_readings = readings(is_first ? first : second, 1000);
    for (const auto& seen : imagined_readings.colwise()) {
      const Scoring scoring(yardstick, seen);
      const double gain = scoring.of(a).value - scoring.of(b).value;
      right += (gain > 0.0) == is_first ? 1.0 : 0.0;
    }
  }
  return right / (2.0 * replicas);
}

}  // namespace

NextExperiment next_experiment(const Scenario& first, const Scenario& second, double recorded_s,
                               std::uint64_t seed, const Interrupt& interrupt) {
  const auto last_of = [](const Scenario& scenario) {
    return scenario.effects.empty() ? Verdict::none().text()
                                    : std::string(scenario.effects.back().id());
  };
  NextExperiment best{.what = "", .first = last_of(first), .second = last_of(second)};
  for (const auto& proposal : proposals(first, recorded_s))
    if (const double p = power(proposal.conditions, first, second, seed, interrupt);
        p > best.expected_power) {
      best.expected_power = p;
      best.what = proposal.what;
    }
  return best;
}

NextExperiment undisturbed_recording(const std::string& nearest) {
  return {.what =
              "the same once more, with nobody near the bench: what happened once is seldom the "
              "sensor's",
          .first = nearest,
          .second = Verdict::unknown().text()};
}

NextExperiment wider_recording(const Conditions& conditions, double recorded_s,
                               const std::string& nearest, bool of_compass_alone) {
  const double longer_h = 4.0 * recorded_s / 3600.0;
  if (of_compass_alone)
    return {
        .what = fmt::format("the compass for {:.3g} h at rest, far from iron and from currents, "
                            "and once more where it is used: what stays is its own",
                            longer_h),
        .first = nearest,
        .second = Verdict::unknown().text()};
  const auto& series = conditions.series();
  constexpr double least_span_C = 4.0;
  const auto& T = series.temperature_C;
  const bool warms =
      !T.empty() &&
      *std::max_element(T.begin(), T.end()) - *std::min_element(T.begin(), T.end()) >= least_span_C;
  constexpr double least_h = 2.0;  // six of the cycles
  std::string what =
      fmt::format("{:.3g} h at rest", warms ? longer_h : std::max(longer_h, least_h));
  if (!warms) what += ", over temperature cycles of 20 min between 23 and 57 °C (temperature_C)";
  if (conditions.motion_dps_s().empty()) what += ", then turns on a rate table (rate_ref_dps)";
  if (series.acc_x_mps2.empty()) what += ", with the accelerometer beside it (acc_x_mps2, ...)";
  what += "; and once more elsewhere, since what stays behind is not the sensor's";
  return {.what = what, .first = nearest, .second = Verdict::unknown().text()};
}

}  // namespace gyrostat::gap
