# A plugin's sweeps are the inner loops of a solve.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  message(STATUS "signorini: no CMAKE_BUILD_TYPE given, taking Release")
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release (-O3) or RelWithDebInfo" FORCE)
endif()

# signorini_plugin(ID sources...): the module libsignorini_obstacle_ID.so that exports nothing but `signorini_plugin`
# and whose every reference is met when it is linked. Used in this tree and, after find_package(signorini), outside it.
# signorini_estimator(ID sources...): the same of an estimator, libsignorini_estimator_ID.so.
function(signorini_plugin id)
  signorini_plugin_library(signorini_obstacle_${id} ${ARGN})
endfunction()
function(signorini_estimator id)
  signorini_plugin_library(signorini_estimator_${id} ${ARGN})
endfunction()
function(signorini_plugin_library target)
  set(map ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/signorini_plugin.map)
  add_library(${target} MODULE ${ARGN})
  target_link_libraries(${target} PRIVATE signorini::sdk)
  target_link_options(${target} PRIVATE LINKER:--version-script=${map})
  # Clang leaves the functions of a sanitizer to be met by the program.
  if(NOT (CMAKE_CXX_COMPILER_ID MATCHES Clang AND "${CMAKE_CXX_FLAGS} ${SIGNORINI_SANITIZE}" MATCHES "sanitize|address|thread|undefined"))
    target_link_options(${target} PRIVATE LINKER:-z,defs)
  endif()
  set_target_properties(${target} PROPERTIES
    LINK_DEPENDS ${map}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()
