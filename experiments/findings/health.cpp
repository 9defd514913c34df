#include <gyrostat/experiments/findings/health.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/error.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>

namespace gyrostat::gap {
namespace {

std::string_view without_blanks_around(std::string_view text) {
  const auto first = std::min(text.find_first_not_of(' '), text.size());
  return text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

const HealthNumber* number_named(std::string_view name) {
  const auto& all = health_numbers();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& n) { return n.name == name; });
  return found == all.end() ? nullptr : &*found;
}

double probability_of(std::string_view effect, const Diagnosis& d) {
  for (const auto& found : d.effects)
    if (found.effect == effect) return found.inclusion;
  return 0.0;
}

}  // namespace

const std::vector<HealthNumber>& health_numbers() {
  static const std::vector<HealthNumber> all = {
      {"gap", "spreads", "how far the recording is from the simulator as it stands, or --baseline",
       [](const Diagnosis& d) { return d.claimed ? d.gap_after : d.gap_before; }},
      {"p", "1", "that the same simulator makes readings as far off as the recording's",
       [](const Diagnosis& d) { return d.claimed ? d.p_after : d.p_before; }},
      {"departures", "1", "readings that leave it",
       [](const Diagnosis& d) {
         return static_cast<double>(d.claimed ? d.where_after.size() : d.where.size());
       }},
      {"left", "spreads", "the gap that stays open with all effects found",
       [](const Diagnosis& d) { return d.gap_after; }},
      {"effects", "1", "how many were found",
       [](const Diagnosis& d) { return static_cast<double>(d.effects.size()); }},
  };
  return all;
}

HealthRule::HealthRule(std::string text, std::string_view place) : text_(std::move(text)) {
  const std::string_view whole = text_;
  const auto wrong = [&](const std::string& problem) {
    throw InputError(place, fmt::format("'{}': {}", whole, problem));
  };
  const auto at = std::min(whole.find_first_of("<>"), whole.size());
  if (at == whole.size()) wrong("is no rule; allowed: a number, < <= > or >=, a limit, as gap>2");
  const std::size_t length = whole.substr(at + 1).starts_with('=') ? 2 : 1;
  name_ = without_blanks_around(whole.substr(0, at));
  comparison_ = whole.substr(at, length);
  const auto limit = without_blanks_around(whole.substr(at + length));
  const auto [end, mistake] = std::from_chars(limit.data(), limit.data() + limit.size(), limit_);
  if (mistake != std::errc() || end != limit.data() + limit.size() || !std::isfinite(limit_))
    wrong(fmt::format("the limit '{}' is not a number", limit));
  if (number_named(name_) != nullptr || cause_types().find(name_) != nullptr) return;
  std::vector<std::string> names;
  for (const auto& number : health_numbers()) names.emplace_back(number.name);
  const auto known = fmt::format("{}", fmt::join(names, ", "));
  for (const auto& cause : cause_types()) names.emplace_back(cause.id);
  const auto nearest = nearest_name(name_, names);
  wrong(fmt::format("there is no number '{}'{}; allowed: {}, or an effect (its probability)", name_,
                    nearest.empty() ? "" : ", is it '" + nearest + "'?", known));
}

double HealthRule::number_of(const Diagnosis& d) const {
  const auto* number = number_named(name_);
  return number != nullptr ? number->of(d) : probability_of(name_, d);
}

bool HealthRule::is_broken_by(const Diagnosis& d) const {
  const double value = number_of(d);
  if (std::isnan(value)) return true;  // what cannot be told is not healthy
  if (comparison_ == ">") return value > limit_;
  if (comparison_ == ">=") return value >= limit_;
  if (comparison_ == "<") return value < limit_;
  return value <= limit_;
}

std::string HealthRule::told(const Diagnosis& d) const {
  const auto* number = number_named(name_);
  const auto unit =
      number == nullptr || number->unit == "1" ? "" : fmt::format(" {}", number->unit);
  return fmt::format("{} holds: {} is {:.4g}{}", text_, name_, number_of(d), unit);
}

nlohmann::ordered_json health_json(const Diagnosis& d, const std::vector<HealthRule>& rules) {
  using Json = nlohmann::ordered_json;
  Json json = {{"samples", d.samples}, {"rate_hz", d.rate_hz}, {"duration_s", d.duration_s}};
  for (const auto& number : health_numbers()) json[std::string(number.name)] = number.of(d);
  if (!d.claimed) json["verdict"] = d.verdict.text();
  json["found"] = Json::object();
  for (const auto& found : d.effects) json["found"][found.effect] = found.inclusion;
  json["failed"] = Json::array();
  for (const auto& rule : rules)
    if (rule.is_broken_by(d)) json["failed"].push_back(rule.text());
  return json;
}

}  // namespace gyrostat::gap
