#include <gyrostat/experiments/findings/report/rank_picture.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace gyrostat {
namespace {

/// Maximal runs of methods that the critical difference spans, each by rank; a run that another
/// contains is none.
std::vector<std::vector<RankedMethod>> runs(const CellRanking& ranking) {
  auto methods = ranking.methods;
  std::erase_if(methods, [](const auto& m) { return !std::isfinite(m.mean_rank); });
  std::stable_sort(methods.begin(), methods.end(),
                   [](const auto& a, const auto& b) { return a.mean_rank < b.mean_rank; });
  std::vector<std::vector<RankedMethod>> all;
  for (auto from = methods.begin(), reached = from; from != methods.end(); ++from) {
    const auto to = std::find_if(from, methods.end(), [&](const auto& m) {
      return !(m.mean_rank - from->mean_rank <= ranking.critical_difference);
    });
    if (to - from > 1 && to > reached) all.emplace_back(from, to);
    reached = std::max(reached, to);
  }
  return all;
}

/// The bars, a few to a row below the methods.
void add_bars(Picture& picture, const CellRanking& ranking) {
  constexpr std::size_t to_a_row = 3;
  const auto bars = runs(ranking);
  const auto first_row = static_cast<double>(picture.y.names.size());
  for (std::size_t b = 0; b < bars.size(); ++b) {
    if (b % to_a_row == 0) picture.y.names.push_back(b == 0 ? "alike in rank" : "");
    Mark bar;
    bar.colour = "ink";
    bar.strong = true;
    bar.x = {bars[b].front().mean_rank, bars[b].back().mean_rank};
    bar.y.assign(2, first_row + static_cast<double>(b / to_a_row) +
                        0.28 * (static_cast<double>(b % to_a_row) - 1.0));
    std::string names;
    for (const auto& m : bars[b]) names += (names.empty() ? "" : ", ") + m.method;
    bar.labels.assign(2, names);
    picture.marks.push_back(std::move(bar));
  }
}

}  // namespace

Picture rank_picture(const CellRanking& ranking, const MethodColours& colours,
                     const std::string& id) {
  Picture picture{.id = id,
                  .title = "Critical differences",
                  .note = fmt::format("By {}, over {} trials, each method ranked in each trial. A "
                                      "grey line links methods whose means are not separable.",
                                      ranking.metric, ranking.trials),
                  .x = {.label = "mean rank over trials (1 is best)"}};
  const auto& methods = ranking.methods;
  for (const auto& group : ranking.not_separable) {
    if (group.size() < 2) continue;
    Mark link;
    link.colour = "soft";
    for (const std::size_t i : group)
      link.x.push_back(methods[i].mean_rank), link.y.push_back(static_cast<double>(i));
    picture.marks.push_back(std::move(link));
  }
  for (std::size_t i = 0; i < methods.size(); ++i) {
    picture.y.names.push_back(methods[i].method);
    if (std::isnan(methods[i].mean_rank)) continue;
    auto dot = colours.mark(Mark::Kind::points, methods[i].method);
    const double half = 0.5 * ranking.critical_difference;
    dot.x = {methods[i].mean_rank}, dot.y = {static_cast<double>(i)};
    if (half >= 0.0) dot.x_low = {dot.x[0] - half}, dot.x_high = {dot.x[0] + half};
    dot.labelled = true;
    dot.labels = {fmt::format("{:.2f}", methods[i].mean_rank)};
    picture.marks.push_back(std::move(dot));
  }
  if (!(ranking.critical_difference >= 0.0)) return picture;
  picture.note += fmt::format(
      " Whiskers: half the critical difference ({:.3g}, Nemenyi), so methods whose whiskers do not "
      "overlap differ in rank",
      ranking.critical_difference);
  const auto methods_alone = picture.marks.size();
  add_bars(picture, ranking);
  picture.note += picture.marks.size() > methods_alone ? "; a bar below spans methods that do not."
                                                       : ", as all do here.";
  return picture;
}

}  // namespace gyrostat
