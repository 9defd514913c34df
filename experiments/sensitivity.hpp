#pragma once

#include <string>
#include <vector>

#include "analysis/sensitivity/indices.hpp"
#include "experiments/study.hpp"
#include "results/store.hpp"

namespace gyrostat {

/// What a design says of one method's metric; the list that the design allows is filled.
struct Sensitivity {
  std::string design;  ///< its place in the study: the cell's name before it was expanded
  std::string method, metric, unit;
  std::size_t points = 0, failed_points = 0;  ///< points left out because no trial of theirs finished
  std::vector<Elasticity> elasticities;
  std::vector<ElementaryEffect> elementary_effects;
  std::vector<SobolIndex> indices;
  std::vector<std::vector<double>> coordinates;  ///< by point, by parameter
  std::vector<std::string> parameters, units;
  std::vector<double> means, standard_errors;    ///< of the metric, by point
};

/// Of every design of a study, every method but the oracle, in the judging metric.
std::vector<Sensitivity> sensitivities(const Study& study, const Store& store);

}  // namespace gyrostat
