# The headers of others that nearly every file of the libraries reads are compiled once, by this library that
# does nothing else. Tests have their own, see tests/CMakeLists.txt.
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  return()  # clang asks for the same options everywhere
endif()

# Twice, for gcc compiles functions with the level of optimisation that the headers were compiled with, whatever it is
# told afterwards: once as the build type says, and once with -O1.
function(signorini_headers name)
  add_library(${name} OBJECT EXCLUDE_FROM_ALL cmake/nothing.cpp)
  target_link_libraries(${name} PRIVATE signorini_settings Eigen3::Eigen fmt::fmt)
  target_compile_options(${name} PRIVATE ${eigen_warnings} ${ARGN})
  target_precompile_headers(${name} PRIVATE <Eigen/Core> <fmt/format.h> <fmt/ranges.h> <algorithm> <array> <cmath>
    <filesystem> <functional> <map> <memory> <numeric> <optional> <set> <span> <string> <string_view> <utility> <vector>)
endfunction()
signorini_headers(signorini_headers)
signorini_headers(signorini_headers_O1 $<$<CONFIG:Release>:-O1>)

# signorini_precompiled(FOLDER): for every library made in FOLDER or below that uses these headers, but for those that
# round otherwise: what is inline in the headers would be rounded as it was when they were compiled.
function(signorini_precompiled folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    get_target_property(libraries ${target} LINK_LIBRARIES)
    get_target_property(options ${target} COMPILE_OPTIONS)
    list(REMOVE_ITEM libraries signorini_settings signorini_sdk signorini::sdk)  # plugins read few of them, and no fmt
    if(type MATCHES "(MODULE|OBJECT|SHARED|STATIC)_LIBRARY" AND libraries MATCHES "signorini|fmt"
        AND NOT options MATCHES "ffp-contract")
      if(options MATCHES "-O1")
        target_precompile_headers(${target} REUSE_FROM signorini_headers_O1)
      else()
        target_precompile_headers(${target} REUSE_FROM signorini_headers)
      endif()
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(below ${folders})
    signorini_precompiled(${below})
  endforeach()
endfunction()

foreach(folder core transfer smoothers methods amg c estimators obstacles driver conformance apps)
  signorini_precompiled(${folder})
endforeach()
