#include <gyrostat/diagnosis/likelihood/detectable.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>

#include <gyrostat/diagnosis/likelihood/beside.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/law_gain.hpp>

namespace gyrostat::gap {
namespace {

constexpr double deviate_of_power = 0.8416;  // that a normal one exceeds with 1 - Detectable::power

/// The first free parameter that may be 0 and as large as one likes.
std::optional<std::size_t> size_field(const CauseType& cause, const Effect& effect) {
  for (const auto name : cause.free_parameters) {
    const auto f = field_of(effect, name);
    const auto& range = effect.fields()[f].range;
    if (range.from <= 0.0 && !range.open_from && std::isinf(range.to)) return f;
  }
  return std::nullopt;
}

/// Whether two guesses differ in what a fit moves alone.
bool are_of_one_form(const CauseType& cause, const Effect& a, const Effect& b) {
  for (std::size_t f = 0; f < a.fields().size(); ++f) {
    const bool is_free = std::find(cause.free_parameters.begin(), cause.free_parameters.end(),
                                   a.fields()[f].name) != cause.free_parameters.end();
    if (is_free ? (a.value(f) == 0.0) != (b.value(f) == 0.0) : a.value(f) != b.value(f))
      return false;
  }
  return true;
}

/// What a fit would begin from in its first form, the middle first.
std::vector<Effect> examples_of(const SetBench& bench, const Standing& standing,
                                const CauseType& cause) {
  std::vector<Effect> all;
  if (cause.guesses != nullptr)
    all = cause.guesses(Beside{bench.conditions(), *standing.fitter, standing.fit});
  if (all.empty()) all.push_back(cause.effect());
  std::erase_if(
      all, [&, first = all.front()](const auto& e) { return !are_of_one_form(cause, first, e); });
  std::vector<Effect> ordered;
  const std::size_t middle = all.size() / 2;
  for (std::size_t off = 0; off <= middle; ++off) {
    ordered.push_back(all[middle - off]);
    if (off > 0 && middle + off < all.size()) ordered.push_back(all[middle + off]);
  }
  std::erase_if(ordered,
                [&](const auto& e) { return !cause.is_what_it_is_called(e, bench.conditions()); });
  return ordered;
}

/// One effect beside a set.
class Sought {
 public:
  Sought(const SetBench& bench, const Standing& standing, const Effect& effect, std::size_t field)
      : bench_(bench), standing_(standing), with_(standing.scenario), field_(field) {
    with_.effects.push_back(effect);
    if (is_slow_curve())
      amplitude_ = standing.fitter->amplitude_of(with_, with_.effects.size() - 1);
  }

  const Effect& effect() const { return with_.effects.back(); }
  void scale(double factor) { with_.effects.back().value(field_) *= factor; }
  /// Of what the search must gain, beside a least gain.
  double price() const {
    double sum = bench_.price_of(with_) - bench_.price_of(standing_.scenario);
    if (is_slow_curve()) {
      const auto [error, prior] = amplitude_;
      sum += 0.5 * std::log1p(prior * prior / (error * error));
    }
    return sum;
  }
  /// The size over its standard error; of what is random, one that gains as much in as many
  /// recordings.
  double deviate() const {
    const double size = effect().value(field_);
    if (is_slow_curve()) return std::abs(size) / amplitude_.error;
    if (is_taken_out(effect())) {
      // The curvature of the likelihood, by as much of the effect added as taken away.
      Scenario less = with_;
      less.effects.back().value(field_) = -size;
      const double bent = 2.0 * standing_.fit.log_likelihood -
                          bench_.refitted(with_, 0).fit.log_likelihood -
                          bench_.refitted(less, 0).fit.log_likelihood;
      return std::sqrt(std::max(0.0, bent));
    }
    const auto& conditions = bench_.conditions();
    const double interval_s = conditions.interval_s();
    const double samples = static_cast<double>(conditions.train_points().size()) *
                           static_cast<double>(conditions.cluster());
    const double lost = 0.5 * static_cast<double>(conditions.drift_regressors().cols());
    const auto [mean, deviation] =
        gain_over(law_of(with_, interval_s), law_of(standing_.scenario, interval_s),
                  standing_.fitter->reduced().grid(), samples, lost);
    return deviate_of_power + std::sqrt(2.0 * std::max(0.0, mean - deviate_of_power * deviation));
  }
  /// The deviate grows with the size, of what is random with its square.
  double growth() const { return is_slow_curve() || is_taken_out(effect()) ? 1.0 : 2.0; }

 private:
  bool is_slow_curve() const {
    return cause_types().named(effect().id(), "effects").signature == Signature::slow;
  }

  const SetBench& bench_;
  const Standing& standing_;
  Scenario with_;
  std::size_t field_;
  SetFitter::Amplitude amplitude_{};  ///< of a slow curve, whatever its size
};

std::optional<Detectable> detectable(const SetBench& bench, const Standing& standing,
                                     const CauseType& cause, const Effect& example,
                                     double least_gain) {
  const auto field = size_field(cause, example);
  if (!field) return std::nullopt;
  Sought sought(bench, standing, example, *field);
  // By the power of the size that a deviate grows with, and by halves where that leads astray.
  constexpr int most_steps = 30;
  constexpr double furthest = 8.0, near_enough = 0.02, far_beyond_noise = 1e5;
  const double largest = far_beyond_noise * std::abs(example.value(*field));
  double below = 0.0, above = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    const double size = sought.effect().value(*field);
    if (!(size <= largest)) break;
    const double needed =
        std::sqrt(2.0 * std::max(0.0, sought.price() + least_gain)) + deviate_of_power;
    const double ratio = needed / std::max(sought.deviate(), 1e-12 * needed);
    if (std::abs(ratio - 1.0) < near_enough) {
      if (!cause.is_what_it_is_called(sought.effect(), bench.conditions())) return std::nullopt;
      return Detectable{sought.effect(), *field};
    }
    (ratio > 1.0 ? below : above) = size;
    double next =
        size * std::clamp(std::pow(ratio, 1.0 / sought.growth()), 1.0 / furthest, furthest);
    if (next <= below || next >= above) next = std::sqrt(below * above);
    sought.scale(next / size);
  }
  return std::nullopt;  // no size of it is seen
}

}  // namespace

std::vector<Detectable> detectable_beside(
    const SetBench& bench, const Standing& standing,
    const std::function<double(std::string_view)>& least_gain) {
  std::vector<const CauseType*> asked;
  for (const auto& cause : cause_types())
    if (bench.is_allowed(cause.id) && !bench.is_marked(cause.id) &&
        cause.effect().stage() != Stage::compass && !has(standing.scenario, cause.id))
      asked.push_back(&cause);
  std::vector<std::optional<Detectable>> each(asked.size());
  tbb::parallel_for(
      std::size_t{0}, asked.size(),
      [&](std::size_t k) {
        const auto& cause = *asked[k];
        for (const auto& example : examples_of(bench, standing, cause))
          if (!each[k]) each[k] = detectable(bench, standing, cause, example, least_gain(cause.id));
      },
      tbb::simple_partitioner());
  std::vector<Detectable> all;
  for (auto& found : each)
    if (found) all.push_back(std::move(*found));
  return all;
}

}  // namespace gyrostat::gap
