#include <gyrostat/experiments/study/study.hpp>

#include <algorithm>
#include <filesystem>

namespace gyrostat {

bool Cell::needs_calibration() const {
  return std::any_of(methods.begin(), methods.end(), [](const Method& method) {
    return method.source == ParameterSource::calibration && !method.role().is_floor();
  });
}

std::string_view judging_metric(const Cell& cell) {
  return cell.recording ? "log_score" : "bias_rmse";
}

std::string Study::name() const { return std::filesystem::path(path).stem().string(); }

std::uint64_t Study::trials() const {
  std::uint64_t sum = 0;
  for (const auto& cell : cells) sum += cell.trials;
  return sum;
}

const Design* design_of(const Study& study, std::size_t cell) {
  for (const auto& design : study.designs)
    if (cell >= design.first_cell && cell < design.first_cell + design.values.size())
      return &design;
  return nullptr;
}

void set_trials(Study& study, std::uint32_t trials) {
  for (auto& cell : study.cells)
    cell.trials = cell.recording ? std::min(cell.trials, trials) : trials;
}

const Cell& cell_named(const Study& study, const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  for (const auto& cell : study.cells) {
    if (name.empty() || cell.name == name) return cell;
    names.push_back(cell.name);
  }
  throw InputError(place, unknown_name("cell", name, names));
}

}  // namespace gyrostat
