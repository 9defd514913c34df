#include <gyrostat/experiments/blind/blind_tally.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gyrostat::gap {

Tally& Tally::operator+=(const Tally& t) {
  detected += t.detected, first += t.first, all_named += t.all_named, covered += t.covered;
  abstained += t.abstained, unknown_alone += t.unknown_alone;
  members += t.members, unknown += t.unknown, none += t.none;
  closed.insert(closed.end(), t.closed.begin(), t.closed.end());
  lost_by_a_name.insert(lost_by_a_name.end(), t.lost_by_a_name.begin(), t.lost_by_a_name.end());
  for (const auto& [name, times] : t.named_without) named_without[name] += times;
  return *this;
}

TableCell Tally::median_closed() const {
  auto sorted = closed;
  std::sort(sorted.begin(), sorted.end());
  return sorted.empty() ? TableCell() : cell(sorted[sorted.size() / 2]);
}

void Tally::add(const Scored& scored) {
  const auto& [label, answer] = scored;
  const auto is_true = [&l = label](const Verdict& said) { return is_right(said, l); };
  const bool right = is_true(answer.verdict);
  const auto& set = answer.verdict_set;
  detected.add(!answer.verdict.is_none());
  first.add(right);
  covered.add(right || std::any_of(set.begin(), set.end(), is_true));
  named[answer.verdict.text()] += 1;
  unknown += answer.verdict.is_unknown();
  none += answer.verdict.is_none();
  members += static_cast<double>(std::max<std::size_t>(set.size(), 1));
  if (answer.closed) closed.push_back(*answer.closed);
  if (label.effects.size() < 2) return;
  const auto given = answer.named();
  all_named.add(std::all_of(label.effects.begin(), label.effects.end(),
                            [&](const auto& effect) { return holds(given, effect); }));
}

void Tally::add_left_out(const Scored& scored, const BlindAnswer& without) {
  const auto& [label, whole] = scored;
  const auto& verdict = without.verdict;
  // Of a set, what is left may be named.
  const bool right = label.effects.size() > 1 && is_right(verdict, label);
  abstained.add(right || verdict.is_unknown() || verdict.is_none());
  unknown_alone.add(right || verdict.is_unknown());
  named_without[verdict.text()] += 1;
  if (!right && !verdict.is_unknown() && !verdict.is_none() && whole.log_score_gained &&
      without.log_score_gained)
    lost_by_a_name.push_back(*whole.log_score_gained - *without.log_score_gained);
}

/// "thermal_lag (second_order_lag)".
std::string name_of(const BlindLabel& label) {
  if (label.effects.empty()) return Verdict::none().text();
  const auto names = fmt::format("{}", fmt::join(label.effects, " + "));
  return label.form.empty() ? names : fmt::format("{} ({})", names, label.form);
}

std::string in_words(const Counts& named, const std::string& but) {
  std::vector<std::string> others;
  for (const auto& [name, times] : named)
    if (name != but) others.push_back(fmt::format("{} {:.0f}", name, times));
  return fmt::format("{}", fmt::join(others, ", "));
}

std::string in_order(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return fmt::format("{:.0f}", fmt::join(values, ", "));
}

/// "strong", "none", "two effects, strong".
std::string kind_of(const BlindLabel& label) {
  static constexpr std::array counts = {"no", "one", "two", "three", "four", "five", "six"};
  const auto size = label.effects.size();
  if (size == 0) return Verdict::none().text();
  if (size == 1) return label.strength;
  return fmt::format("{} effects, {}",
                     size < counts.size() ? counts[size] : fmt::format("{}", size), label.strength);
}

}  // namespace gyrostat::gap
