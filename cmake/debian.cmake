# Runs within cpack, on what was installed for each package: adds copyright and changelog, compresses manual pages, and
# takes the paths to libraries away, for these lie where every program finds them.
cmake_policy(VERSION 3.25)
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()

function(compress file)
  execute_process(COMMAND gzip -9 --no-name ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(READ ${CPACK_SIGNORINI_SOURCE}/LICENSE licence)
string(REGEX REPLACE "\n+$" "" licence "${licence}")
string(REGEX REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REGEX REPLACE "\n" "\n " licence "${licence}")
set(copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/

Files: *
Copyright: 2026, the signorini authors
License: BSD-3-clause
 ${licence}
")
set(copyright_gpl "${copyright}
Files: usr/lib/*
Copyright: 2026, the signorini authors
License: BSD-3-clause and GPL-3+
 The sources are under the BSD licence above. The libraries are linked with CGAL
 (GPL-3.0-or-later), or CHOLMOD and UMFPACK (GPL-2.0-or-later), and may be given
 away under the terms of these licences.
 .
 On Debian systems they stand in /usr/share/common-licenses/GPL-3 and GPL-2.
")

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  if(NOT IS_DIRECTORY ${root})
    message(FATAL_ERROR "${package}: nothing was installed in ${root}")
  endif()
  if(NOT package STREQUAL "signorini" AND IS_DIRECTORY ${root}/share/doc/signorini)
    file(RENAME ${root}/share/doc/signorini ${root}/share/doc/${package})
    file(REMOVE ${root}/share/doc/${package}/LICENSE)  # is the copyright
  endif()
  set(text "${copyright}")
  if(DEFINED copyright_${component})
    set(text "${copyright_${component}}")
  endif()
  file(WRITE ${root}/share/doc/${package}/copyright "${text}")
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  file(WRITE ${root}/share/doc/${package}/changelog.Debian "signorini (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n  * What changed is in the changelog of the project.\n\n -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}\n")
  compress(${root}/share/doc/${package}/changelog.Debian)
  file(GLOB pages ${root}/share/man/man1/*.1)
  foreach(page ${pages})
    compress(${page})
  endforeach()
  file(GLOB_RECURSE programs ${root}/bin/* ${root}/lib/*.so ${root}/lib/*.so.*)
  foreach(program ${programs})
    if(NOT IS_SYMLINK ${program})
      file(RPATH_REMOVE FILE ${program})
      if(program MATCHES "\\.so")
        file(CHMOD ${program} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
      endif()
    endif()
  endforeach()
endforeach()
