#include <gyrostat/diagnosis/likelihood/dials.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/arima_law.hpp>

namespace gyrostat::gap {

Dial logarithmic(const std::function<double&(Scenario&)>& value, double low, double high) {
  return {[=](const Scenario& s) {
            Scenario copy = s;
            return std::log(std::clamp(value(copy), low, high));
          },
          [=](Scenario& s, double x) { value(s) = std::clamp(std::exp(x), low, high); }, 1.5};
}

Dial size_of_walk(double low_dps, double high_dps) {
  return {[=](const Scenario& s) {
            return std::log(std::clamp(ArimaLaw::of(s.random_error).walk_dps, low_dps, high_dps));
          },
          [=](Scenario& s, double x) {
            auto law = ArimaLaw::of(s.random_error);
            law.walk_dps = std::clamp(std::exp(x), low_dps, high_dps);
            law.put(s.random_error);
          },
          1.5};
}

Dial linear(const std::function<double&(Scenario&)>& value, double unit) {
  return {[=](const Scenario& s) {
            Scenario copy = s;
            return value(copy) / unit;
          },
          [=](Scenario& s, double x) { value(s) = unit * x; }, 1.0};
}

Scenario with_walk_times(Scenario scenario, double factor) {
  auto law = ArimaLaw::of(scenario.random_error);
  law.walk_dps *= factor;
  law.put(scenario.random_error);
  return scenario;
}

Scenario with_walk_of_at_least(Scenario scenario, double walk_dps) {
  auto law = ArimaLaw::of(scenario.random_error);
  law.walk_dps = std::max(law.walk_dps, walk_dps);
  law.put(scenario.random_error);
  return scenario;
}

Scenario moved(Scenario scenario, const std::vector<Dial>& dials, const Eigen::VectorXd& by) {
  for (std::size_t d = 0; d < dials.size(); ++d)
    dials[d].set(scenario, dials[d].get(scenario) + by[static_cast<Eigen::Index>(d)]);
  return scenario;
}

}  // namespace gyrostat::gap
