#include <gyrostat/diagnosis/likelihood/dials.hpp>

#include <algorithm>
#include <cmath>

namespace gyrostat::gap {

Dial logarithmic(const std::function<double&(Scenario&)>& value, double low, double high) {
  return {[=](const Scenario& s) {
            Scenario copy = s;
            return std::log(std::clamp(value(copy), low, high));
          },
          [=](Scenario& s, double x) { value(s) = std::clamp(std::exp(x), low, high); }, 1.5};
}

Dial linear(const std::function<double&(Scenario&)>& value, double unit) {
  return {[=](const Scenario& s) {
            Scenario copy = s;
            return value(copy) / unit;
          },
          [=](Scenario& s, double x) { value(s) = unit * x; }, 1.0};
}

Scenario moved(Scenario scenario, const std::vector<Dial>& dials, const Eigen::VectorXd& by) {
  for (std::size_t d = 0; d < dials.size(); ++d)
    dials[d].set(scenario, dials[d].get(scenario) + by[static_cast<Eigen::Index>(d)]);
  return scenario;
}

}  // namespace gyrostat::gap
