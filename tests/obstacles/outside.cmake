# Uses the package as an outsider does: installs it, builds the example of docs/plugins.md against it without sight of
# this tree, and loads the plugin.   cmake -DBUILD= -DSOURCE= -DDOCS= -DSCRATCH= -DCOMPILER= -P outside.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${output}")
  endif()
  message(STATUS "${output}")
endfunction()

foreach(name slot.cpp CMakeLists.txt)
  file(READ ${SOURCE}/${name} example)
  string(REGEX REPLACE "\n# For the test.*" "" example "${example}")
  file(READ ${DOCS}/plugins.md text)
  string(FIND "${text}" "${example}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "docs/plugins.md does not show ${name} as it is tested")
  endif()
endforeach()

file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix --component sdk)
file(COPY ${SOURCE}/ DESTINATION ${SCRATCH}/slot)
run(${CMAKE_COMMAND} -S ${SCRATCH}/slot -B ${SCRATCH}/build -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${SCRATCH}/build/load ${SCRATCH}/build)
