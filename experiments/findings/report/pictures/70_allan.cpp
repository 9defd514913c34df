#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/experiments/findings/report/picture.hpp>

namespace gyrostat {
namespace {

/// A grey line of a slope, through a point of a curve.
Mark slope(const std::string& name, const std::vector<double>& tau, double at_tau, double deviation,
           double power) {
  Mark line;
  line.name = name;
  line.colour = "soft";
  line.dashed = true;
  for (const double t : {tau.front(), tau.back()}) {
    line.x.push_back(t);
    line.y.push_back(deviation * std::pow(t / at_tau, power));
  }
  return line;
}

/// Slopes of -1/2 (white noise), 0 (bias instability) and +1/2 (random walk), where the curve of
/// the raw signal touches them.
std::vector<Mark> slopes(const Replayed& r, const std::vector<double>& variance) {
  std::vector<Mark> marks;
  const auto touch = [&](const std::string& name, double power) {
    std::size_t at = 0;
    for (std::size_t i = 1; i < variance.size(); ++i)
      if (variance[i] * std::pow(r.tau_s[i], -2.0 * power) <
          variance[at] * std::pow(r.tau_s[at], -2.0 * power))
        at = i;
    marks.push_back(slope(name, r.tau_s, r.tau_s[at], std::sqrt(variance[at]), power));
  };
  touch("slope −½", -0.5);
  touch("slope 0", 0.0);
  touch("slope +½", 0.5);
  return marks;
}

}  // namespace

Picture picture_allan(const PictureSources& from) {
  const auto& v = from.view;
  const auto& r = from.replayed;
  if (r.trials == 0) return {};
  Picture picture{.id = v.id + "-allan",
                  .title = "Allan deviation of the compensated rate",
                  .x = {"averaging time τ", "s", true},
                  .y = {"Allan deviation", "dps", true}};
  std::size_t raw = v.cell.methods.size();
  for (const std::size_t m : v.order) {
    const auto& method = r.methods[m];
    const bool is_raw = v.cell.methods[m].role().is_floor();
    if (is_raw) raw = m;
    auto line = v.colours.mark(Mark::Kind::line, v.cell.methods[m].id);
    line.shown = is_raw || v.leads(m, 3);
    line.x = r.tau_s;
    for (std::size_t i = 0; i < r.tau_s.size(); ++i) {
      const double variance = method.allan_variance[i], error = method.allan_error[i];
      const double half =
          r.trials > 1 ? student_t_two_sided(0.95, r.trials - 1.0) * error : no_value;
      line.y.push_back(std::sqrt(variance));
      line.y_low.push_back(std::sqrt(std::max(variance - half, 0.05 * variance)));
      line.y_high.push_back(std::sqrt(variance + half));
    }
    picture.marks.push_back(std::move(line));
  }
  if (raw < v.cell.methods.size() && !r.tau_s.empty())
    for (auto& line : slopes(r, r.methods[raw].allan_variance))
      picture.marks.push_back(std::move(line));
  picture.note = fmt::format(
      "Root of the mean Allan variance of {} trials simulated again, with the 95 % interval of "
      "that mean; none is the "
      "raw gyro. Dashed: slopes of white noise (−½), bias instability (0) and random walk (+½), "
      "where they touch it "
      "from below. A low left end alone says only that the white noise is smoothed.",
      r.trials);
  return picture;
}

}  // namespace gyrostat
