# cmake -DPROGRAM=<gyrostat> -DPAGE=<folder of a page> -DOUT=<folder> -P tests/published.cmake
#
# Makes the page anew with a few trials: its studies, tables, figures and text are sound.
cmake_minimum_required(VERSION 3.25)

get_filename_component(recordings ${PAGE}/../../../../shared/recordings ABSOLUTE)
if(NOT IS_DIRECTORY ${recordings})
  file(READ ${PAGE}/page.json sources)
  if(sources MATCHES "mtig|ledger")
    message(STATUS "SKIPPED: the recordings are not there")
    return()
  endif()
endif()
execute_process(COMMAND ${PROGRAM} publish ${PAGE} --trials 3 --out ${OUT}
                RESULT_VARIABLE failed ERROR_VARIABLE said)
if(failed)
  message(FATAL_ERROR "${said}")
endif()
