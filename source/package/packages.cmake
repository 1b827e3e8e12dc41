# SPDX-License-Identifier: LGPL-2.1-or-later
# `cpack -G DEB`, or ./run package: hpvi, libhpvi-dev, python3-hpvi where the module is built, and hpvi-doc. Texts that package_texts.py and ./run doc make are taken
# where they are.
set(CPACK_COMPONENTS_ALL program development manual)
if(TARGET hpvi_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
foreach(component ${CPACK_COMPONENTS_ALL})
  set(name_of_program hpvi)
  set(name_of_development libhpvi-dev)
  set(name_of_manual hpvi-doc)
  set(name_of_python python3-hpvi)
  set(name ${name_of_${component}})
  install(FILES source/package/copyright ${PROJECT_BINARY_DIR}/package/changelog.gz
    ${PROJECT_BINARY_DIR}/package/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DOCDIR}/../${name}
    COMPONENT ${component} OPTIONAL)
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${name})
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/package/hpvi.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program OPTIONAL)
install(DIRECTORY ${PROJECT_BINARY_DIR}/doc/html/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/../hpvi-doc/html COMPONENT manual OPTIONAL)
install(FILES ${PROJECT_BINARY_DIR}/doc/hpvi.pdf DESTINATION ${CMAKE_INSTALL_DOCDIR}/../hpvi-doc COMPONENT manual OPTIONAL)
# prm/README.md shows pictures of the sources; the manual has that page, too.
install(DIRECTORY prm DESTINATION ${CMAKE_INSTALL_DOCDIR}/../hpvi-doc COMPONENT manual PATTERN README.md EXCLUDE)

set(CPACK_PACKAGE_CONTACT "hpvi developers <hpvi@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS python3-hpvi)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "hp finite elements for elastic contact with friction
Solves elastic bodies in contact, with Tresca's and Coulomb's friction,
by adaptive hp finite elements, driven by a parameter file; with Tresca's
in the plane the error is guaranteed.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "hpvi (= ${PROJECT_VERSION}-1), libdeal.ii-dev, libsuitesparse-dev, libmuparser-dev, zlib1g-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "library of hpvi, elastic contact with friction
Headers, static library and CMake package of hpvi, for programs that
solve scenes and read results.")
if(TARGET hpvi_python)
  math(EXPR NEXT_PYTHON "${Python3_VERSION_MINOR} + 1")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "hpvi (= ${PROJECT_VERSION}-1), python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), python3 (<< ${Python3_VERSION_MAJOR}.${NEXT_PYTHON}), python3-numpy, python3-matplotlib, python3-jinja2")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "weasyprint, python3-vtk9, xvfb")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python module of hpvi, elastic contact with friction
Solves scenes of hpvi from Python; results are arrays of NumPy. Draws
pictures and makes reports of runs, for the program hpvi, too.")
set(CPACK_DEBIAN_MANUAL_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_MANUAL_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_MANUAL_PACKAGE_DEPENDS libjs-mathjax)
set(CPACK_COMPONENT_MANUAL_DESCRIPTION "manual and scenes of hpvi, elastic contact with friction
The manual of hpvi to read offline, as HTML and PDF, and its scenes.")
include(CPack)
