#pragma once

#include <pybind11/pybind11.h>

namespace gyrostat::python {

/// `add_filter` and `add_effect`: functions in Python join the registries.
void bind_plugins(pybind11::module_& module);

/// Raises KeyboardInterrupt in every plug-in that is running Python at this moment; its trial is
/// then no outcome. With the interpreter's lock.
void interrupt_plugins();

}  // namespace gyrostat::python
