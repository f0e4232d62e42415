# Uses the package as an outsider does: installs it, builds an example of the documentation against it without sight of
# this tree, and runs a program of it with the build folder as argument.
#   cmake -DBUILD= -DEXAMPLE= -DFILES= -DDOC= -DPROGRAM= -DSCRATCH= -DCOMPILER= -DINSTALLED= -P outside.cmake
# FILES of the folder EXAMPLE stand in DOC, but for what is marked as being for the test. INSTALLED are the components.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result}\n${output}")
  endif()
  message(STATUS "${output}")
endfunction()

foreach(name ${FILES})
  file(READ ${EXAMPLE}/${name} example)
  string(REGEX REPLACE "\n# For the test.*" "" example "${example}")
  file(READ ${DOC} text)
  string(FIND "${text}" "${example}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "${DOC} does not show ${name} as it is tested")
  endif()
endforeach()

file(REMOVE_RECURSE ${SCRATCH})
foreach(component ${INSTALLED})
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix --component ${component})
endforeach()
file(COPY ${EXAMPLE}/ DESTINATION ${SCRATCH}/example)
run(${CMAKE_COMMAND} -S ${SCRATCH}/example -B ${SCRATCH}/build -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix
  -DCMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${SCRATCH}/build/${PROGRAM} ${SCRATCH}/build)
