#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/felt_acceleration.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

namespace gyrostat::gap {
namespace {

/// Slow and fast: its sizes are fitted to means of clusters, and what is within them is taken out.
bool feels_acceleration(const Effect& effect) {
  const auto needs = effect.type().needs;
  return std::find(needs.begin(), needs.end(), &Series::acc_x_mps2) != needs.end();
}

/// Whether sizes are those that samples know, within their errors or the half of them.
bool agree(const Effect& effect, const std::vector<KnownSize>& known) {
  constexpr double errors = 5.0, share = 0.5;
  double apart = 0.0, all = 0.0, count = 0.0;
  for (const auto& k : known) {
    const double size = effect.value(k.field);
    apart += std::pow((size - k.size) / k.error, 2);
    all += std::pow(size / k.error, 2);
    count += 1.0;
  }
  return count > 0.0 && apart < std::max(errors * errors * count, share * share * all);
}

}  // namespace

std::vector<KnownSize> SetBench::known_within(const Effect& effect,
                                              const std::vector<double>& error) const {
  if (!is_shaken_ || effect.id() != "g_sensitivity") return {};
  const auto fields = amplitudes_of(effect, cause_types().named(effect.id(), "effects"));
  if (fields.empty()) return {};  // of none of the axes
  std::vector<std::vector<double>> courses;
  for (const auto unit : fields) {
    Effect one = effect;
    for (const auto field : fields) one.value(field) = field == unit ? 1.0 : 0.0;
    courses.push_back(added_by({one}));
  }
  const auto found = sizes_within_clusters(conditions_, masked(), error, courses);
  std::vector<KnownSize> known;
  for (std::size_t k = 0; found && k < fields.size(); ++k)
    known.push_back({std::string(effect.id()), fields[k], found->sizes[k], found->errors[k]});
  return known;
}

std::optional<Effect> SetBench::sized_within(const Standing& standing, Effect effect) const {
  if (!feels_acceleration(effect)) return {};
  const auto known = known_within(effect, error_of(gyro_beside(standing.scenario)));
  if (known.empty()) return {};
  for (const auto& k : known) effect.value(k.field) = k.size;
  return effect;
}

SetBench::Felt SetBench::felt_under(const Scenario& scenario, std::vector<double> error) const {
  Felt sum;
  const auto add = [](const std::vector<double>& felt, std::vector<double>& to) {
    to.resize(felt.size(), 0.0);
    for (std::size_t i = 0; i < felt.size(); ++i) to[i] += felt[i];
  };
  for (Effect effect : scenario.effects) {
    if (!feels_acceleration(effect)) continue;
    const auto known = known_within(effect, error);
    const bool agrees = agree(effect, known);
    if (agrees)
      for (const auto& k : known) effect.value(k.field) = k.size;
    auto felt = added_by({effect});
    if (agrees) {
      sum.known.insert(sum.known.end(), known.begin(), known.end());
    } else {
      keep_what_shows(conditions_, masked(), error, felt);
      add(felt, sum.of_means);
    }
    add(felt, sum.of_samples);
    for (std::size_t i = 0; i < felt.size(); ++i) error[i] -= felt[i];
  }
  return sum;
}

}  // namespace gyrostat::gap
