# gyrostat_embed(results/schema.sql results/schema.hpp schema_sql)
#
# Writes a header into the build tree that holds the file's text as `inline constexpr`.
function(gyrostat_embed file header name)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
  file(READ ${PROJECT_SOURCE_DIR}/${file} text)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/gyrostat/${header} @ONLY CONTENT "#pragma once

namespace gyrostat {

inline constexpr const char* ${name} = R\"embedded(${text})embedded\";

}  // namespace gyrostat
")
endfunction()
