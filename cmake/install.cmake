# The installed tree, whose layout is that of the build tree: bin/, lib/, lib/signorini/plugins/,
# share/signorini/templates/; and the package that find_package(signorini) finds, in components:
#   sdk           signorini::sdk, what a plugin is built with, and signorini_plugin()
#   c             signorini::c, the solver for matrices of other codes, in C
#   matrix        signorini::core and signorini::amg, the same in C++
#   driver        signorini::driver, scenes
#   conformance   signorini::conformance, what is asked of plugins
# What is installed is in components of its own, each a Debian package (package.cmake).
include(CMakePackageConfigHelpers)

# Where Eigen aligns would depend on the processor's flags of each build; pinned, it agrees between all of them.
target_compile_definitions(signorini_settings INTERFACE EIGEN_MAX_ALIGN_BYTES=32 EIGEN_MALLOC_ALREADY_ALIGNED=0)
target_include_directories(signorini_settings INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/signorini)
# signorini_package_component(NAME INSTALLED parts...): the targets signorini::PART; shared ones are installed by the
# component INSTALLED, all else by the component dev.
function(signorini_package_component name installed)
  foreach(part ${ARGN})
    if(NOT part STREQUAL "settings")
      add_library(signorini::${part} ALIAS signorini_${part})
    endif()
    set_target_properties(signorini_${part} PROPERTIES EXPORT_NAME ${part})
    install(TARGETS signorini_${part} EXPORT signorini_${name}
      LIBRARY COMPONENT ${installed} NAMELINK_COMPONENT dev ARCHIVE COMPONENT dev)
  endforeach()
  install(EXPORT signorini_${name} NAMESPACE signorini:: FILE signorini-${name}.cmake DESTINATION ${package} COMPONENT dev)
endfunction()

signorini_package_component(sdk sdk settings sdk)
signorini_package_component(c c c)
signorini_package_component(matrix libraries core amg methods smoothers transfer)
signorini_package_component(driver libraries estimators driver)
signorini_package_component(conformance libraries conformance)

configure_package_config_file(cmake/signoriniConfig.cmake.in ${PROJECT_BINARY_DIR}/signoriniConfig.cmake
  INSTALL_DESTINATION ${package} PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
configure_file(cmake/signoriniConfigVersion.cmake.in ${PROJECT_BINARY_DIR}/signoriniConfigVersion.cmake @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/signoriniConfig.cmake ${PROJECT_BINARY_DIR}/signoriniConfigVersion.cmake
  cmake/signorini_plugin.cmake cmake/signorini_plugin.map DESTINATION ${package} COMPONENT dev)

# Headers of the build tree as of the installed one, for what is built in both: <signorini/sdk/...>.
file(GLOB folders RELATIVE ${PROJECT_SOURCE_DIR} core/*)
foreach(folder ${folders} amg c driver conformance)
  string(REGEX REPLACE "^core/" "" name ${folder})
  string(REGEX REPLACE "^amg$" "matrix" name ${name})
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${folder})
    file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include/signorini)
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${PROJECT_BINARY_DIR}/include/signorini/${name} SYMBOLIC)
  endif()
endforeach()
# Those of the components, and what they include; the loader of plugins is for tests of a plugin.
string(JOIN " " public core/sdk/*.hpp c/signorini.h amg/black_box.hpp amg/obstacle_by_name.hpp amg/tabulated_obstacle.hpp
  amg/coarsening/*.hpp driver/driver.hpp driver/body_run.hpp core/component/plugin_loader.hpp core/component/settings.hpp conformance/check.hpp)
install(CODE "include(${PROJECT_SOURCE_DIR}/cmake/public_headers.cmake)
  public_headers(\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR} ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/include
    ${public})
  get_property(headers GLOBAL PROPERTY PUBLIC_HEADERS)
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES \${headers})" COMPONENT dev)

file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
foreach(part sdk c matrix driver)
  configure_file(cmake/signorini_${part}.pc.in ${PROJECT_BINARY_DIR}/signorini_${part}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/signorini_${part}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endforeach()

# The Python package, for pip: share/signorini/python.
file(WRITE ${PROJECT_BINARY_DIR}/python/VERSION "${PROJECT_VERSION}\n")
install(DIRECTORY python DESTINATION ${CMAKE_INSTALL_DATADIR}/signorini COMPONENT dev
  FILES_MATCHING PATTERN "*.py" PATTERN "*.toml" PATTERN py.typed PATTERN __pycache__ EXCLUDE PATTERN .mypy_cache EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/python/VERSION LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/signorini/python COMPONENT dev)

get_property(obstacles GLOBAL PROPERTY SIGNORINI_OBSTACLES)
install(TARGETS ${obstacles} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/signorini/plugins COMPONENT plugins)

# Libraries that the core library loads from its own folder, where whatever lies has a soname.
function(signorini_companions component)
  foreach(name ${ARGN})
    target_link_options(signorini_${name} PRIVATE LINKER:-soname,libsignorini_${name}.so)
    install(TARGETS signorini_${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component})
  endforeach()
endfunction()
signorini_companions(libraries pictures certificate)
if(SIGNORINI_GPL)
  signorini_companions(gpl plane geometry cholmod)
endif()
install(FILES LICENSE docs/abi.md docs/plugins.md docs/plugin_energies.md docs/plugin_check.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT dev)
if(TARGET signorini)
  file(RELATIVE_PATH libraries ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(signorini PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
  install(TARGETS signorini RUNTIME COMPONENT program)
  install(FILES apps/signorini/signorini.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES apps/signorini/completion.sh DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    RENAME signorini COMPONENT program)
  install(FILES apps/signorini/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
    RENAME _signorini COMPONENT program)
  install(FILES apps/signorini/completion.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
    RENAME signorini.fish COMPONENT program)
  install(DIRECTORY apps/templates DESTINATION ${CMAKE_INSTALL_DATADIR}/signorini COMPONENT program)
  install(FILES docs/report.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/signorini COMPONENT program)
endif()
