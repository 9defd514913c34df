#include <gyrostat/experiments/findings/sensitivity_words.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gyrostat {
namespace {

struct Influence {
  std::string parameter;
  Estimate estimate;
  double size() const { return std::abs(estimate.value); }
  bool is_told_from_nothing() const { return estimate.low > 0.0 || estimate.high < 0.0; }
};

struct Influences {
  std::string measure;
  std::vector<Influence> largest_first;
};

Influences influences_of(const Sensitivity& s) {
  Influences effects;
  for (const auto& e : s.elasticities) {
    effects.measure = "elasticity";
    effects.largest_first.push_back({e.parameter, e.value});
  }
  for (const auto& e : s.elementary_effects) {
    effects.measure = "mu*";
    effects.largest_first.push_back({e.parameter, e.mu_star});
  }
  for (const auto& e : s.indices) {
    effects.measure = "total index";
    effects.largest_first.push_back({e.parameter, e.total});
  }
  std::erase_if(effects.largest_first, [](const Influence& e) { return std::isnan(e.size()); });
  std::stable_sort(effects.largest_first.begin(), effects.largest_first.end(),
                   [](const Influence& a, const Influence& b) { return a.size() > b.size(); });
  return effects;
}

}  // namespace

std::string sensitivity_sentence(const Sensitivity& s) {
  const auto [measure, effects] = influences_of(s);
  if (effects.empty()) return "";
  const auto& first = effects.front();
  if (!first.is_told_from_nothing())
    return fmt::format("{}: no parameter's effect on {} is told from none", s.method, s.metric);
  const auto unit = s.elementary_effects.empty() || s.unit == "1" ? "" : " " + s.unit;
  const auto shown = [&](const Influence& e) {
    return fmt::format("{:.2g}, {:.2g} to {:.2g}{}", e.estimate.value, e.estimate.low,
                       e.estimate.high, unit);
  };
  auto sentence = fmt::format("{}: {} matters most to {} ({} {})", s.method, first.parameter,
                              s.metric, measure, shown(first));
  if (effects.size() < 2) return sentence;
  const auto& second = effects[1];
  if (!second.is_told_from_nothing())
    return sentence + "; the others' effects are not told from none";
  return sentence + fmt::format(", then {} ({})", second.parameter, shown(second));
}

std::string surrogate_verdict(const Sensitivity& s) {
  const double value = s.surrogate->unexplained.value, high = s.surrogate->unexplained.high;
  if (std::isnan(value))
    return fmt::format(
        "{}: too few rows to fit a surrogate or to check it: the indices are those of the rows "
        "alone",
        s.method);
  const auto percent = [](double share) { return fmt::format("{:.2g}", 100.0 * share); };
  const auto interval =
      std::isnan(high) ? "" : fmt::format(" (up to {} %)", percent(std::max(0.0, high)));
  const auto left =
      fmt::format("{}: a chaos of {} terms leaves {} %{} of the variance unexplained", s.method,
                  s.surrogate->chaos.terms.size(), percent(std::max(0.0, value)), interval);
  const auto allowed = percent(Surrogate::most_unexplained);
  if (s.surrogate->is_trusted)
    return left + fmt::format(
                      ", {} % allowed: it is trusted, and takes what it explains out of "
                      "the indices' sampling error",
                      allowed);
  return left + fmt::format(
                    ", {} % allowed: it is not trusted, and the indices are those of the "
                    "rows alone; more rows make either better",
                    allowed);
}

}  // namespace gyrostat
