#include <gyrostat/diagnosis/likelihood/compass_step.hpp>

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>

namespace gyrostat::gap {
namespace {

/// On the diagonal of equations, of a value that is given: no other is as large.
constexpr double fixed = 1e30;

}  // namespace

std::vector<Effect> compass_step(const CompassErrors& errors, const Conditions& conditions,
                                 const std::vector<char>& hidden, const std::vector<Effect>& set,
                                 const std::vector<double>& here, const WalkingLevel& level,
                                 AtEnds at_ends) {
  struct Place {
    std::size_t effect, field;
    double step;
  };
  std::vector<Place> places;
  bool some_stay = false;
  for (std::size_t k = 0; k < set.size(); ++k) {
    const auto& free = cause_types().named(set[k].id(), "effects").free_parameters;
    for (std::size_t f = 0; f < set[k].fields().size(); ++f) {
      const auto& field = set[k].fields()[f];
      if (std::find(free.begin(), free.end(), field.name) == free.end()) continue;
      const double value = set[k].value(f);
      const bool stays =
          at_ends == AtEnds::stay && (value == field.range.from || value == field.range.to);
      some_stay |= stays;
      if (!stays)
        places.push_back({k, f, field.unit == "deg" ? 0.01 : 1e-3 * std::abs(value) + 1e-6});
    }
  }
  // Else it was tried.
  if (at_ends == AtEnds::stay && !some_stay) return set;
  if (places.empty()) return set;
  std::vector<std::vector<double>> moved(places.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t c) {
    auto other = set;
    other[places[c].effect].value(places[c].field) += places[c].step;
    moved[c] = errors.of(other);
  });
  const auto columns = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(columns), row(columns);
  WalkingLevel of_error = level;
  std::vector<WalkingLevel> of_columns(places.size(), level);
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      if (is_missing(here[i]) || errors.is_hidden(hidden, i)) continue;
      for (std::size_t c = 0; c < places.size(); ++c)
        row[static_cast<Eigen::Index>(c)] =
            of_columns[c].innovation(wrap_degrees(here[i] - moved[c][i]) / places[c].step);
      normal += row * row.transpose();
      right += of_error.innovation(here[i]) * row;
    }
  normal.diagonal() *= 1.0 + 1e-9;
  normal.diagonal().array() += 1e-12;
  // A value that would leave its range stays at the end of it, and the others go without it.
  auto better = set;
  for (bool all_within = false; !all_within;) {
    all_within = true;
    const Eigen::VectorXd by = solve_symmetric(normal, right);
    for (std::size_t c = 0; c < places.size(); ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      const double from = set[places[c].effect].value(places[c].field);
      const auto& range = set[places[c].effect].fields()[places[c].field].range;
      const double to = std::clamp(from + by[column], range.from, range.to);
      better[places[c].effect].value(places[c].field) = to;
      if (to == from + by[column] || normal(column, column) == fixed) continue;
      right -= (to - from) * normal.col(column);
      right[column] = fixed * (to - from);
      normal.col(column).setZero();
      normal.row(column).setZero();
      normal(column, column) = fixed;
      all_within = false;
    }
  }
  return better;
}

}  // namespace gyrostat::gap
