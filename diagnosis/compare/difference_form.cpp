#include <gyrostat/diagnosis/compare/difference_form.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {
namespace {

constexpr double least_of_effect = 0.05;

/// The size that an effect is known by: of what it has in dps, the largest; else the first of its
/// free parameters.
double size_of(const CauseType& cause, const std::vector<Effect>& effects) {
  double size = 0.0;
  for (const auto& effect : effects)
    for (std::size_t i = 0; i < effect.fields().size(); ++i)
      if (effect.fields()[i].unit == "dps") size = std::max(size, std::abs(effect.value(i)));
  if (size == 0.0 && !effects.empty() && !cause.free_parameters.empty())
    size = std::abs(effects.front().value(field_of(effects.front(), cause.free_parameters[0])));
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

}  // namespace

std::optional<Differs> how_differs(const CauseType& cause, const std::vector<Effect>& real,
                                   const std::vector<Effect>& simulated) {
  if (!differ_enough(real, simulated)) return {};
  const double ratio = size_of(cause, real) / std::max(1e-300, size_of(cause, simulated));
  return ratio > 1.0 + least_of_effect   ? Differs::too_little
         : ratio < 1.0 - least_of_effect ? Differs::too_much
                                         : Differs::other_form;
}

std::vector<Effect> instead_of(const CauseType& cause, std::vector<Effect> real,
                               std::vector<Effect> simulated) {
  if (cause.signature != Signature::slow) return simulated.empty() ? real : std::vector<Effect>{};
  for (auto& effect : simulated) {
    for (std::size_t a = 0; a < cause.amplitudes; ++a)
      effect.value(field_of(effect, cause.free_parameters[a])) *= -1.0;
    real.push_back(std::move(effect));
  }
  return real;
}

}  // namespace gyrostat::gap
