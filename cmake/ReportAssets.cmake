# The script and style of pages whose pictures move, and µPlot as npm put it into node_modules. Without µPlot reports are
# made all the same: their pictures then stand still.
include(${CMAKE_CURRENT_LIST_DIR}/ScriptModules.cmake)
gyrostat_script_modules(report_script ${PROJECT_SOURCE_DIR}/experiments/findings/report/script/page.js)
file(READ ${PROJECT_SOURCE_DIR}/experiments/findings/report/report.css report_style)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
             ${PROJECT_SOURCE_DIR}/experiments/findings/report/report.css
             ${PROJECT_SOURCE_DIR}/package-lock.json)

set(uplot ${PROJECT_SOURCE_DIR}/node_modules/uplot)
set(uplot_script_file dist/uPlot.iife.min.js)
set(uplot_style_file dist/uPlot.min.css)
set(uplot_licence_file LICENSE)
foreach(part script style licence)
  set(uplot_${part} "")
  if(EXISTS ${uplot}/${uplot_${part}_file})
    file(READ ${uplot}/${uplot_${part}_file} uplot_${part})
  endif()
endforeach()
if(NOT uplot_script)
  message(WARNING "no node_modules/uplot: the pictures of `gyrostat report` will not zoom; `npm ci` brings it")
endif()

set(constants "")
foreach(name report_script report_style uplot_script uplot_style uplot_licence)
  string(APPEND constants "inline constexpr const char* ${name} = R\"embedded(${${name}})embedded\";\n")
endforeach()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/gyrostat/experiments/findings/report/assets.hpp @ONLY CONTENT "#pragma once

namespace gyrostat {

${constants}
}  // namespace gyrostat
")
