# Configuring SOURCE in SCRATCH without what is under the GPL looks for none of it, and builds none of it.
file(REMOVE_RECURSE ${SCRATCH})
execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${SOURCE} -B ${SCRATCH} -DSIGNORINI_GPL=OFF -DSIGNORINI_TESTS=OFF
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${SCRATCH}/CMakeCache.txt found REGEX "^[A-Za-z_]*(CGAL|CHOLMOD|UMFPACK|GMP|MPFR)")
file(STRINGS ${SCRATCH}/build.ninja built REGEX "libcholmod|libumfpack|libgmp|CGAL|core/geometry/cgal/|amg/linear/cholmod/")
file(STRINGS ${SCRATCH}/cmake_install.cmake installed REGEX "libsignorini_(geometry|cholmod)")
file(REMOVE_RECURSE ${SCRATCH})
if(found OR built OR installed)
  message(FATAL_ERROR "configuring looked for '${found}', builds '${built}', installs '${installed}'")
endif()
