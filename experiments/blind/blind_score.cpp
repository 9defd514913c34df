#include <gyrostat/experiments/blind/blind_score.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/statistics/proportion.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/verdict.hpp>
#include <gyrostat/experiments/blind/blind_labels.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat::gap {
namespace {

namespace fs = std::filesystem;

using Counts = std::map<std::string, double>;

/// Hits among so many.
struct Share {
  double hits = 0, count = 0;

  void add(bool hit) {
    hits += hit ? 1.0 : 0.0;
    count += 1.0;
  }
  Share& operator+=(const Share& other) {
    hits += other.hits;
    count += other.count;
    return *this;
  }
  TableCell percent() const { return cell(count > 0 ? 100.0 * hits / count : no_value); }
  TableCell bound(bool upper) const {
    if (count == 0) return {};
    const auto [low, high] = wilson_interval(hits, count, 0.95);
    return 100.0 * (upper ? high : low);
  }
  TableCell text() const {
    if (count == 0) return {};
    const auto [low, high] = wilson_interval(hits, count, 0.95);
    return fmt::format("{:.0f} % ({:.0f} of {:.0f}; {:.0f} to {:.0f})", 100.0 * hits / count, hits,
                       count, 100.0 * low, 100.0 * high);
  }
  TableCell plain() const {
    return count == 0 ? TableCell() : fmt::format("{:.0f} of {:.0f}", hits, count);
  }
};

struct Tally {
  Share first, both, covered, abstained;
  double members = 0, unknown = 0, none = 0;
  std::vector<double> closed;
  Counts named, named_without;

  Tally& operator+=(const Tally& t) {
    first += t.first, both += t.both, covered += t.covered, abstained += t.abstained;
    members += t.members, unknown += t.unknown, none += t.none;
    closed.insert(closed.end(), t.closed.begin(), t.closed.end());
    return *this;
  }
  double mean_members() const { return members / first.count; }
  TableCell median_closed() const {
    auto sorted = closed;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? TableCell() : cell(sorted[sorted.size() / 2]);
  }
};

/// How often causes of a stated probability are right, and the sum of what was stated.
struct Reliability {
  Share right;
  double stated = 0;
};

std::string name_of(const BlindLabel& label) {
  return label.effects.empty() ? Verdict::none().text()
                               : fmt::format("{}", fmt::join(label.effects, " + "));
}

Verdict verdict_in(const Json& text) { return Verdict::of(text.get<std::string>()); }

std::string in_words(const Counts& named, const std::string& but = "") {
  std::vector<std::string> others;
  for (const auto& [name, times] : named)
    if (name != but) others.push_back(fmt::format("{} {:.0f}", name, times));
  return fmt::format("{}", fmt::join(others, ", "));
}

class Score {
 public:
  explicit Score(std::string title) : title_(std::move(title)) {}

  void add(const BlindLabel& label, const fs::path& folder) {
    const auto path = diagnosis_of(folder, label.number, false);
    if (!fs::exists(path)) {
      missing_ += 1;
      return;
    }
    auto& tally = tallies_[{label.strength, name_of(label)}];
    add_diagnosis(label, read_json(path.string()), tally);
    if (const auto without = diagnosis_of(folder, label.number, true); fs::exists(without)) {
      const auto verdict = verdict_in(read_json(without.string()).at("verdict"));
      tally.abstained.add(verdict.is_unknown() || verdict.is_none());
      tally.named_without[verdict.text()] += 1;
    }
  }

  std::vector<NamedTable> tables() const {
    std::vector<NamedTable> all = {{"aims", aims()},
                                   {"effects", effects()},
                                   {"left_out", left_out()},
                                   {"calibration", calibration()}};
    if (durations_s_.size() > 1) {
      all.push_back({"power", power()});
      all.push_back({"lengths", lengths()});
    }
    return all;
  }

 private:
  void add_diagnosis(const BlindLabel& label, const Json& found, Tally& t);
  Table aims() const;
  Table effects() const;
  Table left_out() const;
  Table calibration() const;
  Table power() const;
  Table lengths() const;

  std::string title_;
  std::map<std::pair<std::string, std::string>, Tally> tallies_;  ///< strength, effects
  std::array<Reliability, 5> reliability_{};
  std::set<double> durations_s_;
  std::set<std::string> strengths_;
  /// Of single effects, and of none: effect, strength, duration.
  std::map<std::tuple<std::string, std::string, double>, Share> power_;
  double missing_ = 0;
};

void Score::add_diagnosis(const BlindLabel& label, const Json& found, Tally& t) {
  const auto verdict = verdict_in(found.at("verdict"));
  const auto is_true = [&](const Verdict& said) {
    return label.effects.empty() ? said.is_none()
                                 : std::any_of(label.effects.begin(), label.effects.end(),
                                               [&](const auto& e) { return said.names(e); });
  };
  std::vector<Verdict> set;
  for (const auto& member : found.at("verdict_set")) set.push_back(verdict_in(member));
  const bool right = is_true(verdict);
  t.first.add(right);
  t.covered.add(right || std::any_of(set.begin(), set.end(), is_true));
  t.named[verdict.text()] += 1;
  t.unknown += verdict.is_unknown();
  t.none += verdict.is_none();
  t.members += static_cast<double>(std::max<std::size_t>(set.size(), 1));
  t.closed.push_back(found.at("gap").at("closed").get<double>());
  if (label.effects.size() == 2) {
    std::set<std::string> added;
    for (const auto& step : found.at("steps")) added.insert(step.at("added").get<std::string>());
    t.both.add(added.contains(label.effects[0]) && added.contains(label.effects[1]));
    return;
  }
  durations_s_.insert(label.duration_s);
  strengths_.insert(label.strength);
  power_[{name_of(label), label.strength, label.duration_s}].add(right);
  for (const auto& cause : found.at("causes")) {
    if (label.effects.empty()) break;
    const double stated = cause.at("probability").get<double>();
    auto& bin = reliability_[std::min<std::size_t>(4, static_cast<std::size_t>(5.0 * stated))];
    bin.stated += stated;
    bin.right.add(is_true(verdict_in(cause.at("effect"))));
  }
}

Table Score::aims() const {
  std::map<std::string, Tally> totals;
  for (const auto& [key, t] : tallies_) {
    const auto& [strength, effects] = key;
    const bool pair = effects.find(" + ") != std::string::npos;
    const bool is_none = Verdict::of(effects).is_none();
    totals[is_none ? effects : pair ? "two effects, " + strength : strength] += t;
  }
  Table table{.title = title_,
              .columns = {{"recordings", ""},
                          {"named first", ""},
                          {"both named", ""},
                          {"in the set", ""},
                          {"members", ""},
                          {"median closed", "1"},
                          {"abstained without it", ""}},
              .notes = {"shares with 95 % Wilson intervals, in %; for \"none\", named first is the "
                        "share without a false alarm"}};
  for (const auto& [name, t] : totals)
    table.rows.push_back({name, t.first.text(), t.both.text(), t.covered.text(), t.mean_members(),
                          t.median_closed(), t.abstained.text()});
  if (missing_ > 0)
    table.notes.push_back(fmt::format("{:.0f} recordings have no diagnosis", missing_));
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
  for (const auto& [key, t] : tallies_)
    table.rows.push_back({key.second, key.first, t.first.text(), t.covered.text(), t.mean_members(),
                          t.median_closed(), t.unknown, t.none, in_words(t.named, key.second)});
  return table;
}

Table Score::left_out() const {
  Table table{.title = title_ + ": with the effect left out of the catalogue",
              .columns = {{"effect", ""}, {"abstained", ""}, {"verdicts", ""}}};
  for (const auto& [key, t] : tallies_)
    if (t.abstained.count > 0)
      table.rows.push_back({key.second, t.abstained.text(), in_words(t.named_without)});
  return table;
}

Table Score::calibration() const {
  Table table{.title = title_ + ": are the probabilities right?",
              .columns = {{"stated", ""}, {"causes", ""}, {"mean stated", "1"}, {"right", ""}}};
  for (std::size_t k = 0; k < reliability_.size(); ++k) {
    const auto& c = reliability_[k];
    const double from = 0.2 * static_cast<double>(k);
    table.rows.push_back({fmt::format("{:.1f} to {:.1f}", from, from + 0.2), c.right.count,
                          cell(c.right.count > 0 ? c.stated / c.right.count : no_value),
                          c.right.text()});
  }
  return table;
}

Table Score::power() const {
  Table table{.title = title_ + ": named first, by effect and length",
              .columns = {{"effect", ""}, {"strength", ""}}};
  for (const double duration_s : durations_s_)
    table.columns.push_back({fmt::format("{:g} s", duration_s), ""});
  std::set<std::pair<std::string, std::string>> rows;
  for (const auto& [key, share] : power_) rows.insert({std::get<0>(key), std::get<1>(key)});
  for (const auto& [effect, strength] : rows) {
    auto& row = table.rows.emplace_back(std::vector<TableCell>{effect, strength});
    for (const double duration_s : durations_s_) {
      const auto share = power_.find({effect, strength, duration_s});
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
  for (const double duration_s : durations_s_) {
    auto& row = table.rows.emplace_back(std::vector<TableCell>{duration_s});
    for (const auto& strength : strengths_) {
      Share all;
      for (const auto& [key, share] : power_)
        if (std::get<1>(key) == strength && std::get<2>(key) == duration_s) all += share;
      row.insert(row.end(), {all.percent(), all.bound(false), all.bound(true)});
    }
  }
  return table;
}

}  // namespace

std::vector<NamedTable> score_recordings(const std::string& title, const fs::path& folder) {
  Score score(title);
  for (const auto& label : open_labels(folder)) score.add(label, folder);
  return score.tables();
}

}  // namespace gyrostat::gap
