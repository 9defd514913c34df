#include <algorithm>
#include <cmath>

#include <gyrostat/experiments/findings/report/design_pictures.hpp>

namespace gyrostat {
namespace {

/// A picture with a row for each parameter; each method has its own marks, of which one is seen.
Picture by_parameter(const std::string& id, const std::string& title, const std::string& x,
                     const std::string& unit, const std::string& note,
                     std::vector<std::string> parameters) {
  return {.id = id,
          .title = title,
          .note = note,
          .x = {x, unit},
          .y = {"", "", false, std::move(parameters)},
          .exclusive = true};
}

void add(Mark& mark, double row, const Estimate& e) {
  mark.x.push_back(e.value);
  mark.x_low.push_back(e.low);
  mark.x_high.push_back(e.high);
  mark.y.push_back(row);
}

double row_of(const std::vector<std::string>& parameters, const std::string& name) {
  return static_cast<double>(std::find(parameters.begin(), parameters.end(), name) -
                             parameters.begin());
}

/// Parameters by the size that the first method gives them, the largest on top.
template <class T, class Size>
std::vector<std::string> by_size(std::vector<T> list, const Size& size) {
  std::stable_sort(list.begin(), list.end(),
                   [&](const T& a, const T& b) { return size(a) > size(b); });
  std::vector<std::string> names;
  for (const auto& entry : list) names.push_back(entry.parameter);
  return names;
}

Picture tornado(const std::vector<Sensitivity>& all, const MethodColours& colours,
                const std::string& id) {
  auto picture =
      by_parameter(id + "-tornado", "Elasticity of " + all.front().metric, "elasticity", "1",
                   "One parameter at a time around the base, with 95 % intervals: 1 means 10 % "
                   "more of the parameter "
                   "gives 10 % more error.",
                   by_size(all.front().elasticities,
                           [](const Elasticity& e) { return std::abs(e.value.value); }));
  for (const auto& s : all) {
    auto bars = colours.mark(Mark::Kind::bars, s.method);
    bars.shown = &s == &all.front();
    for (const auto& e : s.elasticities) add(bars, row_of(picture.y.names, e.parameter), e.value);
    picture.marks.push_back(std::move(bars));
  }
  return picture;
}

Picture sobol(const std::vector<Sensitivity>& all, const MethodColours& colours,
              const std::string& id) {
  auto picture = by_parameter(
      id + "-sobol", "Sobol' indices of " + all.front().metric, "share of the variance", "1",
      "Bars: total index, what a parameter does alone and with others; dots: first order, what it "
      "does "
      "alone; each with its 95 % interval. The noise of the trials is taken out of them and has a "
      "row "
      "of its own: the variance of a point's mean, as a share of the same variance.",
      by_size(all.front().indices, [](const SobolIndex& e) { return e.total.value; }));
  const auto noise_row = static_cast<double>(picture.y.names.size());
  picture.y.names.emplace_back("trial noise");
  for (const auto& s : all) {
    auto total = colours.mark(Mark::Kind::bars, s.method),
         first = colours.mark(Mark::Kind::points, s.method);
    total.shown = first.shown = &s == &all.front();
    first.colour = "ink";
    for (const auto& e : s.indices) {
      const double row = row_of(picture.y.names, e.parameter);
      add(total, row, e.total);
      add(first, row + 0.15, e.first_order);
      total.labels.push_back("total");
      first.labels.push_back("first order");
    }
    add(total, noise_row, s.noise);
    total.labels.push_back("noise");
    picture.marks.push_back(std::move(total));
    picture.marks.push_back(std::move(first));
  }
  return picture;
}

Picture morris(const std::vector<Sensitivity>& all, const MethodColours& colours,
               const std::string& id) {
  Picture picture{
      .id = id + "-morris",
      .title = "Elementary effects on " + all.front().metric,
      .note =
          "Each parameter over its range, scaled to 1, with 95 % intervals. To the right: "
          "it matters. Above the "
          "dashed line (σ = μ*): its effect depends on the others or is not linear.",
      .x = {"μ*, mean size of the effect", all.front().unit},
      .y = {"σ of the effect", all.front().unit},
      .exclusive = true};
  double most = 0.0;
  for (const auto& s : all) {
    auto dots = colours.mark(Mark::Kind::points, s.method);
    dots.shown = &s == &all.front();
    dots.labelled = true;
    for (const auto& e : s.elementary_effects) {
      add(dots, e.sigma.value, e.mu_star);
      dots.y_low.push_back(e.sigma.low);
      dots.y_high.push_back(e.sigma.high);
      dots.labels.push_back(e.parameter);
      if (dots.shown) most = std::max({most, e.mu_star.value, e.sigma.value});
    }
    picture.marks.push_back(std::move(dots));
  }
  Mark equal;
  equal.colour = "soft";
  equal.dashed = true;
  equal.x = equal.y = {0.0, most};
  picture.marks.insert(picture.marks.begin(), std::move(equal));
  return picture;
}

}  // namespace

std::vector<Picture> sensitivity_pictures(const std::vector<Sensitivity>& all,
                                          const MethodColours& colours, const std::string& id) {
  std::vector<Picture> pictures;
  if (all.empty()) return pictures;
  if (!all.front().elasticities.empty()) pictures.push_back(tornado(all, colours, id));
  if (!all.front().indices.empty()) pictures.push_back(sobol(all, colours, id));
  if (!all.front().elementary_effects.empty()) pictures.push_back(morris(all, colours, id));
  return pictures;
}

}  // namespace gyrostat
