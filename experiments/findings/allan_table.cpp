#include <gyrostat/experiments/findings/allan_table.hpp>

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr double in_radians = 0.017453292519943295;

struct Row {
  const char* name;
  const AllanCoefficient& c;
  const char *customary, *si;
  double to_customary;  ///< from the unit in dps
};

}  // namespace

Table allan_coefficients_table(const AllanCoefficients& c, const std::string& title) {
  Table table{
      .title = title + ": IEEE 952 coefficients",
      .columns = {{"coefficient", ""}, {"value", ""}, {"from", ""}, {"to", ""}, {"unit", ""}}};
  const Row rows[] = {
      {"Q quantization", c.quantisation_deg, "arcsec", "rad", quantisation_arcsec(1.0)},
      {"N angle random walk", c.angle_random_walk_dps_per_sqrt_hz, "deg/√h", "rad/s/√Hz",
       angle_random_walk_deg_per_sqrt_h(1.0)},
      {"B bias instability", c.bias_instability_dps, "deg/h", "rad/s",
       bias_instability_deg_per_h(1.0)},
      {"K rate random walk", c.rate_random_walk_dps_sqrt_hz, "deg/h/√h", "rad/s²/√Hz",
       rate_random_walk_deg_per_h_per_sqrt_h(1.0)},
      {"R rate ramp", c.rate_ramp_dps_per_s, "deg/h²", "rad/s²", rate_ramp_deg_per_h2(1.0)}};
  for (const auto& row : rows)
    for (const bool customary : {true, false}) {
      const double unit = customary ? row.to_customary : in_radians;
      const bool shown = row.c.value > 0.0;
      const auto in_unit = [&](double value) {
        return shown ? TableCell(unit * value) : TableCell{};
      };
      table.rows.push_back({customary ? std::string(row.name) : std::string(), in_unit(row.c.value),
                            in_unit(row.c.lower), unit * row.c.upper,
                            std::string(customary ? row.customary : row.si)});
    }
  table.notes.emplace_back(
      "from, to: 95 % interval whatever the other four are; without a value: "
      "not shown, 95 % limit");
  if (!c.adequate)
    table.notes.push_back(
        fmt::format("these five do not describe the curve (chi-square {:.3g} of "
                    "{} points too many): intervals are widened",
                    c.chi_square, c.degrees_of_freedom));
  if (c.shortest_tau_s > 0.0)
    table.notes.push_back(
        fmt::format("from the points at {:.4g} s and longer, an octave apart", c.shortest_tau_s));
  return table;
}

AllanFindings allan_findings(std::span<const double> rate_dps, double rate_hz,
                             const std::string& name) {
  constexpr std::size_t fewest = 4, fewest_for_coefficients = 128;
  if (rate_dps.size() < fewest)
    throw InputError(name,
                     fmt::format("{} samples; at least {} are needed", rate_dps.size(), fewest));
  AllanFindings findings;
  const auto shown = allan_clusters(rate_dps.size());
  const auto fitted = rate_dps.size() < fewest_for_coefficients ? std::vector<std::size_t>()
                                                                : octave_clusters(rate_dps.size());
  std::vector<std::size_t> clusters;
  std::set_union(shown.begin(), shown.end(), fitted.begin(), fitted.end(),
                 std::back_inserter(clusters));
  std::vector<AllanPoint> points;
  try {
    points = overlapping_allan_deviation(rate_dps, rate_hz, clusters);
  } catch (const InputError& mistake) {
    throw InputError(name, mistake.what());
  }
  const auto those_of = [&](const std::vector<std::size_t>& wanted) {
    std::vector<AllanPoint> some;
    std::copy_if(points.begin(), points.end(), std::back_inserter(some), [&](const auto& point) {
      return std::binary_search(wanted.begin(), wanted.end(), point.cluster);
    });
    return some;
  };
  findings.points = those_of(shown);
  if (!fitted.empty()) findings.coefficients = fit_allan_coefficients(those_of(fitted));
  return findings;
}

std::vector<Table> allan_tables(const AllanFindings& findings, const std::string& name) {
  Table table{.title = name + ": overlapping Allan deviation",
              .columns = {{"tau", "s"},
                          {"deviation", "dps"},
                          {"lower 95 %", "dps"},
                          {"upper 95 %", "dps"},
                          {"degrees of freedom", "1"}}};
  for (const auto& point : findings.points)
    table.rows.push_back({point.tau_s, point.deviation, point.lower, point.upper, point.edf});
  std::vector<Table> tables = {std::move(table)};
  if (findings.coefficients)
    tables.push_back(allan_coefficients_table(*findings.coefficients, name));
  return tables;
}

Picture allan_picture(const AllanFindings& findings, const std::string& title) {
  Picture picture{.id = "allan",
                  .title = title,
                  .note = "Overlapping, with the 95 % interval of each point.",
                  .x = {"averaging time τ", "s", true},
                  .y = {"Allan deviation", "dps", true}};
  Mark measured;
  measured.name = "recording";
  measured.colour = "ink";
  for (const auto& point : findings.points) {
    measured.x.push_back(point.tau_s);
    measured.y.push_back(point.deviation);
    measured.y_low.push_back(point.lower);
    measured.y_high.push_back(point.upper);
  }
  picture.marks.push_back(measured);
  if (!findings.coefficients) return picture;
  Mark fitted;
  fitted.name = "Q, N, B, K and R";
  fitted.colour = "m0";
  fitted.dashed = true;
  fitted.x = measured.x;
  for (const double tau_s : fitted.x)
    fitted.y.push_back(allan_deviation(*findings.coefficients, tau_s));
  picture.marks.push_back(std::move(fitted));
  picture.note += " Dashed: what the five coefficients of the table amount to.";
  return picture;
}

}  // namespace gyrostat
