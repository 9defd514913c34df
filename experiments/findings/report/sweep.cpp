#include <gyrostat/experiments/findings/report/sweep.hpp>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include <gyrostat/core/fields.hpp>

namespace gyrostat {
namespace {

using Setting = std::vector<std::pair<std::string, std::string>>;

/// What stands in brackets behind a cell's name; empty where nothing does.
Setting setting_of(const std::string& cell) {
  const auto open = cell.find('[');
  if (open == std::string::npos || !cell.ends_with(']')) return {};
  Setting setting;
  const auto inside = cell.substr(open + 1, cell.size() - open - 2);
  for (std::size_t begin = 0; begin <= inside.size();) {
    const auto end = std::min(inside.find(',', begin), inside.size());
    const auto part = inside.substr(begin, end - begin);
    const auto equals = part.find('=');
    if (equals == std::string::npos) return {};
    setting.emplace_back(part.substr(0, equals), part.substr(equals + 1));
    begin = end + 1;
  }
  return setting;
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool same_methods(const Cell& a, const Cell& b) {
  return std::equal(a.methods.begin(), a.methods.end(), b.methods.begin(), b.methods.end(),
                    [](const Method& m, const Method& n) { return m.id == n.id; });
}

/// Leaves out parameters that have one value.
void drop_constant(Sweep& sweep) {
  for (std::size_t p = sweep.parameters.size(); p-- > 0;) {
    if (sweep.levels(p).size() > 1) continue;
    const auto at = static_cast<std::ptrdiff_t>(p);
    sweep.parameters.erase(sweep.parameters.begin() + at);
    for (auto& values : sweep.values) values.erase(values.begin() + at);
  }
}

/// The base of a one-at-a-time design is a value of each of its parameters.
void add_bases(const Study& study, std::vector<Sweep>& sweeps) {
  for (const auto& design : study.designs) {
    if (design.kind != DesignKind::one_at_a_time) continue;
    for (std::size_t p = 0; p < design.parameters.size(); ++p)
      for (auto& sweep : sweeps) {
        if (sweep.name != design.name || sweep.parameters != std::vector{design.parameters[p].name})
          continue;
        sweep.cells.push_back(design.first_cell);
        sweep.values.push_back({short_number(design.base[p])});
      }
  }
}

}  // namespace

std::vector<std::string> Sweep::levels(std::size_t parameter) const {
  std::vector<std::string> all;
  for (const auto& of_cell : values)
    if (std::find(all.begin(), all.end(), of_cell[parameter]) == all.end())
      all.push_back(of_cell[parameter]);
  if (std::all_of(all.begin(), all.end(),
                  [](const auto& text) { return number(text).has_value(); }))
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return *number(a) < *number(b); });
  return all;
}

std::vector<Sweep> sweeps_of(const Study& study) {
  std::vector<Sweep> sweeps;
  for (std::size_t c = 0; c < study.cells.size(); ++c) {
    const auto& name = study.cells[c].name;
    const auto setting = setting_of(name);
    if (setting.empty()) continue;
    std::vector<std::string> parameters, values;
    for (const auto& [parameter, value] : setting)
      parameters.push_back(parameter), values.push_back(value);
    const auto base = name.substr(0, name.find('['));
    auto at = std::find_if(sweeps.begin(), sweeps.end(), [&](const Sweep& s) {
      return s.name == base && s.parameters == parameters &&
             same_methods(study.cells[s.cells.front()], study.cells[c]);
    });
    if (at == sweeps.end()) at = sweeps.insert(sweeps.end(), {base, parameters, {}, {}});
    at->cells.push_back(c);
    at->values.push_back(values);
  }
  add_bases(study, sweeps);
  for (auto& sweep : sweeps) drop_constant(sweep);
  std::erase_if(sweeps, [](const Sweep& s) { return s.parameters.empty(); });
  return sweeps;
}

}  // namespace gyrostat
