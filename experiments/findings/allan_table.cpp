#include <gyrostat/experiments/findings/allan_table.hpp>

#include <fmt/format.h>

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

}  // namespace gyrostat
