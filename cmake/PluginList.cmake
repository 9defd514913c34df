# gyrostat_plugin_list(FOLDER core/filters LIST Filters NAMESPACE gyrostat::filters KIND ScalarPlugin)
#
# Writes <folder>/list.hpp into the build tree: an include for every header of the folder and
# `using <LIST> = PluginList<KIND<"stem", Type>, ...>`. The stem sr_ukf stands for the type SrUkf.
function(gyrostat_plugin_list)
  cmake_parse_arguments(arg "" "FOLDER;LIST;NAMESPACE;KIND" "" ${ARGN})
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
       ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.hpp)
  list(SORT headers)
  set(includes "")
  set(entries "")
  foreach(header IN LISTS headers)
    get_filename_component(stem ${header} NAME_WE)
    string(REPLACE "_" ";" words ${stem})
    set(type "")
    foreach(word IN LISTS words)
      string(SUBSTRING ${word} 0 1 head)
      string(SUBSTRING ${word} 1 -1 tail)
      string(TOUPPER ${head} head)
      string(APPEND type ${head}${tail})
    endforeach()
    string(APPEND includes "#include \"${header}\"\n")
    list(APPEND entries "    ${arg_KIND}<\"${stem}\", ${arg_NAMESPACE}::${type}>")
  endforeach()
  list(JOIN entries ",\n" entries)
  set(text "#pragma once

#include \"core/plugin.hpp\"
${includes}
namespace gyrostat {

/// Every plug-in of ${arg_FOLDER}, in the order of their names.
using ${arg_LIST} = PluginList<
${entries}>;

}  // namespace gyrostat
")
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${arg_FOLDER}/list.hpp
       CONTENT "${text}" @ONLY)
endfunction()
