#include <gyrostat/experiments/findings/ranking_words.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/core/words.hpp>
#include <gyrostat/results/render/interval.hpp>

namespace gyrostat {
namespace {

/// 2400 as "2,400".
std::string grouped(double count) {
  auto text = fmt::format("{:.0f}", count);
  for (auto at = static_cast<int>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), ",");
  return text;
}

class Speaker {
 public:
  Speaker(const Cell& cell, const CellRanking& ranking) : cell_(cell), ranking_(ranking) {
    for (std::size_t i = 0; i < ranking.methods.size(); ++i) {
      const auto& role = role_of(ranking.methods[i].method);
      if (role.is_contender()) contenders_.push_back(i);
      if (role.is_bound()) bounds_.push_back(i);
    }
    if (contenders_.empty())
      for (std::size_t i = 0; i < ranking.methods.size(); ++i) contenders_.push_back(i);
  }

  std::vector<std::string> all() {
    if (ranking_.trials < 2 || contenders_.empty()) return {};
    winner();
    for (std::size_t i = 0; i + 1 < contenders_.size(); ++i)
      compare(contenders_[i], contenders_[i + 1]);
    against_none();
    for (const auto bound : bounds_) compare(bound, contenders_.front());
    groups();
    tails();
    failures();
    ranks();
    return std::move(sentences_);
  }

 private:
  const Role& role_of(const std::string& id) const {
    return std::find_if(cell_.methods.begin(), cell_.methods.end(),
                        [&](const Method& method) { return method.id == id; })
        ->role();
  }
  const std::string& name(std::size_t i) const { return ranking_.methods[i].method; }
  const RankedPair& pair(std::size_t a, std::size_t b) const {
    return *std::find_if(ranking_.pairs.begin(), ranking_.pairs.end(), [&](const RankedPair& p) {
      return (p.better == a && p.worse == b) || (p.better == b && p.worse == a);
    });
  }
  /// In the metric's unit, of signals of a dps or so: what is left of it is rounding.
  static constexpr double exact = 1e-13;

  void say(std::string sentence) { sentences_.push_back(std::move(sentence)); }

  void winner() {
    const auto best = contenders_.front();
    const auto& m = ranking_.methods[best];
    if (std::isnan(m.mean)) return say("no method has a value");
    if (std::all_of(contenders_.begin(), contenders_.end(), [&](std::size_t other) {
          return std::abs(ranking_.methods[other].mean) <= exact;
        }))
      return say(
          "every filter is exact to rounding, so none is better: this scenario has nothing to "
          "estimate. Does its signal have measurement noise (R)?");
    std::vector<std::string> near;
    for (const auto other : contenders_)
      if (other != best && !pair(best, other).difference.separable) near.push_back(name(other));
    say(fmt::format("{} has the smallest {}, on average over {} trials: {} {}; {}", name(best),
                    metric_types().named(ranking_.metric, "ranking").title,
                    grouped(static_cast<double>(ranking_.trials)),
                    with_half_width(m.mean, m.half_width), ranking_.unit,
                    contenders_.size() == 1 ? "nothing else was tried"
                    : near.empty()
                        ? "it beats every other filter"
                        : "not separable from " + fmt::format("{}", fmt::join(near, ", "))));
  }

  void compare(std::size_t better, std::size_t worse) {
    const auto& p = pair(better, worse);
    const auto& d = p.difference;
    if (std::isnan(d.mean) || std::isnan(d.low)) return;
    constexpr double rounding = 1e-9;
    const auto gap = with_interval(d.mean, d.low, d.high) + " " + ranking_.unit;
    if (std::abs(d.mean) <= std::max(exact, rounding * std::abs(ranking_.methods[p.better].mean)))
      return say(fmt::format("{} and {} are equal to rounding", name(p.better), name(p.worse)));
    if (d.separable && d.mean > 0.0)
      return say(fmt::format("{} beats {} in {} by {}", name(p.better), name(p.worse),
                             ranking_.metric, gap));
    const double more = d.trials_needed - static_cast<double>(d.count);
    say(fmt::format("{} and {} are not separable ({}){}", name(p.better), name(p.worse), gap,
                    more > 0.0 ? fmt::format("; about {} more trial{} needed", grouped(more),
                                             more < 1.5 ? "" : "s")
                               : "; as many trials again may tell"));
  }

  void against_none() {
    for (std::size_t i = 0; i < ranking_.methods.size(); ++i)
      if (role_of(name(i)).is_floor() && i != contenders_.front()) compare(contenders_.front(), i);
  }

  void groups() {
    constexpr std::size_t told = 16;
    std::vector<std::string> texts;
    for (const auto& group : ranking_.not_separable) {
      if (texts.size() == told) {
        texts.push_back("and other groups");
        break;
      }
      std::vector<std::string> names;
      for (const auto i : group) names.push_back(name(i));
      texts.push_back(fmt::format("{}", fmt::join(names, " = ")));
    }
    if (!texts.empty())
      say(fmt::format("not separable from each other: {}", fmt::join(texts, "; ")));
  }

  void tails() {
    const auto least = [&](auto value) {
      return *std::min_element(contenders_.begin(), contenders_.end(), [&](auto a, auto b) {
        return value(ranking_.methods[a]) < value(ranking_.methods[b]);
      });
    };
    const auto tail = least([](const RankedMethod& m) { return m.cvar95; });
    const auto& m = ranking_.methods[tail];
    const auto interval = std::isnan(m.cvar95_low) ? std::string()
                                                   : fmt::format(" (95 %: {:.4g} to {:.4g})",
                                                                 m.cvar95_low, m.cvar95_high);
    say(fmt::format("in the worst 5 % of its trials {} is best{}: {:.4g}{} {}", name(tail),
                    tail == contenders_.front() ? ", too" : ", not " + name(contenders_.front()),
                    m.cvar95, interval, ranking_.unit));
    const auto worst = least([](const RankedMethod& r) { return r.worst; });
    say(fmt::format("{} has the mildest worst trial: {:.4g} {}", name(worst),
                    ranking_.methods[worst].worst, ranking_.unit));
  }

  void failures() {
    for (const auto& m : ranking_.methods)
      if (m.missing > 0)
        say(fmt::format("{} has no value in {}, not in its mean and ranked last", m.method,
                        counted(m.missing, "trial")));
  }

  void ranks() {
    if (std::isnan(ranking_.critical_difference)) return;
    say(fmt::format(
        "mean ranks that differ by more than {:.3g} are separable (Nemenyi, 95 %, all pairs); "
        "Friedman's test that all are alike: p {}",
        ranking_.critical_difference, chance_in_words(ranking_.friedman_p)));
  }

  const Cell& cell_;
  const CellRanking& ranking_;
  std::vector<std::size_t> contenders_, bounds_;
  std::vector<std::string> sentences_;
};

}  // namespace

std::vector<std::string> ranking_sentences(const Cell& cell, const CellRanking& ranking) {
  return Speaker(cell, ranking).all();
}

std::string answer_in_words(std::span<const CellRanking> rankings) {
  std::map<std::string, std::size_t> won;
  std::set<std::string> metrics;
  std::size_t cells = 0, shared = 0;
  const CellRanking* last = nullptr;
  for (const auto& ranking : rankings) {
    if (ranking.winner.empty()) continue;
    ++won[ranking.winner];
    metrics.insert(ranking.metric);
    ++cells;
    shared += ranking.winner_is_shared;
    last = &ranking;
  }
  if (cells == 0) return "";
  if (cells == 1) {
    auto text = last->sentences.front() + ".";
    if (last->sentences.size() > 1) text += " " + last->sentences[1] + ".";
    return text;
  }
  std::vector<std::pair<std::string, std::size_t>> order(won.begin(), won.end());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  auto text = fmt::format("By {}, {} is best in {} of {} cells", fmt::join(metrics, " and "),
                          order.front().first, order.front().second, cells);
  for (std::size_t i = 1; i < order.size(); ++i)
    text += fmt::format(", {} in {}", order[i].first, order[i].second);
  return text + (shared == 0 ? ". In each of them it is separable from every other filter."
                             : fmt::format(". In {} {} not separable from another filter.", shared,
                                           shared == 1 ? "it is" : "the best is"));
}

}  // namespace gyrostat
