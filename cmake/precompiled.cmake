# The headers of others that nearly every file of the libraries reads are compiled once, by this library that
# does nothing else. Tests have their own, see tests/CMakeLists.txt.
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  return()  # clang asks for the same options everywhere
endif()

add_library(signorini_headers OBJECT EXCLUDE_FROM_ALL cmake/nothing.cpp)
target_link_libraries(signorini_headers PRIVATE signorini_settings Eigen3::Eigen fmt::fmt)
target_compile_options(signorini_headers PRIVATE ${eigen_warnings})
target_precompile_headers(signorini_headers PRIVATE <Eigen/Core> <fmt/format.h> <fmt/ranges.h> <algorithm> <array> <cmath>
  <filesystem> <functional> <map> <memory> <numeric> <optional> <set> <span> <string> <string_view> <utility> <vector>)

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
      target_precompile_headers(${target} REUSE_FROM signorini_headers)
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
