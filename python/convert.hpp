#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <gyrostat/core/table.hpp>
#include <gyrostat/recordings/recording.hpp>
#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat::python {

namespace py = pybind11;

/// A recording under the name that tables call it by.
struct NamedRecording {
  std::string name;
  Series series;
  std::vector<std::string> notes{};  ///< what was chosen, repaired or left out
};
using RecordingHandle = std::shared_ptr<NamedRecording>;  ///< nobody changes it

/// (id, title, SVG) of those pictures that have something to show.
using Drawn = std::vector<std::tuple<std::string, std::string, std::string>>;
Drawn drawn(std::span<const Picture> pictures);

/// The numbers where they lie, read-only; `owner` keeps them.
py::array_t<double> view_of(std::span<const double> values, const py::handle& owner);

void bind_tables(py::module_& module);
void bind_recordings(py::module_& module);
void bind_findings(py::module_& module);
void bind_runs(py::module_& module);

}  // namespace gyrostat::python
