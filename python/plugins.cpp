#include <gyrostat/python/plugins.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/filter_type.hpp>
#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::python {
namespace {

namespace py = pybind11;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A plug-in as Python described it. Never destroyed: registries point into it, and the interpreter
/// is gone before they are.
struct Definition {
  std::string id, title;
  std::deque<std::string> texts;  ///< of the fields
  std::vector<FieldInfo> fields;
  std::vector<std::vector<double> Series::*> needs;    ///< of an effect
  std::vector<std::vector<double> Series::*> changes;  ///< of an effect: those of its stage
  py::object function;

  /// Number, unit, least, greatest, meaning of each parameter.
  using Parameter = std::tuple<std::string, double, std::string, double, double, std::string>;

  Definition(std::string id_, std::string title_, const std::vector<Parameter>& parameters,
             py::object function_)
      : id(std::move(id_)), title(std::move(title_)), function(std::move(function_)) {
    for (const auto& [name, value, unit, from, to, doc] : parameters) {
      const auto keep = [&](const std::string& text) -> std::string_view {
        return texts.emplace_back(text);
      };
      const Range range{.from = from, .to = to};
      if (!range.contains(value))
        throw InputError(id + "." + name, fmt::format("the default {} is out of range; allowed: {}",
                                                      short_number(value), range.to_string()));
      fields.push_back({keep(name), keep(unit), range, keep(doc), value});
    }
  }
};

std::set<unsigned long>& running() {
  static std::set<unsigned long> threads;  // guarded by the interpreter's lock
  return threads;
}

/// This thread is in a plug-in.
class Running {
 public:
  Running() { running().insert(PyThread_get_thread_ident()); }
  ~Running() { running().erase(PyThread_get_thread_ident()); }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
};

/// "ValueError: too loud (my_filter, line 7)".
std::string one_line(const py::error_already_set& error) {
  std::string text = py::str(error.type().attr("__name__"));
  std::string what = py::str(error.value());
  std::replace(what.begin(), what.end(), '\n', ' ');
  if (!what.empty()) text += ": " + what;
  py::object at = error.trace() ? py::object(error.trace()) : py::none();
  if (at.is_none()) return text;
  while (!at.attr("tb_next").is_none()) at = at.attr("tb_next");
  const std::string function = py::str(at.attr("tb_frame").attr("f_code").attr("co_name"));
  return fmt::format("{} ({}, line {})", text, function, at.attr("tb_lineno").cast<int>());
}

/// Runs Python; what it raises comes out as an exception that holds nothing of Python's.
template <class Call>
void in_python(const Call& call) {
  std::string raised;
  bool interrupted = false;
  {
    const py::gil_scoped_acquire lock;
    const Running running;
    try {
      call();
      return;
    } catch (const py::error_already_set& error) {
      interrupted = error.matches(PyExc_KeyboardInterrupt);
      raised = one_line(error);
    }
  }
  if (interrupted) throw Interrupted();
  throw std::runtime_error(raised);
}

/// The values, for Python to keep: a copy, since a trial's memory is used again.
py::object copied(std::span<const double> values) {
  if (values.empty()) return py::none();
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::tuple parameters_of(std::span<const double> values) {
  py::tuple tuple(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) tuple[i] = values[i];
  return tuple;
}

/// One number a sample out of what a plug-in returned.
Numbers column(const py::handle& answer, std::size_t samples, const char* what) {
  const auto numbers = Numbers::ensure(answer);
  if (!numbers) throw py::error_already_set();
  if (numbers.ndim() != 1 || static_cast<std::size_t>(numbers.size()) != samples)
    throw py::value_error(
        fmt::format("{}: {} numbers came back for {} samples", what, numbers.size(), samples));
  return numbers;
}

std::vector<double> usable_headings(const Series& series) {
  std::vector<double> headings;
  if (series.heading_deg.empty()) return headings;
  for (std::size_t i = 0; i < series.size(); ++i)
    headings.push_back(sample_at(series, i).heading_deg);
  return headings;
}

/// An estimate that is no number is a breakdown: the last sound one stays.
void take_estimates(const Series& series, const Numbers& estimates, Track& track) {
  double sound = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double estimate = estimates.data()[i];
    const bool is_sound = std::isfinite(estimate);
    if (is_sound) sound = estimate;
    track.estimate_dps[i] = sound;
    track.status[i] = !is_sound                        ? Status::not_finite
                      : is_missing(series.gyro_dps[i]) ? Status::no_measurement
                                                       : Status::ok;
  }
}

void run_in_python(const Definition& definition, std::span<const double> parameters,
                   const Series& series, Track& track) {
  track.resize(series.size());
  track.learned_first = track.learned_last = {};
  const auto headings = usable_headings(series);
  in_python([&] {
    const py::tuple answer = definition.function(copied(series.t_s), copied(series.gyro_dps),
                                                 copied(series.temperature_C), copied(headings),
                                                 parameters_of(parameters));
    take_estimates(series, column(answer[0], series.size(), "estimate_dps"), track);
    const std::pair<const char*, std::vector<double>*> further[] = {
        {"estimate_variance", &track.estimate_variance},
        {"innovation_dps", &track.innovation_dps},
        {"innovation_variance", &track.innovation_variance}};
    for (std::size_t k = 0; k < std::size(further); ++k) {
      auto& [name, values] = further[k];
      std::fill(values->begin(), values->end(), no_value);
      if (k + 1 >= answer.size() || answer[k + 1].is_none()) continue;
      const auto numbers = column(answer[k + 1], series.size(), name);
      for (std::size_t i = 0; i < series.size(); ++i)
        if (std::isfinite(numbers.data()[i])) (*values)[i] = numbers.data()[i];
    }
  });
}

/// What an Effect of Python holds.
struct PythonEffect {
  const Definition* definition;
  std::vector<double> parameters;
};

/// Of a stage with several channels: a dict of those that are changed.
void take_channels(const Definition& definition, const py::object& answer, Series& series) {
  std::vector<std::string> names;
  for (const auto& channel : channels)
    if (std::ranges::find(definition.changes, channel.values) != definition.changes.end())
      names.emplace_back(channel.name);
  if (!py::isinstance<py::dict>(answer))
    throw py::type_error(
        fmt::format("a dict is returned of those that change of {}", fmt::join(names, ", ")));
  for (const auto& [key, changed] : answer.cast<py::dict>()) {
    const std::string name = py::str(key);
    if (std::ranges::find(names, name) == names.end())
      throw py::value_error(unknown_name("channel of this stage", name, names));
    const auto numbers = column(changed, series.size(), name.c_str());
    for (const auto& channel : channels)
      if (channel.name == name)
        (series.*channel.values).assign(numbers.data(), numbers.data() + numbers.size());
  }
}

void apply_in_python(const PythonEffect& effect, Series& series, const Noise& noise) {
  const auto& definition = *effect.definition;
  for (const auto need : definition.needs)
    if ((series.*need).empty()) return;
  in_python([&] {
    py::dict signal;
    for (const auto& channel : channels)
      signal[py::str(std::string(channel.name))] = copied(series.*channel.values);
    const auto samples = series.size();
    const auto deviates = py::cpp_function([&definition, noise, samples](const std::string& name) {
      std::vector<double> values(samples);
      noise.stream(definition.id + "." + name).fill(0, values);
      return py::array_t<double>(static_cast<py::ssize_t>(samples), values.data());
    });
    const py::object answer =
        definition.function(signal, deviates, parameters_of(effect.parameters));
    if (definition.changes.size() > 1) return take_channels(definition, answer, series);
    const auto numbers = column(answer, samples, "the signal");
    auto& values = series.*definition.changes.front();
    values.assign(numbers.data(), numbers.data() + samples);
  });
}

std::vector<double> Series::*channel_named(const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  for (const auto& channel : channels) {
    if (channel.name == name) return channel.values;
    names.emplace_back(channel.name);
  }
  throw InputError(place, unknown_name("channel", name, names));
}

void add_filter(const std::string& id, const std::string& title,
                const std::vector<std::string>& needs, bool corrects_drift,
                const std::vector<Definition::Parameter>& parameters, const std::string& code,
                const py::object& function) {
  auto* definition = new Definition(id, title, parameters, function);
  Needs needed;
  for (const auto& name : needs) {
    const auto channel = channel_named(name, id + ": needs");
    if (channel == &Series::temperature_C)
      needed.temperature = true;
    else if (channel == &Series::heading_deg)
      needed.heading = true;
    else
      throw InputError(id + ": needs",
                       "'" + name + "' is not for filters; allowed: temperature_C, heading_deg");
  }
  FilterType type{.id = definition->id,
                  .title = definition->title,
                  .needs = needed,
                  .role = {.corrects = corrects_drift ? Role::Corrects::thermal_drift
                                                      : Role::Corrects::random_error},
                  .fields = definition->fields};
  type.run = [definition](std::span<const double> values, const Series& series, Track& track) {
    run_in_python(*definition, values, series, track);
  };
  type.code = code;
  filter_types().add_or_replace(std::move(type));
}

/// The stages of effects in Python, with the channels that each changes.
struct StageName {
  const char* name;
  Stage stage;
  std::vector<std::vector<double> Series::*> changes;
};
const StageName stages[] = {
    {"environment", Stage::environment, {&Series::temperature_C, &Series::rate_ref_dps}},
    {"sensing", Stage::sensing, {&Series::thermal_bias_dps}},
    {"noise", Stage::noise, {&Series::gyro_dps}},
    {"electronics", Stage::electronics, {&Series::gyro_dps}},
    {"conversion", Stage::conversion, {&Series::gyro_dps}},
    {"transport", Stage::transport, {&Series::gyro_dps}},
    {"compass", Stage::compass, {&Series::heading_deg}}};

const StageName& stage_named(const std::string& name, const std::string& place) {
  std::vector<std::string> names;
  for (const auto& stage : stages) {
    if (stage.name == name) return stage;
    names.emplace_back(stage.name);
  }
  throw InputError(place, unknown_name("stage", name, names));
}

void add_effect(const std::string& id, const std::string& title, const std::string& stage_name,
                const std::vector<std::string>& needs,
                const std::vector<Definition::Parameter>& parameters, const std::string& code,
                const py::object& function) {
  auto* definition = new Definition(id, title, parameters, function);
  const auto& stage = stage_named(stage_name, id + ": stage");
  definition->changes = stage.changes;
  for (const auto& name : needs) definition->needs.push_back(channel_named(name, id + ": needs"));
  for (const auto channel : stage.changes)
    if (std::ranges::find(definition->needs, channel) == definition->needs.end())
      definition->needs.push_back(channel);
  EffectType type{};
  type.id = definition->id;
  type.title = definition->title;
  type.fields = definition->fields;
  type.cpp_type = &typeid(PythonEffect);
  type.make = [definition] {
    PythonEffect effect{definition, {}};
    for (const auto& field : definition->fields) effect.parameters.push_back(field.value);
    return std::any(std::move(effect));
  };
  type.parameter = [](std::any& plugin, std::size_t field) -> double& {
    return std::any_cast<PythonEffect>(&plugin)->parameters.at(field);
  };
  type.stage = stage.stage;
  type.needs = definition->needs;
  type.apply = [](const std::any& effect, Series& series, const Noise& noise) {
    apply_in_python(*std::any_cast<PythonEffect>(&effect), series, noise);
  };
  type.code = code;
  effect_types().add_or_replace(std::move(type));
}

}  // namespace

void interrupt_plugins() {
  for (const auto thread : running()) PyThreadState_SetAsyncExc(thread, PyExc_KeyboardInterrupt);
}

void bind_plugins(py::module_& module) {
  module.def("add_filter", &add_filter);
  module.def("add_effect", &add_effect);
}

}  // namespace gyrostat::python
