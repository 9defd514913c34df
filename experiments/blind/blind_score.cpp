#include <gyrostat/experiments/blind/blind_score.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/experiments/blind/blind_tally.hpp>

namespace gyrostat::gap {
namespace {

namespace fs = std::filesystem;

bool is_set(const std::string& name) { return name.find(" + ") != std::string::npos; }

class Score {
 public:
  explicit Score(std::string title) : title_(std::move(title)) {}

  void add(const BlindLabel& label, const AnswerOf& answer_of) {
    const auto path = answer_of(label.number, false);
    if (!fs::exists(path)) {
      missing_ += 1;
      return;
    }
    auto& of_effect = by_effect_[{label.strength, name_of(label)}];
    Tally t;
    scored_.push_back({label, without_own(read_answer(path), label)});
    add_answer(scored_.back(), t);
    if (const auto without = answer_of(label.number, true); fs::exists(without))
      t.add_left_out(scored_.back(), without_own(read_answer(without), label));
    for (const auto& [name, times] : t.named) of_effect.named[name] += times;
    of_effect += t;
    by_kind_[kind_of(label)] += t;
    by_scenario_[{label.scenario, kind_of(label)}] += t;
    scenarios_.insert(label.scenario);
  }

  std::vector<NamedTable> tables() const {
    std::vector<NamedTable> all = {{"aims", aims()}};
    if (scenarios_.size() > 1) all.push_back({"scenarios", by_scenario()});
    all.push_back({"effects", effects()});
    all.push_back({"left_out", left_out()});
    if (std::any_of(scored_.begin(), scored_.end(),
                    [](const auto& s) { return s.label.effects.size() > 1; })) {
      all.push_back({"sets", set_table(title_, scored_)});
      all.push_back({"set_effects", set_effects_table(title_, scored_)});
    }
    all.push_back({"calibration", inclusion_table(title_, scored_)});
    all.push_back({"closed", closed_table(title_, scored_)});
    if (samplings_.size() > 1) {
      all.push_back({"power", power()});
      all.push_back({"lengths", lengths()});
    }
    return all;
  }

 private:
  void add_answer(const Scored& scored, Tally& t);
  Table aims() const;
  Table by_scenario() const;
  Table effects() const;
  Table left_out() const;
  Table power() const;
  Table lengths() const;

  using Length = std::pair<double, double>;  ///< s, Hz

  std::string title_;
  std::vector<Scored> scored_;
  std::map<std::pair<std::string, std::string>, Tally> by_effect_;  ///< strength, effects
  std::map<std::string, Tally> by_kind_;
  std::map<std::pair<std::string, std::string>, Tally> by_scenario_;
  std::set<std::string> scenarios_, strengths_;
  std::set<Length> samplings_;
  /// Of single effects, and of none: effect, strength, length.
  std::map<std::tuple<std::string, std::string, Length>, Share> power_;
  double missing_ = 0;
};

void Score::add_answer(const Scored& scored, Tally& t) {
  t.add(scored);
  const auto& label = scored.label;
  if (label.effects.size() > 1) return;
  const Length length{label.duration_s, label.rate_hz};
  samplings_.insert(length);
  strengths_.insert(label.strength);
  power_[{name_of(label), label.strength, length}].add(is_right(scored.answer.verdict, label));
}

Table Score::aims() const {
  Table table{.title = title_,
              .columns = {{"recordings", ""},
                          {"gap seen", ""},
                          {"named first", ""},
                          {"all named", ""},
                          {"in the set", ""},
                          {"members", ""},
                          {"median closed", "1"},
                          {"abstained without it", ""},
                          {"unknown alone", ""}},
              .notes = {"shares with 95 % Wilson intervals, in %; for \"none\", named first is the "
                        "share without a false alarm; gap seen: any verdict but \"none\""}};
  for (const auto& [name, t] : by_kind_)
    table.rows.push_back({name, t.detected.text(), t.first.text(), t.all_named.text(),
                          t.covered.text(), t.mean_members(), t.median_closed(), t.abstained.text(),
                          t.unknown_alone.text()});
  if (missing_ > 0)
    table.notes.push_back(fmt::format("{:.0f} recordings have no diagnosis", missing_));
  return table;
}

Table Score::by_scenario() const {
  Table table{.title = title_ + ": by scenario",
              .columns = {{"scenario", ""},
                          {"recordings", ""},
                          {"named first", ""},
                          {"all named", ""},
                          {"in the set", ""},
                          {"median closed", "1"},
                          {"unknown", ""},
                          {"none", ""}}};
  for (const auto& [key, t] : by_scenario_)
    table.rows.push_back({key.first, key.second, t.first.text(), t.all_named.text(),
                          t.covered.text(), t.median_closed(), t.unknown, t.none});
  return table;
}

Table Score::effects() const {
  Table table{.title = title_ + ": by effect",
              .columns = {{"effect", ""},
                          {"strength", ""},
                          {"named first", ""},
                          {"in the set", ""},
                          {"members", ""},
                          {"median closed", "1"},
                          {"unknown", ""},
                          {"none", ""},
                          {"taken for", ""}}};
  for (const auto& [key, t] : by_effect_) {
    if (is_set(key.second)) continue;
    const auto name = key.second.substr(0, key.second.find(" ("));
    table.rows.push_back({key.second, key.first, t.first.text(), t.covered.text(), t.mean_members(),
                          t.median_closed(), t.unknown, t.none, in_words(t.named, name)});
  }
  return table;
}

Table Score::left_out() const {
  Table table{
      .title = title_ + ": with the effect left out of the catalogue",
      .columns = {{"effect", ""},
                  {"abstained", ""},
                  {"unknown alone", ""},
                  {"verdicts", ""},
                  {"log score lost by a name", "nat"}},
      .notes = {"what a name for it loses against the whole catalogue, where both count the same "
                "samples: a few nats are no reason to abstain"}};
  Tally singles;
  for (const auto& [key, t] : by_effect_) {
    if (t.abstained.count == 0 || is_set(key.second)) continue;
    table.rows.push_back({key.second, t.abstained.text(), t.unknown_alone.text(),
                          in_words(t.named_without), in_order(t.lost_by_a_name)});
    singles += t;
  }
  if (singles.abstained.count > 0)
    table.rows.push_back({"all", singles.abstained.text(), singles.unknown_alone.text(), "",
                          in_order(singles.lost_by_a_name)});
  return table;
}

Table Score::power() const {
  Table table{.title = title_ + ": named first, by effect and length",
              .columns = {{"effect", ""}, {"strength", ""}}};
  std::set<double> rates;
  for (const auto& [duration_s, rate_hz] : samplings_) rates.insert(rate_hz);
  for (const auto& [duration_s, rate_hz] : samplings_)
    table.columns.push_back({rates.size() == 1
                                 ? fmt::format("{:g} s", duration_s)
                                 : fmt::format("{:g} s at {:g} Hz", duration_s, rate_hz),
                             ""});
  std::set<std::pair<std::string, std::string>> rows;
  for (const auto& [key, share] : power_) rows.insert({std::get<0>(key), std::get<1>(key)});
  for (const auto& [effect, strength] : rows) {
    auto& row = table.rows.emplace_back(std::vector<TableCell>{effect, strength});
    for (const auto& length : samplings_) {
      const auto share = power_.find({effect, strength, length});
      row.push_back(share == power_.end() ? TableCell() : share->second.plain());
    }
  }
  return table;
}

Table Score::lengths() const {
  Table table{.title = title_ + ": named first, over all effects",
              .columns = {{"length", "s"}},
              .notes = {"95 % Wilson intervals; for no effect, the share without a false alarm"}};
  const auto heading = [](const std::string& strength) {
    return strength.empty() ? std::string("no effect") : strength;
  };
  for (const auto& strength : strengths_)
    for (const auto* bound : {"", "lower ", "upper "})
      table.columns.push_back({bound + heading(strength), "%"});
  std::set<double> durations_s;
  for (const auto& [duration_s, rate_hz] : samplings_) durations_s.insert(duration_s);
  for (const double duration_s : durations_s) {
    auto& row = table.rows.emplace_back(std::vector<TableCell>{duration_s});
    for (const auto& strength : strengths_) {
      Share all;
      for (const auto& [key, share] : power_)
        if (std::get<1>(key) == strength && std::get<2>(key).first == duration_s) all += share;
      row.insert(row.end(), {all.percent(), all.bound(false), all.bound(true)});
    }
  }
  return table;
}

}  // namespace

std::vector<NamedTable> score(const std::string& title, const std::vector<BlindLabel>& labels,
                              const AnswerOf& answer_of) {
  Score score(title);
  for (const auto& label : labels) score.add(label, answer_of);
  return score.tables();
}

std::vector<NamedTable> score_recordings(const std::string& title, const fs::path& folder) {
  return score(title, open_labels(folder), [&](std::size_t number, bool left_out) {
    return diagnosis_of(folder, number, left_out);
  });
}

}  // namespace gyrostat::gap
