# Installs what was built, has the program there write a new plugin, and follows its README.
#   cmake -DBUILD= -DCOMPILER= -DSCRATCH= -P plugin_new.cmake
file(REMOVE_RECURSE ${SCRATCH})
foreach(part dev sdk libraries plugins program)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix --component ${part}
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND ${SCRATCH}/prefix/bin/signorini plugin new moving_wall ${SCRATCH}/wall --kind friction
  COMMAND_ERROR_IS_FATAL ANY)
file(READ ${SCRATCH}/wall/README.md readme)
string(REGEX MATCH "```sh\n(cmake [^\n]*)\n(ctest [^\n]*)\n```" found "${readme}")
if(NOT found)
  message(FATAL_ERROR "the README has no two commands to build and test it")
endif()
set(ENV{CXX} ${COMPILER})
foreach(command "${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}")
  execute_process(COMMAND sh -c "${command}" WORKING_DIRECTORY ${SCRATCH}/wall COMMAND_ERROR_IS_FATAL ANY)
endforeach()
