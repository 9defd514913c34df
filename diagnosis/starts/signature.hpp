#pragma once

#include <functional>
#include <vector>

#include <gyrostat/diagnosis/evidence.hpp>

namespace gyrostat::gap {

/// Which series a signature is looked for in.
enum class Trace { rate, heading };

/// Of the evidence's baseline, once: what signatures in the trace are told from.
void take_undisturbed(Evidence& evidence, Trace trace);
/// What effects without noise add to the trace of the train part, under the recording's conditions,
/// as one column an effect, without their means; of the rate, as innovations beside its level:
/// what is slow would be taken for a motion that is slow, too.
Eigen::MatrixXd signatures(const Evidence& evidence, Trace trace,
                           const std::vector<Effect>& effects);
/// The same of sets of effects, a column each.
Eigen::MatrixXd signatures_of_sets(const Evidence& evidence, Trace trace,
                                   const std::vector<std::vector<Effect>>& sets);
/// What each of `effects` by itself leaves of the trace, squared.
std::vector<double> left_by_each(const Evidence& evidence, Trace trace,
                                 const std::vector<Effect>& effects);
/// The recording's own trace, treated alike.
Eigen::VectorXd trace_of(const Evidence& evidence, Trace trace);

/// The gain of a level under which the train part of a rate error is likeliest.
double level_gain_of(const Conditions& conditions, const std::vector<double>& rate_error_dps);

/// Least-squares amplitudes of `columns` in `trace` and the share of it that they leave.
struct Match {
  Eigen::VectorXd amplitudes;
  double unexplained;
};
Match match(const Eigen::MatrixXd& columns, const Eigen::VectorXd& trace);

/// The value in [low, high] (logarithmic) with the least `cost`, by a grid and a golden section, to
/// a 40th of two of the grid's steps. Costs are asked for in several threads at once.
double best_of(double low, double high, const std::function<double(double)>& cost);

}  // namespace gyrostat::gap
