#include <gyrostat/experiments/findings/failures.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/metric_type.hpp>
#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/proportion.hpp>
#include <gyrostat/analysis/statistics/running.hpp>
#include <gyrostat/core/words.hpp>

namespace gyrostat {
namespace {

std::string event(const FailureRule& rule) {
  const auto& metric = metric_types()[rule.metric];
  return fmt::format("{} {} {:g} {}", metric.id, rule.above ? "above" : "below", rule.threshold,
                     metric.unit);
}

/// "3.1e-06", three digits.
std::string probability(double p) { return fmt::format("{:.3g}", p); }

std::pair<double, double> plain_interval(const PlainFailures& plain) {
  return wilson_interval(plain.failing, plain.trials, 0.95);
}

std::string plain_text(const PlainFailures& plain) {
  const auto [low, high] = plain_interval(plain);
  return plain.failing == 0 ? fmt::format("no plain trial of {} failed (below {})", plain.trials,
                                          probability(high))
                            : fmt::format("{} of {} plain trials failed ({} to {})", plain.failing,
                                          plain.trials, probability(low), probability(high));
}

/// Nothing while it goes on, and where its runs found nothing that is rare at all.
std::optional<double> bound_of(const FailureSearch& search) {
  if (!search.asked().empty()) return {};
  std::vector<double> bounds;
  for (const auto& run : search.runs()) bounds.push_back(run.bound());
  const double bound = rarer_than(bounds);
  return bound < 1.0 ? std::optional(bound) : std::nullopt;
}

std::string unfinished(const FailureRule& rule, const FailureFinding& f) {
  const auto& search = *f.search;
  if (!search.asked().empty())
    return fmt::format("the search goes on: {} so far", counted(search.trials(), "trial"));
  std::size_t reached = 0;
  for (const auto& run : search.runs()) reached += run.reached();
  const auto runs = fmt::format("{} of {} runs reached the threshold within {} levels", reached,
                                search.runs().size(), rule.levels);
  if (!f.rarer_than) return "too rare to tell, or beyond what the metric can be: " + runs;
  return fmt::format(
      "{} is rarer than {} (97.5 % sure, by {} trials), or beyond what the metric can be: {}; more "
      "\"levels\" go further",
      event(rule), probability(*f.rarer_than), search.trials(), runs);
}

std::string sentence(const FailureRule& rule, const FailureFinding& f) {
  if (f.plain.trials == 0) return f.method + ": no finished trials";
  if (f.rare) {
    auto text = fmt::format(
        "{}: {} in {} of trials ({} to {}), by {} trials where {:.2g} plain ones would tell it as "
        "well; {}",
        f.method, event(rule), probability(f.rare->probability), probability(f.rare->low),
        probability(f.rare->high), f.search->trials(), f.rare->plain_trials(), plain_text(f.plain));
    // Under either interval alone the other would be off in one study of twenty.
    const auto [low, high] = wilson_interval(f.plain.failing, f.plain.trials, 0.999);
    if (f.rare->low > high || f.rare->high < low)
      text +=
          "; the two DISAGREE: runs may have missed a way to fail, more \"runs\" and \"samples\" "
          "show it";
    return text;
  }
  if (f.search) return f.method + ": " + unfinished(rule, f) + "; " + plain_text(f.plain);
  return f.method + ": " + event(rule) + ": " + plain_text(f.plain);
}

/// The failing trials of a method's search, in its cell with that method alone.
struct FoundFailing {
  PreparedCell alone;
  FailingMeans means;
  std::uint32_t numbers = 0;  ///< of the search
};

std::optional<FoundFailing> found_failing(const Study& study, std::uint32_t index,
                                          std::size_t method, const PreparedCell& prepared,
                                          const std::filesystem::path& folder) {
  if (!study.cells[index].failure) return std::nullopt;
  const auto store = failure_store(study, folder);
  if (!store) return std::nullopt;
  const auto& rule = *study.cells[index].failure;
  const auto at = failure_index(study, index, method);
  const FailureSearch search(rule, *store, at);
  if (!search.reached()) return std::nullopt;
  auto alone = prepared;
  alone.cell.methods = {prepared.cell.methods[method]};
  auto means = failing_means(alone, rule, search, *store, at, failure_seed(study));
  if (!means) return std::nullopt;
  return FoundFailing{std::move(alone), std::move(*means), search.numbers()};
}

/// What importance sampling says, beside what subset simulation does.
std::string second_opinion_text(const std::optional<SecondOpinion>& second,
                                const RareProbability& first, double runs) {
  const std::string by = "importance sampling along it";
  if (!second) return by + " cannot be: nothing on its way fails";
  if (!second->probability)
    return fmt::format("{} tells nothing: the direction is known too little (closeness {:.2f})", by,
                       second->closeness);
  const auto& p = *second->probability;
  return fmt::format("{}: {} ({} to {}), by {} more trials{}", by, probability(p.probability),
                     probability(p.low), probability(p.high), second->trials,
                     disagree(first, p, runs - 1.0)
                         ? fmt::format("; subset simulation has {}: the two DISAGREE, since there "
                                       "are other ways to fail, or runs have missed one",
                                       probability(first.probability))
                         : ", which agrees with subset simulation");
}

/// "white_noise" of "white_noise", "bias_steps" of "bias_steps/wait": what people know it by.
std::string input_of(const std::string& stream) {
  const auto start = stream.starts_with("calibration/") ? std::string("calibration/").size() : 0;
  return stream.substr(0, stream.find('/', start));
}

}  // namespace

std::uint32_t failure_index(const Study& study, std::uint32_t index, std::size_t method) {
  std::uint32_t at = 0;
  for (std::uint32_t c = 0; c < study.cells.size(); ++c) {
    if (!study.cells[c].failure) continue;
    for (const auto m : study.cells[c].failure->methods) {
      if (c == index && m == method) return at;
      ++at;
    }
  }
  throw InputError(study.cells[index].name,
                   "no failure is asked for of " + study.cells[index].methods[method].id);
}

std::optional<Store> failure_store(const Study& study, const std::filesystem::path& folder) {
  const auto place = folder / failure_folder;
  if (!std::filesystem::exists(place / Store::file_name)) return std::nullopt;
  auto store = Store::open(place);
  if (store.manifest().digest != failure_study(study).digest) return std::nullopt;
  return store;
}

std::vector<FailureFinding> failure_findings(const Study& study, const Store& plain,
                                             std::uint32_t index,
                                             const std::filesystem::path& folder) {
  return failure_findings(study, plain, index, failure_store(study, folder));
}

std::vector<FailureFinding> failure_findings(const Study& study, const Store& plain,
                                             std::uint32_t index,
                                             const std::optional<Store>& searches) {
  const auto& cell = study.cells[index];
  const auto& rule = *cell.failure;
  std::vector<FailureFinding> findings;
  for (const auto m : rule.methods) {
    auto& f = findings.emplace_back(
        FailureFinding{cell.methods[m].id, plain_failures(plain, index, cell, m), {}, {}, {}});
    if (f.plain.is_enough() || !searches) continue;
    f.search.emplace(rule, *searches, failure_index(study, index, m));
    if (!f.search->reached()) {
      f.rarer_than = bound_of(*f.search);
      continue;
    }
    std::vector<double> runs;
    for (const auto& run : f.search->runs()) runs.push_back(run.probability());
    f.rare = rare_probability(runs);
  }
  return findings;
}

Table failure_table(const Cell& cell, const std::vector<FailureFinding>& findings) {
  const auto& rule = *cell.failure;
  Table table{.title = fmt::format("{}: how likely is {}", cell.name, event(rule)),
              .columns = {{"method", ""},
                          {"probability", ""},
                          {"2.5 %", ""},
                          {"97.5 %", ""},
                          {"reliability index", ""},
                          {"by", ""},
                          {"trials", ""},
                          {"plain trials for the same", ""},
                          {"plain failing", ""}}};
  for (const auto& f : findings) {
    const auto plain = out_of(f.plain.failing, f.plain.trials);
    if (f.rare) {
      table.rows.push_back({f.method, f.rare->probability, f.rare->low, f.rare->high,
                            gyrostat::cell(f.rare->reliability_index()), "subset simulation",
                            std::int64_t{f.search->trials()},
                            gyrostat::cell(f.rare->plain_trials()), plain});
    } else if (f.plain.is_enough()) {
      const auto [low, high] = plain_interval(f.plain);
      const double p = static_cast<double>(f.plain.failing) / f.plain.trials;
      table.rows.push_back({f.method, p, low, high,
                            p < 1.0 ? TableCell(normal_upper_quantile(p)) : TableCell(),
                            "plain trials", std::int64_t{f.plain.trials},
                            static_cast<double>(f.plain.trials), plain});
    } else {
      table.rows.push_back({f.method,
                            {},
                            {},
                            f.rarer_than ? TableCell(*f.rarer_than) : TableCell(),
                            {},
                            f.rarer_than ? "subset simulation, rarer than" : "not told",
                            f.search ? TableCell(std::int64_t{f.search->trials()}) : TableCell(),
                            {},
                            plain});
    }
    table.notes.push_back(sentence(rule, f));
  }
  return table;
}

Table failure_levels(const Cell& cell, const std::vector<FailureFinding>& findings) {
  const auto& rule = *cell.failure;
  Table table{.title = cell.name + ": levels of subset simulation",
              .columns = {{"method", ""},
                          {"level", ""},
                          {"runs", ""},
                          {"threshold", std::string(metric_types()[rule.metric].unit)},
                          {"share above", ""},
                          {"acceptance", ""},
                          {"spread", ""},
                          {"probability so far", ""}}};
  if (!rule.above) table.columns[4].name = "share below";
  for (const auto& f : findings) {
    if (!f.search) continue;
    for (std::size_t l = 0;; ++l) {
      Running threshold, share, acceptance, spread, so_far;
      for (const auto& run : f.search->runs()) {
        if (run.levels().size() <= l) continue;
        const auto& level = run.levels()[l];
        double product = 1.0;
        for (std::size_t k = 0; k <= l; ++k) product *= run.levels()[k].share;
        threshold.add(rule.above ? level.threshold : -level.threshold);
        share.add(level.share);
        if (l > 0) acceptance.add(level.acceptance);
        spread.add(level.spread);
        so_far.add(product);
      }
      if (share.count == 0.0) break;
      table.rows.push_back({f.method, static_cast<std::int64_t>(l + 1),
                            static_cast<std::int64_t>(share.count), threshold.mean, share.mean,
                            l > 0 ? TableCell(acceptance.mean) : TableCell(), spread.mean,
                            so_far.mean});
    }
  }
  table.notes = {"means over the runs that had the level; a chain's acceptance is adapted to 0.44"};
  return table;
}

std::optional<FailureSignal> found_signal(const Study& study, std::uint32_t index,
                                          std::size_t method, const PreparedCell& prepared,
                                          const std::filesystem::path& folder) {
  const auto found = found_failing(study, index, method, prepared, folder);
  if (!found) return std::nullopt;
  return failure_signal(found->alone, *study.cells[index].failure, found->means,
                        failure_seed(study));
}

std::optional<FailureHow> how_it_fails(const Study& study, std::uint32_t index, std::size_t method,
                                       const PreparedCell& prepared,
                                       const std::filesystem::path& folder) {
  const auto found = found_failing(study, index, method, prepared, folder);
  if (!found) return std::nullopt;
  const auto& rule = *study.cells[index].failure;
  const auto signal = failure_signal(found->alone, rule, found->means, failure_seed(study));
  if (!signal) return std::nullopt;
  return FailureHow{*signal, second_opinion(found->alone, rule, found->means, found->numbers,
                                            failure_seed(study))};
}

Table driver_table(const Study& study, const Cell& cell, const FailureFinding& finding,
                   const FailureHow& how) {
  const auto& signal = how.signal;
  Table table{.title = fmt::format("{}: how {} fails", cell.name, finding.method),
              .columns = {{"input", ""}, {"share of the design point", "%"}}};
  std::map<std::string, double> inputs;
  for (const auto& [stream, share] : signal.drivers) inputs[input_of(stream)] += share;
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, share] : inputs) order.emplace_back(-share, name);
  std::sort(order.begin(), order.end());
  for (const auto& [share, name] : order) table.rows.push_back({name, -100.0 * share});
  table.notes.push_back(
      fmt::format("the most likely failing signal: gyrostat replay {}:{}:failure:{} --steps",
                  study.name(), cell.name, finding.method));
  if (signal.same_side < 0.99)
    table.notes.push_back(
        fmt::format("{:.0f} % of the failing trials err to its side, the others to the other",
                    100.0 * signal.same_side));
  if (!finding.rare) return table;
  const double p = std::min(1.0, normal_upper_tail(signal.distance) / signal.same_side);
  const bool agrees = finding.rare->low / 2.0 <= p && p <= finding.rare->high * 2.0;
  table.notes.push_back(fmt::format(
      "it lies {:.2f} standard deviations from no noise at all; were it the only way to fail, and "
      "the "
      "failure's edge flat, the probability would be {}{}",
      signal.distance, probability(p),
      agrees ? ", which agrees with subset simulation"
             : fmt::format(
                   ", where subset simulation has {}: there are other ways to fail, or the edge is "
                   "curved",
                   probability(finding.rare->probability))));
  table.notes.push_back(second_opinion_text(how.second, *finding.rare,
                                            static_cast<double>(finding.search->runs().size())));
  return table;
}

}  // namespace gyrostat
