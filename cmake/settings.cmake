set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release (-O3) or RelWithDebInfo" FORCE)
endif()
# Everything that runs lies beside what it loads, in the build tree as in the installed one.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

# Checks: assert() and SIGNORINI_CHECKS, whose checks cost more than an assertion may (the energy of every cycle).
set(checks OFF)
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(checks ON)
endif()
option(SIGNORINI_CHECKS "Check the program's own invariants at run time" ${checks})

# The one place that knows the version is project(); everything else includes core/base/version.hpp.
configure_file(${PROJECT_SOURCE_DIR}/core/base/version.hpp.in ${PROJECT_BINARY_DIR}/include/core/base/version.hpp @ONLY)

add_library(signorini_settings INTERFACE)
target_include_directories(signorini_settings INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>)
target_compile_features(signorini_settings INTERFACE cxx_std_20)
target_compile_options(signorini_settings INTERFACE $<BUILD_INTERFACE:-Wall;-Wextra;-Wshadow;-Wno-psabi>)
# Where several files are compiled as one, what is local to one of them is there for the others, too.
target_compile_options(signorini_settings INTERFACE
  $<BUILD_INTERFACE:$<$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>:-Wno-shadow;-Wno-subobject-linkage>>)
if(SIGNORINI_NATIVE)
  # Not for programs that link the installed libraries: these may be for other processors, and are checked by valgrind.
  target_compile_options(signorini_settings INTERFACE $<BUILD_INTERFACE:-march=native>)
  # For what includes Eigen: GCC 12 takes registers that AVX-512 intrinsics leave undefined on purpose, and vectors that
  # small matrices never fill, for mistakes.
  set(eigen_warnings $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized;-Wno-maybe-uninitialized;-Wno-array-bounds>)
endif()
if(SIGNORINI_CHECKS)
  target_compile_definitions(signorini_settings INTERFACE $<BUILD_INTERFACE:SIGNORINI_CHECKS=1>)
  target_compile_options(signorini_settings INTERFACE $<BUILD_INTERFACE:-UNDEBUG>)
endif()
# GCC 12 sees overflows in fmt 9's header and in loops over the components of scalars that are none.
target_compile_options(signorini_settings INTERFACE
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>>)
if(SIGNORINI_SANITIZE)
  set(sanitize -fsanitize=${SIGNORINI_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_compile_options(signorini_settings INTERFACE ${sanitize})
  target_link_options(signorini_settings INTERFACE ${sanitize})
endif()
