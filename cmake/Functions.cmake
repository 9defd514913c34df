# gyrostat_functions(FOLDER experiments/cli/verbs ORDER order.txt INCLUDE experiments/cli/verbs.hpp
#                    NAMESPACE gyrostat::cli SOURCE variable
#                    DECLARE "void add_@id@(CLI::App& program)"
#                    DEFINE "void add_verbs(CLI::App& program)" CALL "add_@id@(program)")
#
# Every source of a folder defines one function, whose name follows from the file's stem: `rank`, or of 20_rank,
# where a number gives the place, `rank` too. Writes into the build tree <folder>/all.cpp, which defines a function
# that calls them all, in the order of the file ORDER where there is one, the rest behind by their names; leaves
# its path in <SOURCE>.
function(gyrostat_functions)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "FOLDER;ORDER;INCLUDE;PRELUDE;NAMESPACE;SOURCE;DECLARE;DEFINE;CALL" "")
  file(GLOB files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/${arg_FOLDER}
       ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.cpp)
  list(SORT files COMPARE NATURAL)
  set(stems "")
  foreach(file IN LISTS files)
    get_filename_component(stem ${file} NAME_WE)
    list(APPEND stems ${stem})
  endforeach()
  set(ordered "")
  if(arg_ORDER)
    set(order ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/${arg_ORDER})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${order})
    file(STRINGS ${order} ordered)
  endif()
  foreach(stem IN LISTS ordered)
    if(NOT stem IN_LIST stems)
      message(FATAL_ERROR "${order} names ${stem}, but there is no ${arg_FOLDER}/${stem}.cpp")
    endif()
  endforeach()
  list(REMOVE_ITEM stems ${ordered})
  set(declarations "")
  set(calls "")
  foreach(stem IN LISTS ordered stems)
    string(REGEX REPLACE "^[0-9]+_" "" id ${stem})
    string(CONFIGURE "${arg_DECLARE}" declaration @ONLY)
    string(CONFIGURE "${arg_CALL}" call @ONLY)
    string(APPEND declarations "${declaration};\n")
    string(APPEND calls "  ${call};\n")
  endforeach()
  set(include "")
  if(arg_INCLUDE)
    set(include "#include <gyrostat/${arg_INCLUDE}>\n\n")
  endif()
  set(source ${PROJECT_BINARY_DIR}/generated/gyrostat/${arg_FOLDER}/all.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT "${include}${arg_PRELUDE}namespace ${arg_NAMESPACE} {

${declarations}
${arg_DEFINE};
${arg_DEFINE} {
${calls}}

}  // namespace ${arg_NAMESPACE}
")
  set(${arg_SOURCE} ${source} PARENT_SCOPE)
endfunction()
