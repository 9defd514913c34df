# cmake -DNM=<nm> -DLIBRARY=<a library with kernels> -P tests/targets.cmake
#
# Code of packed kernels that the linker could take for that of another instruction set: weak
# functions of kernels_*.o without a target in their names. There must be none, or a machine without
# AVX would run AVX code.
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${NM} --defined-only ${LIBRARY} OUTPUT_VARIABLE symbols
                ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${NM} ${LIBRARY} failed")
endif()
string(REPLACE "\n" ";" lines "${symbols}")
set(kernel "")
set(kernels 0)
set(offences "")
foreach(line IN LISTS lines)
  if(line MATCHES "^(.*)\\.o:$")
    set(kernel "")
    if(CMAKE_MATCH_1 MATCHES "kernels_(sse2|avx2|avx512)")
      set(kernel ${CMAKE_MATCH_1})
      math(EXPR kernels "${kernels} + 1")
    endif()
  elseif(kernel AND line MATCHES " [WTtu] (.*)$" AND NOT CMAKE_MATCH_1 MATCHES "7targets|kernels_")
    list(APPEND offences "${kernel}: ${CMAKE_MATCH_1}")
  endif()
endforeach()
if(kernels EQUAL 0)
  message(FATAL_ERROR "no kernels in ${LIBRARY}")
endif()
if(offences)
  list(JOIN offences "\n  " shown)
  message(FATAL_ERROR "without a target in their names:\n  ${shown}")
endif()
