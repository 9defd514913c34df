#pragma once

#include <matio.h>

namespace gyrostat {

/// What gyrostat calls of matio. The library is opened when the first MATLAB file is, not with the
/// program: it brings HDF5 and, by it, thirty libraries of networks, which took two thirds of the
/// time in which `gyrostat --help` answers.
struct MatlabLibrary {
  decltype(&::Mat_Open) open;
  decltype(&::Mat_CreateVer) create;
  decltype(&::Mat_Close) close;
  decltype(&::Mat_VarReadNext) read_next;
  decltype(&::Mat_VarFree) free;
  decltype(&::Mat_VarGetNumberOfFields) number_of_fields;
  decltype(&::Mat_VarGetStructFieldByIndex) field;
  decltype(&::Mat_VarCreate) variable;
  decltype(&::Mat_VarSetCell) set_cell;
  decltype(&::Mat_VarWrite) write;
};

/// Safe from any thread. Throws std::runtime_error where the library is not there.
const MatlabLibrary& matlab_library();

}  // namespace gyrostat
