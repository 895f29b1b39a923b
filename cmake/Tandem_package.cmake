# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# One package for Debian and Ubuntu of the program and the library, which `cpack -G DEB` makes in the build folder. It has
# what has been built there, without the Python module.

set(CPACK_PACKAGE_NAME tandem)
set(CPACK_PACKAGE_VENDOR "The Tandem authors")
set(CPACK_PACKAGE_CONTACT "The Tandem authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
file(READ "${PROJECT_SOURCE_DIR}/package_info/Shape_regularization_tandem/long_description.txt" CPACK_PACKAGE_DESCRIPTION)
string(STRIP "${CPACK_PACKAGE_DESCRIPTION}" CPACK_PACKAGE_DESCRIPTION)
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};${PROJECT_NAME};program;/"
                                 "${PROJECT_BINARY_DIR};${PROJECT_NAME};Unspecified;/")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# To compile programs with the library; detect_planes does without.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libcgal-dev (>= 5.5), libtbb-dev")

install(FILES "${PROJECT_SOURCE_DIR}/package_info/debian/copyright" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/tandem"
        COMPONENT program)

include(CPack)
