# gyrostat_type_of(sr_ukf variable): SrUkf
function(gyrostat_type_of id variable)
  string(REPLACE "_" ";" words ${id})
  set(type "")
  foreach(word IN LISTS words)
    string(SUBSTRING ${word} 0 1 head)
    string(SUBSTRING ${word} 1 -1 tail)
    string(TOUPPER ${head} head)
    string(APPEND type ${head}${tail})
  endforeach()
  set(${variable} ${type} PARENT_SCOPE)
endfunction()

# gyrostat_plugins(FOLDER core/filters LIST Filters NAMESPACE gyrostat::filters KIND ScalarPlugin
#                  HEADER core/filter_type.hpp TYPE FilterType DESCRIBE "to.push_back(describe_filter<@type@>(\"@id@\"))"
#                  UNITS 4 SOURCES variable)
#
# Every header of a folder is a plug-in: its stem, sr_ukf, is the name that users see, and the type is SrUkf.
# Writes into the build tree
#   <folder>/list.hpp       `using <LIST> = PluginList<KIND<"stem", Type>, …>`, for who works on the types
#   <folder>/described*.cpp what the registry knows of them: each header is compiled in one of UNITS sources
# and leaves the sources in <SOURCES>.
function(gyrostat_plugins)
  cmake_parse_arguments(arg "" "FOLDER;LIST;NAMESPACE;KIND;HEADER;TYPE;DESCRIBE;UNITS;SOURCES" "" ${ARGN})
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
       ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.hpp)
  list(SORT headers)
  if(NOT arg_UNITS)
    set(arg_UNITS 1)
  endif()
  set(generated ${PROJECT_BINARY_DIR}/generated/gyrostat/${arg_FOLDER})
  set(includes "")
  set(entries "")
  set(count 0)
  set(sources "")
  set(declarations "")
  set(calls "")
  list(LENGTH headers total)
  math(EXPR per_unit "(${total} + ${arg_UNITS} - 1) / ${arg_UNITS}")
  foreach(header IN LISTS headers)
    get_filename_component(id ${header} NAME_WE)
    gyrostat_type_of(${id} type)
    set(type ${arg_NAMESPACE}::${type})
    string(APPEND includes "#include <gyrostat/${header}>\n")
    list(APPEND entries "    ${arg_KIND}<\"${id}\", ${type}>")

    math(EXPR unit "${count} / ${per_unit}")
    math(EXPR count "${count} + 1")
    string(CONFIGURE "${arg_DESCRIBE}" call @ONLY)
    string(APPEND unit_includes_${unit} "#include <gyrostat/${header}>\n")
    string(APPEND unit_calls_${unit} "  ${call};\n")
  endforeach()
  list(JOIN entries ",\n" entries)
  file(CONFIGURE OUTPUT ${generated}/list.hpp @ONLY CONTENT "#pragma once

#include <gyrostat/core/plugin.hpp>
${includes}
namespace gyrostat {

/// Every plug-in of ${arg_FOLDER}, in the order of their names.
using ${arg_LIST} = PluginList<
${entries}>;

}  // namespace gyrostat
")
  if(NOT arg_TYPE)
    return()
  endif()
  foreach(u RANGE ${unit})
    set(function describe_${arg_LIST}_${u})
    string(APPEND declarations "void ${function}(std::deque<${arg_TYPE}>& to);\n")
    string(APPEND calls "  ${function}(to);\n")
    file(CONFIGURE OUTPUT ${generated}/described_${u}.cpp @ONLY CONTENT "#include <gyrostat/${arg_HEADER}>

${unit_includes_${u}}
namespace gyrostat {

void ${function}(std::deque<${arg_TYPE}>& to);
void ${function}(std::deque<${arg_TYPE}>& to) {
${unit_calls_${u}}}

}  // namespace gyrostat
")
    list(APPEND sources ${generated}/described_${u}.cpp)
  endforeach()
  set(specialised "")
  if(arg_TYPE MATCHES "^(Temperature|Motion|Acceleration)Type$")
    set(specialised "template <>\n")
  endif()
  file(CONFIGURE OUTPUT ${generated}/described.cpp @ONLY CONTENT "#include <gyrostat/${arg_HEADER}>

namespace gyrostat {

${declarations}
${specialised}void ${arg_TYPE}::describe_all(std::deque<${arg_TYPE}>& to) {
${calls}}

}  // namespace gyrostat
")
  list(APPEND sources ${generated}/described.cpp)
  set(${arg_SOURCES} ${sources} PARENT_SCOPE)
endfunction()
