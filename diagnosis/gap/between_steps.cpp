#include <gyrostat/diagnosis/gap/between_steps.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gyrostat::gap {
namespace {

struct EqualRun {
  std::size_t first, last;  ///< one after its last
  double value;

  double length() const { return static_cast<double>(last - first); }
};

std::vector<EqualRun> equal_runs(const std::vector<double>& values) {
  std::vector<EqualRun> runs;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (runs.empty() || values[i] != runs.back().value) runs.push_back({i, i, values[i]});
    runs.back().last = i + 1;
  }
  return runs;
}

/// From the value `begin` half a sample before the run to `end` half a sample after it.
void draw(const EqualRun& run, double begin, double end, std::vector<double>& values) {
  for (std::size_t i = run.first; i < run.last; ++i)
    values[i] = std::lerp(begin, end, (static_cast<double>(i - run.first) + 0.5) / run.length());
}

}  // namespace

std::vector<double> between_steps(std::vector<double> values, double least_step) {
  const auto runs = equal_runs(values);
  if (runs.size() < 3) return values;
  const auto crossing = [&](std::size_t k) {
    return std::midpoint(runs[k].value, runs[k + 1].value);
  };
  const auto step = [&](std::size_t k) { return runs[k + 1].value - runs[k].value; };
  const auto is_step = [&](std::size_t k) { return std::abs(step(k)) >= least_step; };
  const auto repeats = [&](std::size_t k) { return runs[k].last - runs[k].first > 1; };
  for (std::size_t k = 1; k + 1 < runs.size(); ++k)
    if (repeats(k) && step(k - 1) * step(k) > 0.0 && is_step(k - 1) && is_step(k))
      draw(runs[k], crossing(k - 1), crossing(k), values);

  // Where a run that is crossed to the one beside it at `near`, and that one at `far`, would end.
  const auto gone_on = [](const EqualRun& run, double near, const EqualRun& beside, double far) {
    const double slope = (near - far) / beside.length(), half = std::abs(near - run.value);
    return std::clamp(near + slope * run.length(), run.value - half, run.value + half);
  };
  const std::size_t n = runs.size();
  const double first = crossing(0), last = crossing(n - 2);
  if (repeats(0) && is_step(0))
    draw(runs[0], gone_on(runs[0], first, runs[1], crossing(1)), first, values);
  if (repeats(n - 1) && is_step(n - 2))
    draw(runs[n - 1], last, gone_on(runs[n - 1], last, runs[n - 2], crossing(n - 3)), values);
  return values;
}

}  // namespace gyrostat::gap
