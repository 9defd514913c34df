#include <gyrostat/recordings/matlab_library.hpp>

#include <stdexcept>
#include <string>

#include <dlfcn.h>

namespace gyrostat {
namespace {

template <class Function>
void find(void* library, const char* name, Function*& function) {
  function = reinterpret_cast<Function*>(dlsym(library, name));
  if (!function) throw std::runtime_error(std::string(GYROSTAT_MATIO " has no ") + name);
}

MatlabLibrary opened() {
  void* const library = dlopen(GYROSTAT_MATIO, RTLD_NOW | RTLD_LOCAL);
  if (!library)
    throw std::runtime_error(std::string("MATLAB files need the library matio: ") + dlerror());
  MatlabLibrary found{};
  find(library, "Mat_Open", found.open);
  find(library, "Mat_CreateVer", found.create);
  find(library, "Mat_Close", found.close);
  find(library, "Mat_VarReadNext", found.read_next);
  find(library, "Mat_VarFree", found.free);
  find(library, "Mat_VarGetNumberOfFields", found.number_of_fields);
  find(library, "Mat_VarGetStructFieldByIndex", found.field);
  find(library, "Mat_VarCreate", found.variable);
  find(library, "Mat_VarSetCell", found.set_cell);
  find(library, "Mat_VarWrite", found.write);
  return found;
}

}  // namespace

const MatlabLibrary& matlab_library() {
  static const MatlabLibrary library = opened();
  return library;
}

}  // namespace gyrostat
