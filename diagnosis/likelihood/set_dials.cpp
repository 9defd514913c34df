#include <gyrostat/diagnosis/likelihood/set_dials.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/arima_law.hpp>

namespace gyrostat::gap {
namespace {

/// The innovation of the decaying error beside the walk, as a share of the white noise.
Dial size_of_memory(double white) {
  return {[=](const Scenario& s) { return ArimaLaw::of(s.random_error).memory / (white * white); },
          [=](Scenario& s, double x) {
            auto law = ArimaLaw::of(s.random_error);
            const double from_walk = law.walk_dps * (1.0 + law.phi);
            law.memory = std::max(x * white * white, -0.25 * from_walk * from_walk);
            law.put(s.random_error);
          },
          0.5};
}

Dial length_of_memory() {
  return {[](const Scenario& s) { return std::atanh(s.random_error.phi); },
          [](Scenario& s, double x) {
            auto law = ArimaLaw::of(s.random_error);
            constexpr double longest = 0.967;  // beyond, it is a slow error
            law.phi = std::clamp(std::tanh(x), 0.05, longest);
            law.put(s.random_error);
          },
          0.5};
}

}  // namespace

std::vector<Dial> dials_of(const Scenario& scenario) {
  std::vector<Dial> dials;
  const double white = scenario.random_error.measurement_noise_std_dps;
  dials.push_back(
      logarithmic([](Scenario& s) -> double& { return s.random_error.measurement_noise_std_dps; },
                  1e-6 * white, 1e6 * white));
  dials.back().of = white_noise;
  dials.push_back(size_of_walk(1e-9 * white, 1e3 * white));
  dials.back().of = random_walk;
  if (scenario.random_error.phi != 0.0) {
    dials.push_back(size_of_memory(white));
    dials.push_back(length_of_memory());
  }
  for (std::size_t k = 0; k < scenario.effects.size(); ++k) {
    const auto& effect = scenario.effects[k];
    const auto& cause = cause_types().named(effect.id(), "effects");
    if (cause.enter == nullptr && cause.signature != Signature::slow) continue;
    const auto amplitudes = cause.signature == Signature::slow ? cause.amplitudes : 0;
    for (std::size_t f = 0; f < effect.fields().size(); ++f) {
      const auto& field = effect.fields()[f];
      if (std::find(cause.free_parameters.begin() + static_cast<std::ptrdiff_t>(amplitudes),
                    cause.free_parameters.end(), field.name) == cause.free_parameters.end())
        continue;
      const auto value = [k, f](Scenario& s) -> double& { return s.effects[k].value(f); };
      const double start = effect.value(f);
      const bool may_be_below = field.range.from < 0.0 && cause.signature != Signature::slow;
      if (start == 0.0 && !may_be_below) continue;  // of another form
      double largest = 1e-12;
      for (std::size_t g = 0; g < effect.fields().size(); ++g)
        if (effect.fields()[g].unit == field.unit)
          largest = std::max(largest, std::abs(effect.value(g)));
      if (field.range.from >= 0.0 && start > 0.0)
        dials.push_back(logarithmic(value, std::max(field.range.from, 1e-3 * start),
                                    std::min(field.range.to, 1e3 * start)));
      else
        dials.push_back(linear(value, largest));
      dials.back().place = Dial::Place{k, f};
      dials.back().of = cause.id;
    }
  }
  return dials;
}

}  // namespace gyrostat::gap
