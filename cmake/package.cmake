# Debian packages, by `cpack -G DEB`, one for each component of the installation. What only packages have (copyright and
# changelog, pages that are compressed, no paths to libraries) is added by debian.cmake when they are made.
set(CPACK_PACKAGE_NAME signorini)
set(CPACK_PACKAGE_VENDOR "the signorini authors")
# The default, which CPack then leaves out: each package has a summary of its own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${CMAKE_PROJECT_NAME} built using CMake")
set(SIGNORINI_MAINTAINER "The signorini authors <authors@signorini.invalid>" CACHE STRING "Whom Debian packages name as their maintainer")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${SIGNORINI_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian.cmake)
set(CPACK_SIGNORINI_SOURCE ${PROJECT_SOURCE_DIR})  # for debian.cmake

# Libraries have the system's table of libraries written anew by a trigger. CPack would call ldconfig in scripts; where it
# is given scripts it writes none, and those of this folder are not there.
file(WRITE ${PROJECT_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
set(no_scripts ${PROJECT_BINARY_DIR}/debian/none/postinst ${PROJECT_BINARY_DIR}/debian/none/postrm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${no_scripts})

# signorini_debian(COMPONENT NAME SECTION DEPENDS SUMMARY DESCRIPTION)
macro(signorini_debian component name section depends summary description)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${description}")
endmacro()

set(this "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(minor ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
get_target_property(c_version signorini_c SOVERSION)
get_target_property(sdk_version signorini_sdk SOVERSION)
set(libraries libsignorini${minor})
set(c libsignorini-c${c_version})
set(sdk libsignorini-sdk${sdk_version})
set(about "signorini presses elastic bodies onto each other and onto rigid\nobstacles, and solves quadratic programs with bounds, by monotone\nmultigrid methods.")

set(CPACK_COMPONENTS_ALL)
signorini_debian(program signorini math "${libraries} ${this}, signorini-plugins ${this}"
  "solver of contact and obstacle problems" "${about}\nThis is the program, which reads a scene and writes results.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "signorini-gpl ${this}")
signorini_debian(libraries ${libraries} libs "${sdk} ${this}"
  "library for contact and obstacle problems" "${about}\nThis is the library that the program and other programs in C++ share.")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_RECOMMENDS "signorini-plugins ${this}")
signorini_debian(sdk ${sdk} libs ""
  "library that obstacle plugins for signorini link" "${about}\nThis is what plugins with further types of obstacles are linked with.")
signorini_debian(c ${c} libs ""
  "solver of quadratic programs with bounds" "${about}\nThis is the solver for matrices of other programs, in C.")
signorini_debian(plugins signorini-plugins math "${sdk} ${this}"
  "types of obstacles for signorini" "${about}\nThese are the types of obstacles that come with it: contact, friction,\nelastic bodies, glue.")
if(SIGNORINI_GPL)
  signorini_debian(gpl signorini-gpl math "${libraries} ${this}"
    "meshes and direct solvers for signorini" "${about}\nThese libraries are linked with CGAL, CHOLMOD and UMFPACK, and so are\nunder the GPL.")
endif()
signorini_debian(dev libsignorini-dev libdevel
  "${libraries} ${this}, ${sdk} ${this}, ${c} ${this}, libeigen3-dev, libfmt-dev, libmetis-dev, nlohmann-json3-dev"
  "headers of signorini" "${about}\nThese are headers, static libraries, and the files by which CMake and\npkg-config find them.")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "signorini-plugins ${this}")

foreach(component LIBRARIES SDK C GPL)
  set(CPACK_DEBIAN_${component}_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/triggers ${no_scripts})
endforeach()

include(CPack)
