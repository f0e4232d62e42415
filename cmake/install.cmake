# The targets signorini::core (the library), signorini::sdk (what a plugin is built with), signorini::amg and signorini::c
# (the solver for matrices of other codes, in C++ and in C), signorini::driver (scenes), signorini::conformance (what is
# asked of plugins), and the installed tree, whose layout is that of the build tree: bin/, lib/, lib/signorini/plugins/,
# share/signorini/templates/.
include(CMakePackageConfigHelpers)

# Where Eigen aligns would depend on the processor's flags of each build; pinned, it agrees between all of them.
target_compile_definitions(signorini_settings INTERFACE EIGEN_MAX_ALIGN_BYTES=32 EIGEN_MALLOC_ALREADY_ALIGNED=0)

add_library(signorini_sdk INTERFACE)
target_link_libraries(signorini_sdk INTERFACE signorini_core)
add_library(signorini::core ALIAS signorini_core)
add_library(signorini::sdk ALIAS signorini_sdk)

target_include_directories(signorini_settings INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/signorini>)
set_target_properties(signorini_settings PROPERTIES EXPORT_NAME settings)
set_target_properties(signorini_core PROPERTIES EXPORT_NAME core)
set_target_properties(signorini_sdk PROPERTIES EXPORT_NAME sdk)
foreach(part amg c conformance driver estimators methods smoothers transfer)
  add_library(signorini::${part} ALIAS signorini_${part})
  set_target_properties(signorini_${part} PROPERTIES EXPORT_NAME ${part})
endforeach()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/signorini)
install(TARGETS signorini_settings signorini_core signorini_sdk signorini_amg signorini_c signorini_conformance
  signorini_driver signorini_estimators signorini_methods signorini_smoothers signorini_transfer
  EXPORT signorini COMPONENT sdk)
install(EXPORT signorini NAMESPACE signorini:: FILE signoriniTargets.cmake DESTINATION ${package} COMPONENT sdk)
configure_package_config_file(cmake/signoriniConfig.cmake.in ${PROJECT_BINARY_DIR}/signoriniConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/signoriniConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/signoriniConfig.cmake ${PROJECT_BINARY_DIR}/signoriniConfigVersion.cmake
  cmake/signorini_plugin.cmake cmake/signorini_plugin.map DESTINATION ${package} COMPONENT sdk)
install(DIRECTORY core driver estimators methods ${PROJECT_BINARY_DIR}/include/core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/signorini
  COMPONENT sdk FILES_MATCHING PATTERN "*.hpp" PATTERN cgal EXCLUDE PATTERN cairo EXCLUDE)
install(FILES conformance/check.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/signorini/conformance COMPONENT sdk)
install(FILES amg/black_box.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/signorini/amg COMPONENT sdk)
# Once more where it was before it had a folder of its own.
foreach(folder c amg)
  install(FILES c/signorini.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/signorini/${folder} COMPONENT sdk)
endforeach()

configure_file(cmake/signorini_c.pc.in ${PROJECT_BINARY_DIR}/signorini_c.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/signorini_c.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT sdk)

# The Python package, for pip: share/signorini/python.
file(WRITE ${PROJECT_BINARY_DIR}/python/VERSION "${PROJECT_VERSION}\n")
install(DIRECTORY python DESTINATION ${CMAKE_INSTALL_DATADIR}/signorini COMPONENT sdk
  FILES_MATCHING PATTERN "*.py" PATTERN "*.toml" PATTERN py.typed PATTERN __pycache__ EXCLUDE PATTERN .mypy_cache EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/python/VERSION LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/signorini/python COMPONENT sdk)

get_property(obstacles GLOBAL PROPERTY SIGNORINI_OBSTACLES)
install(TARGETS ${obstacles} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/signorini/plugins COMPONENT sdk)

install(TARGETS signorini_pictures signorini_certificate LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program)
if(SIGNORINI_GPL)
  install(TARGETS signorini_plane signorini_geometry signorini_cholmod LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program)
endif()
install(FILES LICENSE docs/abi.md docs/plugins.md docs/plugin_energies.md docs/plugin_check.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT sdk)
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
