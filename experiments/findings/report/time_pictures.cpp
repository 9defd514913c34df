#include <algorithm>
#include <cmath>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/experiments/findings/report/cell_pictures.hpp>

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

Picture allan_picture(const CellView& v, const Replayed& r) {
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

Picture error_picture(const CellView& v, const Replayed& r) {
  Picture picture{.id = v.id + "-error",
                  .title = r.truth ? "Error of the estimate over time" : "Innovation over time",
                  .x = {"time", "s"},
                  .y = {r.truth ? "estimate − true error" : "innovation", "dps"},
                  .exclusive = true};
  for (const std::size_t m : v.order) {
    const auto& method = r.methods[m];
    auto band = v.colours.mark(Mark::Kind::line, v.cell.methods[m].id);
    band.shown = v.leads(m, 1);
    band.dashed = false;
    band.x = r.t_s;
    band.y = method.error_mean;
    auto upper = band;
    upper.colour = "ink";
    upper.dashed = true;
    auto lower = upper;
    for (std::size_t i = 0; i < r.t_s.size(); ++i) {
      band.y_low.push_back(method.error_mean[i] - 3.0 * method.error_std[i]);
      band.y_high.push_back(method.error_mean[i] + 3.0 * method.error_std[i]);
      upper.y[i] = 3.0 * method.stated_std[i];
      lower.y[i] = -3.0 * method.stated_std[i];
    }
    const bool states =
        std::any_of(upper.y.begin(), upper.y.end(), [](double y) { return std::isfinite(y); });
    picture.marks.push_back(std::move(band));
    if (!states) continue;
    picture.marks.push_back(std::move(upper));
    picture.marks.push_back(std::move(lower));
  }
  if (std::none_of(picture.marks.begin(), picture.marks.end(),
                   [](const Mark& m) { return m.shown; }) &&
      !picture.marks.empty())
    picture.marks.front().shown = true;
  picture.note = fmt::format(
      "Line: mean over {0} trials simulated again; band: ± 3 standard deviations over those "
      "trials; "
      "dashed: ± 3 σ as the filter itself states it. A band wider than the dashed lines is of a "
      "filter that is surer than it should be.",
      r.trials);
  return picture;
}

Picture heading_picture(const CellView& v, const Replayed& r) {
  Picture picture{.id = v.id + "-heading",
                  .title = "Heading error over time",
                  .x = {"time", "s"},
                  .y = {"heading error, RMS over trials", "deg"}};
  double least = INFINITY, most = 0.0;
  for (const std::size_t m : v.order) {
    auto line = v.colours.mark(Mark::Kind::line, v.cell.methods[m].id);
    line.x = r.t_s;
    line.y = r.methods[m].heading_rms;
    if (!line.y.empty())
      least = std::min(least, line.y.back()), most = std::max(most, line.y.back());
    picture.marks.push_back(std::move(line));
  }
  picture.y.logarithmic = least > 0.0 && most > 20.0 * least;
  picture.note = fmt::format(
      "Integral of the compensated rate error from the start, root of the mean square over {} "
      "trials "
      "simulated again. An estimate that follows the white noise makes it small without knowing "
      "the bias.",
      r.trials);
  return picture;
}

}  // namespace gyrostat
