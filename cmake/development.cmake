# SPDX-License-Identifier: GPL-3.0-or-later
# The component `development`: the headers, and what find_package(ccdm) reads. There is nothing compiled in it, so it
# goes into share, whatever the architecture.
include(CMakePackageConfigHelpers)

set(ccdm_config_dir share/ccdm/cmake)
install(TARGETS ccdm_vcg_ext EXPORT ccdm FILE_SET HEADERS DESTINATION include COMPONENT development)
install(EXPORT ccdm NAMESPACE ccdm:: FILE ccdm-targets.cmake DESTINATION ${ccdm_config_dir} COMPONENT development)
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/ccdm-config.cmake.in" "${CMAKE_BINARY_DIR}/ccdm-config.cmake"
  INSTALL_DESTINATION ${ccdm_config_dir})
write_basic_package_version_file("${CMAKE_BINARY_DIR}/ccdm-config-version.cmake"
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES "${CMAKE_BINARY_DIR}/ccdm-config.cmake" "${CMAKE_BINARY_DIR}/ccdm-config-version.cmake"
  DESTINATION ${ccdm_config_dir} COMPONENT development)
