#include <gyrostat/experiments/study/design_points.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

#include <fmt/format.h>

namespace gyrostat {
namespace {

/// The moved parameter of each step, "start" for the first point of a trajectory.
std::vector<std::string> morris_labels(const Design& design) {
  std::vector<std::string> labels;
  const std::size_t length = design.parameters.size() + 1;
  for (std::size_t i = 0; i < design.points.size(); ++i) {
    std::string what = "start";
    for (std::size_t p = 0; i % length != 0 && p + 1 < length; ++p)
      if (design.points[i][p] != design.points[i - 1][p]) what = design.parameters[p].name;
    labels.push_back(fmt::format("trajectory_{}_{}", i / length + 1, what));
  }
  return labels;
}

std::vector<std::string> saltelli_labels(const Design& design) {
  std::vector<std::string> labels;
  const std::size_t length = design.parameters.size() + 2;
  for (std::size_t i = 0; i < design.points.size(); ++i) {
    const std::size_t at = i % length;
    const auto what = at == 0 ? "A" : at == 1 ? "B" : design.parameters[at - 2].name;
    labels.push_back(fmt::format("row_{}_{}", i / length + 1, what));
  }
  return labels;
}

std::vector<std::string> around_labels(const Design& design) {
  std::vector<std::string> labels = {"base"};
  for (const auto& p : design.parameters)
    for (const double end : {p.from, p.to}) labels.push_back(p.name + "=" + short_number(end));
  return labels;
}

}  // namespace

void place_points(std::size_t count, std::uint64_t seed, Design& design) {
  const std::size_t parameters = design.parameters.size();
  const DesignSource source{seed, design.name};
  switch (design.kind) {
    case DesignKind::latin_hypercube:
      design.points = latin_hypercube(count, parameters, source);
      break;
    case DesignKind::sobol:
      design.points = sobol_sequence(count, parameters, source);
      break;
    case DesignKind::one_at_a_time: {
      std::vector<double> base;
      for (std::size_t p = 0; p < parameters; ++p)
        base.push_back(design.parameters[p].coordinate(design.base[p]));
      design.points = one_at_a_time(base);
      design.labels = around_labels(design);
      break;
    }
    case DesignKind::morris:
      design.points = morris_trajectories(count, design.levels, parameters, source);
      design.labels = morris_labels(design);
      break;
    default:
      design.points = saltelli_rows(count, parameters, source);
      design.labels = saltelli_labels(design);
  }
  for (std::size_t i = design.labels.size(); i < design.points.size(); ++i)
    design.labels.push_back(fmt::format("point_{}", i + 1));
  const auto is_base = [&](std::size_t p, double u) {
    return !design.base.empty() && u == design.points.front()[p];
  };
  for (const auto& point : design.points) {
    auto& values = design.values.emplace_back();
    for (std::size_t p = 0; p < parameters; ++p)
      values.push_back(
          Json(is_base(p, point[p]) ? design.base[p] : design.parameters[p].at(point[p])).dump());
  }
}

}  // namespace gyrostat
