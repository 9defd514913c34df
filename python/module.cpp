#include <gyrostat/core/error.hpp>
#include <gyrostat/python/convert.hpp>
#include <gyrostat/python/plugins.hpp>
#include <gyrostat/python/work.hpp>

// What `gyrostat` (the package, in Python) stands on; _library.pyi says what is in it.
PYBIND11_MODULE(_library, module) {
  namespace py = pybind11;
  using namespace gyrostat::python;
  module.attr("version") = GYROSTAT_VERSION;
  static py::exception<gyrostat::InputError> error(module, "Error");
  error.attr("__module__") = "gyrostat";
  error.attr("__doc__") =
      "What was asked for cannot be done: one line that names the place, the value and what would "
      "do, as the program gyrostat says it.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const py::builtin_exception&) {
      throw;  // a TypeError, a ValueError: pybind11's own
    } catch (const std::runtime_error& failure) {
      error(failure.what());
    }
  });
  bind_tables(module);
  bind_recordings(module);
  bind_findings(module);
  bind_runs(module);
  bind_plugins(module);
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_abandoned));
}
