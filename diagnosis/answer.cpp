#include <gyrostat/diagnosis/answer.hpp>

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/core/words.hpp>
#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/diagnosis/gap/lens_type.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {
namespace {

/// "a, b and c".
std::string listed(const std::vector<std::string>& words) {
  if (words.size() < 2) return words.empty() ? "" : words.front();
  return fmt::format("{} and {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

/// "quantization (values lie on a grid) and ...".
std::string effects_in_words(const Diagnosis& d) {
  std::vector<std::string> words;
  for (const auto& found : d.effects)
    words.push_back(
        fmt::format("{} ({})", found.effect, effect_types().named(found.effect, "effects").title));
  return listed(words);
}

std::string claimed_effects(const Diagnosis& d) {
  std::vector<std::string> effects;
  for (const auto& verdict : d.verdict_set)
    if (!verdict.is_unknown()) effects.push_back(verdict.text());
  return fmt::format("{}", fmt::join(effects, ", then "));
}

/// What might stand in the place of an effect of the set.
std::string rivals_in_words(const Diagnosis& d) {
  std::vector<std::string> others;
  const auto is_found = [&](const Verdict& verdict) {
    return std::any_of(d.effects.begin(), d.effects.end(),
                       [&](const auto& e) { return verdict.names(e.effect); });
  };
  for (const auto& verdict : d.verdict_set)
    if (verdict != d.verdict && !is_found(verdict)) others.push_back(verdict.text());
  return fmt::format("{}", fmt::join(others, ", "));
}

std::string closeness(const Diagnosis& d) {
  if (d.closed < 0.005) return "no closer to the part of it that was held back";
  return fmt::format(
      "{:.0f} % closer to the part of it that was held back (95 %: {:.0f} to {:.0f}{})",
      100.0 * d.closed, 100.0 * d.closed_low, 100.0 * d.closed_high,
      d.closed_low <= 0.0 ? ", so perhaps no closer" : "");
}

std::string what_is_left_in_words(const Diagnosis& d) {
  if (std::min(d.p_after, p_of_the_oddest(d.unexplained)) < thresholds::p_of_the_unexplained)
    return " It still misses the recording by more than chance: something else is there, besides "
           "or instead.";
  if (d.p_held_out < thresholds::p_of_the_unseen)
    return " It misses the part that was held back by more than chance: something is there that "
           "the rest of the recording does not have.";
  return "";
}

std::string what_was_held_out_in_words(const Diagnosis& d) {
  return d.other_part_held_out ? " The part that is held back at first has some of it that the "
                                 "rest has not: another was held back in its place."
                               : "";
}

/// ", mostly in the tails of the increments": the lens that most readings leave.
std::string where_in_words(const std::vector<Where>& where) {
  std::map<std::string, int> readings;
  for (const auto& reading : where) ++readings[reading.lens];
  if (readings.empty()) return "";
  const auto most =
      std::max_element(readings.begin(), readings.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const auto& lens : lens_types())
    if (lens.id == most->first) return fmt::format(", mostly in the {}", lens.title);
  return "";
}

}  // namespace

std::string parameters_in_words(const Effect& effect, std::optional<std::size_t> but) {
  std::string words;
  for (std::size_t i = 0; i < effect.fields().size(); ++i) {
    if (i == but) continue;
    const auto& field = effect.fields()[i];
    words += fmt::format("{}{} = {:.4g}{}{}", words.empty() ? "" : ", ", field.name,
                         effect.value(i), field.unit == "1" || field.unit.empty() ? "" : " ",
                         field.unit == "1" ? "" : field.unit);
  }
  return words;
}

std::string answer(const Diagnosis& d) {
  if (d.verdict.is_none()) return "The simulator already makes recordings like this one.";
  if (d.claimed && d.verdict.is_unknown())
    return "The recording has something that the claimed simulator lacks.";
  if (d.claimed)
    return fmt::format("With what is claimed, {}, the simulator comes {}.{}", claimed_effects(d),
                       closeness(d), what_is_left_in_words(d));
  const char* with = d.effects.size() > 1 ? "these" : "that";
  if (d.verdict.is_unknown()) {
    const std::string unknown =
        "The recording has something that the simulator lacks and that no effect of the catalogue "
        "explains";
    if (d.effects.empty() && d.p_before > thresholds::p_of_the_unexplained &&
        d.p_held_out < thresholds::p_of_the_unseen)
      return unknown + ": it is in the part that was held back, and not in the rest.";
    if (d.effects.empty()) return unknown + '.';
    return fmt::format("{}. Nearest: {}; given {} the simulator comes {}.{}", unknown,
                       effects_in_words(d), with, closeness(d), what_was_held_out_in_words(d));
  }
  return fmt::format(
      "To make recordings like this one, the simulator lacks {}. Given {}, it comes {}.{}{}",
      effects_in_words(d), with, closeness(d), what_is_left_in_words(d),
      what_was_held_out_in_words(d));
}

std::string transient_in_words(const Diagnosis& d) {
  if (!d.transient) return "";
  const auto& once = *d.transient;
  return fmt::format(
      "Between {:.2f} and {:.2f} s, and at no other time, it swings at {:.3g} Hz ({:.2g} dps rms; "
      "p {}): look what happened then, or leave that out (--leave-out {:.2f}:{:.2f}).",
      once.from_s, once.to_s, once.frequency_hz, once.rms_dps, chance_in_words(once.p_value),
      once.from_s, once.to_s);
}

std::string remainder_in_words(const Diagnosis& d) {
  if (d.remainder.parts.empty()) return "";
  std::vector<std::string> words;
  for (const auto& part : d.remainder.parts) words.push_back(part.in_words);
  const double named = 100.0 * std::max(0.0, d.closed);
  const double more = 100.0 * d.remainder.closed - named;
  if (more < 0.5) return "";
  return fmt::format(
      "Named effects close {:.0f} % of the gap; {} {} another {:.0f} %; {:.0f} % is open{}.", named,
      listed(words), words.size() > 1 ? "close" : "closes", more, 100.0 - named - more,
      where_in_words(d.remainder.where));
}

std::string transfer_in_words(const Diagnosis& d) {
  if (d.enrichments.size() < 2 || d.transfer.empty()) return "";
  const auto count = [&](Moved moved) {
    return std::count_if(d.transfer.begin(), d.transfer.end(),
                         [&](const auto& t) { return t.moved == moved; });
  };
  const auto did = [&](Moved moved, std::string_view one, std::string_view several) {
    const auto number = count(moved);
    return fmt::format("{} {}", number, number == 1 ? one : several);
  };
  return fmt::format(
      "Of {} that the filters show, {}, {} and {}.", counted(d.transfer.size(), "number"),
      did(Moved::closer, "comes nearer to the recording", "come nearer to the recording"),
      did(Moved::away, "moves away", "move away"),
      did(Moved::nowhere, "stays as it was", "stay as they were"));
}

std::string next_in_words(const Diagnosis& d) {
  if (d.next.what.empty()) return "";
  if (d.next.expected_power == 0.0) return fmt::format("Record next: {}.", d.next.what);
  const double percent = 100.0 * d.next.expected_power;
  const auto question = d.next.first == Verdict::none().text()
                            ? fmt::format("whether {} is there", d.next.second)
                            : fmt::format("{} from {}", d.next.first, d.next.second);
  if (!d.next.tells_apart())
    return fmt::format(
        "No recording that was tried in simulation tells {}; the best, {}, "
        "is right in {:.0f} %.",
        question, d.next.what, percent);
  return fmt::format("To tell {}: {} (right in {:.0f} % of simulated recordings).", question,
                     d.next.what, percent);
}

std::string detectable_in_words(const Diagnosis& d) {
  if (!d.verdict.is_none()) return "";
  std::vector<std::string> words;
  for (const auto& seen : d.detectable)
    if (is_slow(seen.effect.id()))
      words.push_back(fmt::format("{} of {:.2g} {}", seen.effect.id(),
                                  seen.effect.value(seen.field),
                                  seen.effect.fields()[seen.field].unit));
  if (words.empty()) return "";
  return fmt::format("It would have been found with {:.0f} %: {}.", 100.0 * Detectable::power,
                     listed(words));
}

std::string evidence_in_words(const Diagnosis& d) {
  if (d.verdict.is_none())
    return fmt::format("No gap: p {} under the simulator {}.",
                       chance_in_words(d.claimed ? d.p_after : d.p_before),
                       d.claimed ? "that is claimed" : "as it stands");
  std::string text = fmt::format(
      "p {} under the simulator as it stands, {} with the effects. Gap on the held-out "
      "part: from {:.3g} to {:.3g} spreads of a reading.",
      chance_in_words(d.p_before), chance_in_words(d.p_after), d.gap_before, d.gap_after);
  for (std::size_t k = 0; k < d.effects.size(); ++k)
    text += fmt::format("{}{} {:.2f}", k == 0 ? " Inclusion probability: " : ", ",
                        d.effects[k].effect, d.effects[k].inclusion);
  if (!d.effects.empty())
    text += fmt::format(". The set recovers {:.0f} % of what a true one would.",
                        100.0 * std::clamp(d.recovered, 0.0, 1.0));
  if (const auto others = rivals_in_words(d); !others.empty())
    text += fmt::format(" This recording cannot rule out: {}.", others);
  return text;
}

}  // namespace gyrostat::gap
