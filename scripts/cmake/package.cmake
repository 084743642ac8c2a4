# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# The files that `cmake --install` installs for find_package(feltgate): component `core` is headers
# only, `sim` adds the libraries, the plants and the scenes. docs/library.md
include_guard(GLOBAL)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/feltgate")
get_property(sim_targets GLOBAL PROPERTY FELTGATE_SIM_TARGETS)

# feltgate_install(<component> <targets>): the targets, and the file that imports them.
function(feltgate_install component targets)
  install(TARGETS ${targets} EXPORT feltgate-${component} COMPONENT feltgate_${component}
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT feltgate_${component}
    INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  install(EXPORT feltgate-${component} NAMESPACE feltgate:: DESTINATION "${package_dir}"
    COMPONENT feltgate_${component})
endfunction()

feltgate_install(core feltgate_model)
install(DIRECTORY "${FELTGATE_ROOT}/model/include/feltgate"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT feltgate_core FILES_MATCHING PATTERN "*.hpp")
if(FELTGATE_SIM)
  feltgate_install(sim "${sim_targets}")
  # Not installed: headers that a user has no way to use without the sources or the Verilated core.
  feltgate_install(systemc feltgate_systemc)
  foreach(room IN LISTS FELTGATE_ROOMS)
    set(component sim)
    if(room STREQUAL systemc)
      set(component systemc)
    endif()
    install(DIRECTORY "${FELTGATE_ROOT}/model/sim/${room}/"
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/feltgate/${room}" COMPONENT feltgate_${component}
      FILES_MATCHING PATTERN "*.hpp"
      PATTERN "ensemble.hpp" EXCLUDE
      PATTERN "scenario_bounds.hpp" EXCLUDE
      PATTERN "make_backends.hpp" EXCLUDE PATTERN "lock_step_backend.hpp" EXCLUDE
      PATTERN "lock_step_core.hpp" EXCLUDE PATTERN "make_axes_cores.hpp" EXCLUDE
      PATTERN "twin_axes.hpp" EXCLUDE
      PATTERN "plant_table.hpp" EXCLUDE PATTERN "rtl_*.hpp" EXCLUDE)
  endforeach()
  install(DIRECTORY "${FELTGATE_ROOT}/vectors/plants" "${FELTGATE_ROOT}/vectors/devices"
    "${FELTGATE_ROOT}/vectors/scenes"
    "${FELTGATE_ROOT}/vectors/traces"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/feltgate" COMPONENT feltgate_sim)
endif()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/feltgateConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/package/feltgateConfig.cmake" INSTALL_DESTINATION "${package_dir}"
  PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/feltgateConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/package/feltgateConfig.cmake"
  "${PROJECT_BINARY_DIR}/package/feltgateConfigVersion.cmake"
  DESTINATION "${package_dir}" COMPONENT feltgate_core)
