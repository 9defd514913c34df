# cmake -DSOURCE_DIR=<project> -DOUT=<folder> -P tests/script_modules.cmake
#
# Modules stand after those they import, each once; what cannot be combined is an error that names it.
cmake_minimum_required(VERSION 3.25)

if(INPUT)
  include(${SOURCE_DIR}/cmake/ScriptModules.cmake)
  gyrostat_script_modules(script ${INPUT})
  file(WRITE ${INPUT}.out "${script}")
  return()
endif()

function(expect what saying)
  execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${SOURCE_DIR} -DINPUT=${OUT}/page.js
                          -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE} ERROR_VARIABLE said RESULT_VARIABLE failed)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  if(NOT failed OR NOT said MATCHES "${saying}")
    message(SEND_ERROR "${what}: expected '${saying}', not '${said}'")
  endif()
endfunction()

file(REMOVE_RECURSE ${OUT})
file(WRITE ${OUT}/scales.js "export const one = 1;\nconst own = [';', 2];\n")
file(WRITE ${OUT}/marks.js "import {one} from './scales.js';\n\nexport class Two {}\nexport function marks() { return one; }\n")
file(WRITE ${OUT}/page.js "import {one} from './scales.js';\nimport {Two, marks} from './marks.js';\nmarks(one, Two);\n")
execute_process(COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${SOURCE_DIR} -DINPUT=${OUT}/page.js
                        -P ${CMAKE_CURRENT_LIST_FILE} COMMAND_ERROR_IS_FATAL ANY)
file(READ ${OUT}/page.js.out script)
set(wanted "'use strict';

const scales = (() => {
const one = 1;
const own = [';', 2];

return {one};
})();

const marks = (({one}) => {

class Two {}
function marks() { return one; }

return {Two, marks};
})(scales);

const page = (({one}, {Two, marks}) => {
marks(one, Two);

return {};
})(scales, marks);
")
if(NOT script STREQUAL wanted)
  message(SEND_ERROR "combined to\n${script}")
endif()

file(WRITE ${OUT}/page.js "import {four} from './scales.js';\n")
expect("an import of nothing" "scales.js exports no four")
file(WRITE ${OUT}/page.js "import {four} from './nowhere.js';\n")
expect("an import from nowhere" "no script module .*nowhere.js")
file(WRITE ${OUT}/page.js "export {one};\n")
expect("a form of its own" "not understood: export {one}")
file(WRITE ${OUT}/page.js "import {one} from './marks.js';\nexport const a = 1;\n")
file(WRITE ${OUT}/marks.js "import {a} from './page.js';\nexport const one = 1;\n")
expect("a circle" "in a circle: .*page → marks → page")
