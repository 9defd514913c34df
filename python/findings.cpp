#include <sstream>

#include <pybind11/stl.h>

#include <gyrostat/diagnosis/answer.hpp>
#include <gyrostat/diagnosis/diagnosis_json.hpp>
#include <gyrostat/diagnosis/diagnosis_tables.hpp>
#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/of_the_sensor.hpp>
#include <gyrostat/diagnosis/views.hpp>
#include <gyrostat/experiments/findings/allan_table.hpp>
#include <gyrostat/experiments/findings/application.hpp>
#include <gyrostat/experiments/findings/diagnosis_page.hpp>
#include <gyrostat/experiments/findings/diagnosis_pictures.hpp>
#include <gyrostat/experiments/findings/fit_tables.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/python/convert.hpp>
#include <gyrostat/python/work.hpp>
#include <gyrostat/recordings/clock.hpp>

namespace gyrostat::python {
namespace {

using Rate = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::pair<std::vector<Table>, Drawn> allan_of(std::span<const double> rate_dps, double rate_hz,
                                              const std::string& name) {
  const auto findings = allan_findings(rate_dps, rate_hz, name);
  auto tables = allan_tables(findings, name);
  const auto picture = allan_picture(findings, name + ": Allan deviation");
  return {std::move(tables), drawn({&picture, 1})};
}

/// Of an array where it lies: the array is kept until the last look at it.
auto allan_of_array(const Rate& rate_dps, double rate_hz, const std::string& name) {
  if (rate_dps.ndim() != 1)
    throw InputError(name, fmt::format("has {} dimensions; allowed: 1", rate_dps.ndim()));
  const std::span<const double> values(rate_dps.data(), static_cast<std::size_t>(rate_dps.size()));
  const std::shared_ptr<void> kept(new Rate(rate_dps), [](Rate* array) {
    const py::gil_scoped_acquire lock;
    delete array;
  });
  return result_of([values, kept, rate_hz, name] { return allan_of(values, rate_hz, name); });
}

auto allan(const RecordingHandle& recording) {
  return result_of([=] {
    const auto& series = recording->series;
    return allan_of(series.gyro_dps, series.rate_hz(), recording->name);
  });
}

auto fit(const RecordingHandle& recording, const std::vector<std::string>& names) {
  std::vector<FitMethod> methods;
  for (const auto& name : names) methods.push_back(fit_method_named(name, "method"));
  return result_of([=] {
    require_dense(recording->series, recording->name);
    auto found = fit_tables(recording->series, methods, recording->name, recording->name);
    return std::pair(std::move(found.tables), found.converged);
  });
}

std::vector<Method> methods_of(const std::string& json, ParameterSource source) {
  if (json.empty()) return all_methods(source);
  Mistakes mistakes;
  const Json parsed = Json::parse(json);
  JsonObject object(parsed, "apply:", &mistakes);
  auto methods = read_methods(object, "filters", source);
  object.finish();
  mistakes.raise();
  if (methods.empty()) throw InputError("apply", "\"filters\" is empty");
  return methods;
}

/// What methods made of a recording, which is kept for its times.
struct Applied {
  RecordingHandle recording;
  Application application;
  std::vector<Table> tables;
  std::vector<std::string> notes;
};

std::shared_ptr<Applied> apply(const RecordingHandle& recording, const std::string& filters,
                               double calibration, const std::string& fit) {
  const auto method = fit_method_named(fit, "fit");
  if (!(calibration == 0.0 || (calibration >= 0.01 && calibration <= 0.99)))
    throw InputError("calibration",
                     fmt::format("{:g} is out of range; allowed: 0, or [0.01, 0.99]", calibration));
  return result_of([=] {
    const auto& [name, series, unused] = *recording;
    require_dense(series, name);
    const auto methods = methods_of(
        filters, calibration > 0.0 ? ParameterSource::calibration : ParameterSource::defaults);
    auto applied = std::make_shared<Applied>();
    applied->recording = recording;
    std::ostringstream log;
    try {
      if (calibration > 0.0) applied->application = calibrated(series, calibration, method);
      apply_methods(methods, series, log, applied->application);
    } catch (const InputError& mistake) {
      throw InputError(name, mistake.what());
    }
    applied->tables = application_tables(series, applied->application, name);
    std::istringstream lines(log.str());
    for (std::string line; std::getline(lines, line);) applied->notes.push_back(line);
    return applied;
  });
}

py::dict tracks_of(const std::shared_ptr<Applied>& applied) {
  py::dict all;
  const auto owner = py::cast(applied);
  const auto add = [&](const std::string& name, std::span<const double> values) {
    all[py::str(name)] = view_of(values, owner);
  };
  add("t_s", applied->recording->series.t_s);
  add("raw_dps", applied->recording->series.gyro_dps);
  for (std::size_t m = 0; m < applied->application.methods.size(); ++m) {
    const auto& id = applied->application.methods[m].id;
    const auto& track = applied->application.tracks[m];
    add(id + "_estimate_dps", track.estimate_dps);
    add(id + "_innovation_dps", track.innovation_dps);
    add(id + "_innovation_variance", track.innovation_variance);
    py::list statuses;
    for (const auto status : track.status) statuses.append(py::str(std::string(name_of(status))));
    all[py::str(id + "_status")] = statuses;
  }
  return all;
}

/// A diagnosis under the name of its recording.
struct Diagnosed {
  std::string name;
  gap::Diagnosis diagnosis;
  std::vector<std::string> notes;
};

std::shared_ptr<Diagnosed> diagnose(const RecordingHandle& recording, std::uint64_t seed,
                                    const std::vector<std::string>& without,
                                    const std::string& claim, const py::object& progress) {
  gap::DiagnosisOptions options;
  options.seed = seed;
  options.without = without;
  for (const auto& name : without) (void)effect_types().named(name, "without");
  if (!claim.empty())
    options.claim = parse_study(Json::parse(claim), "claim.json").cells.front().scenario;
  return result_of(
      [=](Work& work) {
        auto diagnosed = std::make_shared<Diagnosed>();
        diagnosed->name = recording->name;
        require_dense(recording->series, recording->name);
        const auto series = gap::of_the_sensor(recording->series, diagnosed->notes);
        if (series.size() > gap::most_samples_at_once)
          throw InputError(
              recording->name,
              fmt::format(
                  "has {} samples; allowed: up to {}, as between() takes them, or `gyrostat "
                  "diagnose`, which looks at a longer one in stretches and in means",
                  series.size(), gap::most_samples_at_once));
        try {
          diagnosed->diagnosis = gap::diagnose(
              series, options,
              [&](const gap::DiagnosisStage& now) {
                work.tell(now.detail.empty() ? now.phase : now.phase + ": " + now.detail,
                          now.share);
              },
              Interrupt(work.stop));
        } catch (const InputError& mistake) {
          throw InputError(recording->name, mistake.what());
        }
        return diagnosed;
      },
      progress);
}

}  // namespace

void bind_findings(py::module_& module) {
  module.def("allan", &allan);
  module.def("allan_of_array", &allan_of_array);
  module.def("fit", &fit);
  py::class_<Applied, std::shared_ptr<Applied>>(module, "Applied")
      .def_readonly("tables", &Applied::tables)
      .def_readonly("notes", &Applied::notes)
      .def_property_readonly("judged_from_s",
                             [](const Applied& a) { return a.application.judged_from_s; })
      .def("series", &tracks_of);
  module.def("apply", &apply);
  py::class_<Diagnosed, std::shared_ptr<Diagnosed>>(module, "Diagnosed")
      .def_readonly("notes", &Diagnosed::notes)
      .def("answer", [](const Diagnosed& d) { return gap::answer(d.diagnosis); })
      .def("words", [](const Diagnosed& d) { return gap::in_words(d.diagnosis, d.name); })
      .def("json", [](const Diagnosed& d) { return gap::to_json(d.diagnosis).dump(); })
      .def("scenario",
           [](const Diagnosed& d) { return gap::scenario_json(d.diagnosis, d.name).dump(); })
      .def("tables", [](const Diagnosed& d) { return gap::diagnosis_tables(d.diagnosis, d.name); })
      .def("pictures",
           [](const Diagnosed& d) { return drawn(gap::diagnosis_pictures(d.diagnosis)); })
      .def("page", [](const Diagnosed& d) { return gap::diagnosis_page(d.diagnosis, d.name); });
  module.def("diagnose", &diagnose);
}

}  // namespace gyrostat::python
