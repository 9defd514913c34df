#pragma once

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/model_fit.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/train_steps.hpp>
#include <gyrostat/generators/effects/bias_steps.hpp>

namespace gyrostat::gap {

/// Jumps of the slow rate, and nothing between them.
template <>
struct Diagnosed<effects::BiasSteps> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array free_parameters = {&effects::BiasSteps::steps_per_hour,
                                                 &effects::BiasSteps::std_dps};

  /// The jumps that are seen, beside what is left without them; and the random walk in steps.
  static std::vector<Start> starts(const Evidence& e) {
    std::vector<Start> found;
    if (const auto seen = jumps(e); !seen.empty()) {
      const auto& conditions = e.conditions();
      Series rest = e.recording;
      double square = 0.0;
      for (const auto& jump : seen) {
        square += jump.size_dps * jump.size_dps;
        for (std::size_t i = jump.at * conditions.cluster(); i < rest.size(); ++i)
          rest.gyro_dps[i] -= jump.size_dps;
      }
      rest.heading_deg.clear();
      const auto count = static_cast<double>(seen.size());
      found.push_back(
          {effects::BiasSteps{count / e.seconds_of_train() * 3600.0, std::sqrt(square / count)},
           fit_rest(conditions, Scene(conditions, rest))});
    }
    auto arima = e.baseline.random_error;
    const double walk = (arima.delta1_dps - arima.delta2_dps) / (1.0 - arima.phi);
    const double an_hour = walk * walk * e.conditions().rate_hz() * 3600.0;
    arima.delta1_dps *= 0.1;
    arima.delta2_dps *= 0.1;
    for (const double steps : {3.0, 12.0, 50.0})
      found.push_back({effects::BiasSteps{steps, std::sqrt(an_hour / steps)},
                       {arima, e.baseline.thermal_drift}});
    return found;
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::time(c); }

  static bool is_what_it_is_called(const effects::BiasSteps& /*effect*/, const Conditions& /*c*/) {
    return true;
  }

 private:
  /// A sudden change of the slow values.
  struct Jump {
    std::size_t at;
    double size_dps;
  };

  /// Where the means of `reach` slow values before and after differ by more than six of their own
  /// robust deviations, the largest of each neighbourhood; `clearness` is of the largest.
  static std::vector<Jump> jumps_over(const Evidence& e, std::size_t reach, double& clearness) {
    const auto& slow = e.scene.slow_dps;
    std::vector<Jump> differences;
    for (const auto& span : e.conditions().slow_spans(Part::train)) {
      if (span.size() < 2 * reach) continue;
      double before = 0.0, after = 0.0;
      for (std::size_t k = 0; k < reach; ++k)
        before += slow[span.first + k], after += slow[span.first + reach + k];
      for (std::size_t i = span.first + reach;; ++i) {
        differences.push_back({i, (after - before) / static_cast<double>(reach)});
        if (i + reach >= span.last) break;
        before += slow[i] - slow[i - reach];
        after += slow[i + reach] - slow[i];
      }
    }
    std::vector<double> sizes;
    for (const auto& d : differences) sizes.push_back(std::abs(d.size_dps));
    const double deviation = quantile(sizes, 0.5) / normal_quartile;
    std::sort(differences.begin(), differences.end(), [](const Jump& a, const Jump& b) {
      return std::abs(a.size_dps) > std::abs(b.size_dps);
    });
    std::vector<Jump> found;
    for (const auto& d : differences) {
      if (std::abs(d.size_dps) < 6.0 * deviation || found.size() == 200) break;
      const auto near = [&](const Jump& other) {
        return std::max(d.at, other.at) - std::min(d.at, other.at) < 2 * reach;
      };
      if (std::none_of(found.begin(), found.end(), near)) found.push_back(d);
    }
    clearness = found.empty() ? 0.0 : std::abs(found.front().size_dps) / deviation;
    return found;
  }

  static std::vector<Jump> jumps(const Evidence& e) {
    std::vector<Jump> best;
    double clearest = 0.0;
    for (const std::size_t reach : {4U, 8U, 16U, 32U, 64U}) {
      double clearness = 0.0;
      if (auto found = jumps_over(e, reach, clearness); clearness > clearest) {
        clearest = clearness;
        best = std::move(found);
      }
    }
    return best;
  }
};

}  // namespace gyrostat::gap
