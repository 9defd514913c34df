#include <sstream>

#include <pybind11/stl.h>

#include <gyrostat/experiments/run/trial.hpp>
#include <gyrostat/experiments/study/json_object.hpp>
#include <gyrostat/experiments/study/study.hpp>
#include <gyrostat/python/convert.hpp>
#include <gyrostat/python/work.hpp>
#include <gyrostat/recordings/clock.hpp>
#include <gyrostat/recordings/column_table.hpp>
#include <gyrostat/recordings/format_type.hpp>
#include <gyrostat/recordings/write_columns.hpp>

namespace gyrostat::python {
namespace {

/// What the caller says of a recording.
struct Told {
  std::string axis;
  RecordingLayout layout;
};

using Assignments = std::map<std::string, std::string>;

Told told(const std::string& axis, const Assignments& columns, const Assignments& units,
          const std::string& preset, const std::string& topic, double rate_hz, double resample_hz) {
  return {axis,
          {.columns = columns,
           .units = units,
           .place = columns.empty() ? "units" : "columns",
           .preset = preset,
           .topic = topic,
           .rate_hz = rate_hz,
           .resample_hz = resample_hz}};
}

/// On an even clock; `notes` say as what it was read and what was done to it.
RecordingHandle finished(Recording recording, const std::string& name, const Told& told) {
  make_even(recording, name, told.layout);
  auto named = std::make_shared<NamedRecording>();
  named->name = name + (told.axis.empty() ? "" : " axis " + told.axis);
  if (!recording.format.empty())
    named->notes.push_back(fmt::format(
        "{} ({})", format_types().named(recording.format, name).title, recording.format));
  const auto add = [&](const auto& lines) {
    named->notes.insert(named->notes.end(), lines.begin(), lines.end());
  };
  add(recording.taken_as);
  if (!recording.ignored_columns.empty())
    named->notes.push_back(
        fmt::format("columns not used: {}", fmt::join(recording.ignored_columns, ", ")));
  add(recording.notes);
  named->series = std::move(recording.series);
  return named;
}

RecordingHandle read(const std::string& file, const std::string& axis, const Assignments& columns,
                     const Assignments& units, const std::string& preset, const std::string& topic,
                     double rate_hz, double resample_hz) {
  const auto how = told(axis, columns, units, preset, topic, rate_hz, resample_hz);
  return result_of([=] { return finished(read_recording(file, how.axis, how.layout), file, how); });
}

using Column = py::array_t<double, py::array::c_style | py::array::forcecast>;

RecordingHandle of_columns(const std::vector<std::pair<std::string, Column>>& data,
                           const std::string& name, const std::string& axis,
                           const Assignments& columns, const Assignments& units, double rate_hz,
                           double resample_hz) {
  const auto how = told(axis, columns, units, "", "", rate_hz, resample_hz);
  ColumnTable table;
  for (const auto& [column, values] : data) {
    if (values.ndim() != 1)
      throw InputError(name,
                       fmt::format("'{}' has {} dimensions; allowed: 1", column, values.ndim()));
    table.add(column, std::vector<double>(values.data(), values.data() + values.size()));
  }
  return finished(recording_of_columns(std::move(table), name, how.axis, how.layout), name, how);
}

RecordingHandle simulate(const std::string& json, const std::string& path, const std::string& cell,
                         std::uint32_t trial) {
  return result_of([=] {
    const Study study = parse_study(Json::parse(json), path);
    const Cell& chosen = cell_named(study, cell, "cell");
    auto made = std::make_shared<NamedRecording>();
    made->name = fmt::format("{}: trial {} of {}", study.name(), trial, chosen.name);
    Scenario drawn;
    const Noise noise{study.seed, trial};
    synthesise(sensor_of(chosen, noise, drawn), noise, made->series);
    return RecordingHandle(std::move(made));
  });
}

RecordingHandle between(const RecordingHandle& recording, double from_s, double to_s) {
  return std::make_shared<NamedRecording>(
      NamedRecording{recording->name, cut(recording->series, from_s, to_s, recording->name)});
}

py::dict channels_of(const RecordingHandle& recording) {
  py::dict all;
  const auto owner = py::cast(recording);
  for (const auto& channel : channels)
    if (const auto& values = recording->series.*channel.values; !values.empty())
      all[py::str(std::string(channel.name))] = view_of(values, owner);
  return all;
}

}  // namespace

void bind_recordings(py::module_& module) {
  py::class_<NamedRecording, std::shared_ptr<NamedRecording>>(module, "Recording")
      .def_readonly("name", &NamedRecording::name)
      .def_readonly("notes", &NamedRecording::notes)
      .def_property_readonly("rate_hz", [](const NamedRecording& r) { return r.series.rate_hz(); })
      .def_property_readonly("duration_s",
                             [](const NamedRecording& r) { return r.series.duration_s(); })
      .def("__len__", [](const NamedRecording& r) { return r.series.size(); })
      .def("channels",
           [](const std::shared_ptr<NamedRecording>& recording) { return channels_of(recording); })
      .def("between", [](const std::shared_ptr<NamedRecording>& recording, double from_s,
                         double to_s) { return between(recording, from_s, to_s); })
      .def("write", [](const std::shared_ptr<NamedRecording>& recording, const std::string& path) {
        result_of([=, handle = RecordingHandle(recording)] {
          write_series(path, handle->series);
          return true;
        });
      });
  module.def("read", &read);
  module.def("of_columns", &of_columns);
  module.def("simulate", &simulate);
  py::list units;
  for (const auto& channel : channels)
    units.append(py::make_tuple(std::string(channel.name), std::string(channel.unit)));
  module.attr("channels") = py::tuple(units);
}

}  // namespace gyrostat::python
