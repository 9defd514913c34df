# A release build from nothing compiles several sources as one, which share what their headers and templates cost:
# most of the time of a short source. The dev preset compiles each alone, so that each includes what it uses.
option(GYROSTAT_TOGETHER "Compile several sources as one" ON)

function(gyrostat_together target batch)
  if(GYROSTAT_TOGETHER AND TARGET ${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
  endif()
endfunction()

gyrostat_together(gyrostat_recordings 4)
gyrostat_together(gyrostat_analysis 10)
gyrostat_together(gyrostat_results 12)
gyrostat_together(gyrostat_diagnosis 12)
gyrostat_together(gyrostat_experiments 12)
gyrostat_together(gyrostat_cli 14)
gyrostat_together(gyrostat_python 4)
