# Installs the build, moves what was installed, builds the example against it and runs its method:
#   cmake -D BUILD=build -D EXAMPLE=folder -D WORK=folder -P installed.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command} ended with ${status}:\n${said}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/moved)
foreach(project example example/program)
  cmake_path(GET EXAMPLE PARENT_PATH folder)
  run(${CMAKE_COMMAND} -S ${folder}/${project} -B ${WORK}/${project} -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/moved
      -DCMAKE_BUILD_TYPE=Debug)
  run(${CMAKE_COMMAND} --build ${WORK}/${project})
endforeach()

# A program that links ours
run(${WORK}/example/program/slab_program)
# In a process of its own, as `run` makes it, and once more in those that a launcher starts.
set(meltfront ${WORK}/moved/bin/meltfront)
set(plugin --plugin ${WORK}/example/libslab_volumes.so)
run(${meltfront} run plane-freezing --method slab-volumes ${plugin} --n 80 --frames 2 --out ${WORK}/run)
file(WRITE ${WORK}/slab.prm "set title = A plugin's method beside ours
subsection Block 1
  set cases = plane-freezing
  set methods = slab-volumes, fem-enthalpy
  set resolutions = 20, 40
end
")
run(${meltfront} verify ${WORK}/slab.prm ${plugin} --out ${WORK}/matrix --launcher env)
foreach(record run/run.json "matrix/runs/plane-freezing/slab-volumes/n=40/run.json")
  file(READ ${WORK}/${record} text)
  string(JSON status GET "${text}" status)
  string(JSON front_rms GET "${text}" quantities front_rms)
  string(JSON defect GET "${text}" quantities budget_defect)
  string(JSON hash GET "${text}" provenance plugin_hash)
  if(NOT status STREQUAL finished OR NOT front_rms LESS 0.004 OR NOT defect LESS 1e-12)
    message(FATAL_ERROR "${record}: ${status}, front_rms ${front_rms}, budget_defect ${defect}")
  endif()
endforeach()
execute_process(COMMAND ${meltfront} list methods --plugin ${WORK}/slab.prm RESULT_VARIABLE status ERROR_VARIABLE said)
if(NOT status EQUAL 2 OR NOT said MATCHES "slab.prm: cannot be loaded as a shared library")
  message(FATAL_ERROR "A plugin that is none: status ${status}, ${said}")
endif()
