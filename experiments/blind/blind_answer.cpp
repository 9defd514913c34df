#include <gyrostat/experiments/blind/blind_answer.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {
namespace {

constexpr double rather_there = 0.5;

Verdict verdict_named(const Json& value, const std::string& place) {
  if (!value.is_string()) throw InputError(place, fmt::format("{} is not a text", value.dump()));
  const auto verdict = Verdict::of(value.get<std::string>());
  if (verdict.is_none() || verdict.is_unknown() || effect_types().find(verdict.text()))
    return verdict;
  auto known = effect_types().ids();
  known.insert(known.end(), {Verdict::none().text(), Verdict::unknown().text()});
  throw InputError(place, unknown_name("verdict", verdict.text(), known));
}

}  // namespace

std::vector<std::string> BlindAnswer::named() const {
  std::vector<std::string> names;
  for (const auto& [effect, inclusion] : inclusions)
    if (inclusion >= rather_there) names.push_back(effect);
  return names;
}

BlindAnswer read_answer(const std::filesystem::path& path) {
  const Json json = read_json(path.string());
  JsonObject object(json, path.string() + ":");
  BlindAnswer answer;
  const auto verdict = object.required_text("verdict");
  answer.verdict = verdict_named(verdict, object.place_of("verdict"));
  for (const auto& [value, place] : object.list("verdict_set"))
    answer.verdict_set.push_back(verdict_named(*value, place));
  for (const auto& [value, place] : object.list("effects")) {
    auto entry = object.at(*value, place);
    const auto effect = entry.required_text("effect");
    (void)effect_types().named(effect, entry.place_of("effect"));
    answer.inclusions.emplace_back(effect, entry.number("inclusion", 1.0, ranges::fraction, ""));
  }
  if (auto gap = object.child("gap")) {
    if (gap->has("closed")) answer.closed = gap->number("closed", 0.0, ranges::any, "");
    if (gap->has("log_score_gained") && !json["gap"]["log_score_gained"].is_null())
      answer.log_score_gained = gap->number("log_score_gained", 0.0, ranges::any, "");
    const auto ends = gap->list("closed_interval");
    if (ends.size() == 2) {
      const auto end = [&](std::size_t k) {
        return JsonObject::checked_number(*ends[k].first, ends[k].second, ranges::any, "");
      };
      answer.closed_interval = {end(0), end(1)};
    }
  }
  // A method that names one effect and says nothing of a set.
  if (!object.has("effects") && effect_types().find(verdict))
    answer.inclusions.emplace_back(verdict, 1.0);
  return answer;
}

BlindAnswer without_own(BlindAnswer answer, const BlindLabel& label) {
  const auto is_own = [&](const Verdict& verdict) { return holds(label.own, verdict.text()); };
  std::erase_if(answer.inclusions,
                [&](const auto& entry) { return holds(label.own, entry.first); });
  std::erase_if(answer.verdict_set, is_own);
  if (is_own(answer.verdict)) {
    const auto named = answer.named();
    answer.verdict = named.empty() ? Verdict::none() : Verdict::cause(named.front());
  }
  return answer;
}

bool is_right(const Verdict& verdict, const BlindLabel& label) {
  if (!label.effects.empty()) return holds(label.effects, verdict.text());
  // A sensor with errors of its own may also be said to have some that nobody can name.
  return verdict.is_none() || (!label.own.empty() && verdict.is_unknown());
}

}  // namespace gyrostat::gap
