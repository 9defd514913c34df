# gyrostat_script_modules(<variable> <folder>/page.js)
#
# One classic script of a module and all that it imports. A page that is one file, and opens from a disk,
# cannot import; so each module becomes a constant of the page, called as its file, that holds what the module
# exports, and the modules stand in the order of their imports. What a module neither exports nor
# imports is its own. Understood are, each on a line of its own,
#   import {a, b} from './file.js';
#   export const a, export class a, export function a
# and every other import or export is an error, as are an import of nothing and a circle.
function(gyrostat_script_modules variable file)
  set(done "")
  set(script "'use strict';\n")
  _gyrostat_script_module(${file} "")
  set(${variable} "${script}" PARENT_SCOPE)
endfunction()

# Appends to the caller's `script` what the module imports and then itself, to its `done` their names.
# `within` names the modules that import it.
function(_gyrostat_script_module file within)
  get_filename_component(name ${file} NAME_WE)
  get_filename_component(folder ${file} DIRECTORY)
  if(name IN_LIST within)
    list(JOIN within " → " path)
    message(FATAL_ERROR "script modules import in a circle: ${path} → ${name}")
  endif()
  if(NOT name MATCHES "^[a-z_]+$" OR NOT EXISTS ${file})
    message(FATAL_ERROR "no script module ${file}")
  endif()
  if(name IN_LIST done)
    return()
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(PREPEND text "\n")

  string(REGEX MATCHALL "\nimport {[A-Za-z, ]+} from './[a-z_]+\\.js'" imports "${text}")
  set(parameters "")  # so that an import may be called as the module it is from
  set(arguments "")
  foreach(import IN LISTS imports)
    string(REGEX MATCH "{(.*)} from './(.*)\\.js'" whole "${import}")
    list(APPEND parameters "{${CMAKE_MATCH_1}}")
    list(APPEND arguments ${CMAKE_MATCH_2})
    set(from ${CMAKE_MATCH_2})
    string(REGEX MATCHALL "[A-Za-z]+" wanted "${CMAKE_MATCH_1}")
    _gyrostat_script_module(${folder}/${from}.js "${within};${name}")
    get_property(exported GLOBAL PROPERTY gyrostat_exports_of_${from})
    foreach(one IN LISTS wanted)
      if(NOT one IN_LIST exported)
        message(FATAL_ERROR "${file}: ${from}.js exports no ${one}")
      endif()
    endforeach()
  endforeach()
  string(REGEX REPLACE "\nimport {[A-Za-z, ]+} from './[a-z_]+\\.js';" "" text "${text}")

  string(REGEX MATCHALL "\nexport (const|class|function) [A-Za-z]+" exports "${text}")
  list(TRANSFORM exports REPLACE "^.* " "")
  string(REGEX REPLACE "\nexport (const|class|function) " "\n\\1 " text "${text}")
  if(text MATCHES "\n(import|export)[^\n]*")
    message(FATAL_ERROR "${file}: not understood: ${CMAKE_MATCH_0}")
  endif()

  foreach(list exports parameters arguments)
    list(JOIN ${list} ", " ${list}_listed)
  endforeach()
  string(APPEND script "\nconst ${name} = ((${parameters_listed}) => {${text}\n"
                       "return {${exports_listed}};\n})(${arguments_listed});\n")
  list(APPEND done ${name})
  set(script "${script}" PARENT_SCOPE)
  set(done "${done}" PARENT_SCOPE)
  set_property(GLOBAL PROPERTY gyrostat_exports_of_${name} "${exports}")
endfunction()
