# Configuring SOURCE in SCRATCH looks for nothing of the solvers of others.
file(REMOVE_RECURSE ${SCRATCH})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH} -DSIGNORINI_TESTS=OFF OUTPUT_QUIET
  COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${SCRATCH}/CMakeCache.txt found REGEX "^[A-Za-z_]*(PETSC|PETSc|MPI_|IPOPT|HYPRE|AMGCL)")
file(REMOVE_RECURSE ${SCRATCH})
if(found)
  message(FATAL_ERROR "configuring looked for ${found}")
endif()
