# SPDX-License-Identifier: GPL-3.0-or-later
# `cpack -G DEB` makes a Debian package of each of the components `plugin` and `cli`.
set(CPACK_PACKAGE_NAME ccdm)
set(CPACK_PACKAGE_CONTACT "CCDM for MeshLab <ccdm@example.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "isotropic remeshing by constrained centroidal Delaunay meshes")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_COMPONENTS_ALL cli)
if(TARGET filter_ccdm_2020.09)
  list(APPEND CPACK_COMPONENTS_ALL plugin)
endif()
set(CPACK_OUTPUT_FILE_PREFIX "${CMAKE_BINARY_DIR}/packages")
set(CPACK_STRIP_FILES ON)
# Whatever the umask is.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr) # Debian's MeshLab looks nowhere else

# The plugin uses the inside of one version of MeshLab. What it links to is an empty library that only bears the name
# of MeshLab's, so the usual search for dependencies would find nothing.
set(CPACK_DEBIAN_PLUGIN_PACKAGE_NAME meshlab-filter-ccdm)
set(CPACK_DEBIAN_PLUGIN_PACKAGE_DEPENDS
    "meshlab (>= 2020.09), meshlab (<< 2020.10~), libc6 (>= 2.34), libgcc-s1, libstdc++6 (>= 12)")
set(CPACK_COMPONENT_PLUGIN_DESCRIPTION "Adds the filter 'Remeshing: Isotropic CCDM' to MeshLab and meshlabserver: well-shaped
triangles, exactly the wanted number of vertices, creases and boundaries kept.")

set(CPACK_DEBIAN_CLI_PACKAGE_NAME ccdm-remesh)
set(CPACK_DEBIAN_CLI_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_CLI_DESCRIPTION "A command line that turns a triangle mesh (PLY, OFF, OBJ, STL) into one of well-shaped
triangles with the wanted number of vertices, and reports what was achieved.")

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  install(FILES "${PROJECT_SOURCE_DIR}/cmake/copyright" COMPONENT ${component}
          DESTINATION share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
endforeach()
include(CPack)
