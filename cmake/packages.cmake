# What the Debian packages hold, which scripts/package makes: program and page as `ream`, Python's module as `python3-ream`,
# papers as `ream-doc`. The page (web/dist), man pages, completion and papers are made before; they lie in build/package.
set(REAM_PACKAGE_CONTACT "the authors of ream <ream@example.org>" CACHE STRING "Who keeps the packages, as Debian wants it")
set(made ${CMAKE_BINARY_DIR}/package)
install(TARGETS ream RUNTIME DESTINATION bin COMPONENT ream)
install(TARGETS ream-reader ream-renderer ream-plugin-trial RUNTIME DESTINATION lib/ream COMPONENT ream)
install(FILES ${CMAKE_SOURCE_DIR}/server/plugin/ream_plugin.h DESTINATION include/ream COMPONENT ream)
install(TARGETS ream-hdf5 LIBRARY DESTINATION lib/ream COMPONENT ream)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/web/dist/ DESTINATION share/ream/web COMPONENT ream)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/examples DESTINATION share/doc/ream COMPONENT ream)
install(DIRECTORY ${made}/man/ DESTINATION share/man/man1 COMPONENT ream OPTIONAL)
install(FILES ${made}/completion RENAME ream DESTINATION share/bash-completion/completions COMPONENT ream OPTIONAL)
install(FILES ${CMAKE_SOURCE_DIR}/packaging/copyright ${made}/changelog.gz ${made}/CHANGELOG.md.gz
        DESTINATION share/doc/ream COMPONENT ream OPTIONAL)
install(DIRECTORY ${made}/sbom/ DESTINATION share/doc/ream COMPONENT ream OPTIONAL)
install(FILES ${CMAKE_SOURCE_DIR}/packaging/ream.sysusers RENAME ream.conf DESTINATION lib/sysusers.d COMPONENT ream)
install(FILES ${CMAKE_SOURCE_DIR}/packaging/ream.service DESTINATION /lib/systemd/system COMPONENT ream)
install(FILES ${CMAKE_SOURCE_DIR}/packaging/ream.toml DESTINATION /etc/ream COMPONENT ream
        PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
install(DIRECTORY ${made}/doc/ DESTINATION share/doc/ream-doc COMPONENT doc OPTIONAL)
install(FILES ${CMAKE_SOURCE_DIR}/packaging/copyright ${made}/changelog.gz DESTINATION share/doc/ream-doc COMPONENT doc
        OPTIONAL)

if(TARGET ream_python)
  # Debian's Python looks here for what packages bring, whatever its version.
  set(python_folder lib/python3/dist-packages/ream)
  install(TARGETS ream_python LIBRARY DESTINATION ${python_folder} COMPONENT python)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/python/ream/ DESTINATION ${python_folder} COMPONENT python
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
  install(DIRECTORY ${CMAKE_BINARY_DIR}/python/generated/ream/wire DESTINATION ${python_folder} COMPONENT python
          FILES_MATCHING PATTERN "*.py" PATTERN "__pycache__" EXCLUDE)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/python/slicer/Ream DESTINATION share/ream/slicer COMPONENT python
          FILES_MATCHING PATTERN "*.py" PATTERN "*.ui" PATTERN "__pycache__" EXCLUDE)
  install(FILES ${CMAKE_SOURCE_DIR}/python/ream/client.py ${CMAKE_SOURCE_DIR}/python/ream/_operations.py
          DESTINATION share/ream/slicer/Ream/ReamLib COMPONENT python)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/python/installed)
  foreach(program ream-reader ream-renderer)
    file(CREATE_LINK ../../../ream/${program} ${CMAKE_BINARY_DIR}/python/installed/${program} SYMBOLIC)
    install(FILES ${CMAKE_BINARY_DIR}/python/installed/${program} DESTINATION ${python_folder} COMPONENT python)
  endforeach()
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/python/notebooks DESTINATION share/doc/python3-ream COMPONENT python
          FILES_MATCHING PATTERN "*.ipynb" PATTERN ".ipynb_checkpoints" EXCLUDE)
  install(FILES ${CMAKE_SOURCE_DIR}/packaging/copyright ${made}/changelog.gz DESTINATION share/doc/python3-ream
          COMPONENT python OPTIONAL)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR ream)
set(CPACK_PACKAGE_CONTACT ${REAM_PACKAGE_CONTACT})
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_SET_DESTDIR ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ream doc)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)

set(CPACK_DEBIAN_REAM_PACKAGE_NAME ream)
set(CPACK_DEBIAN_REAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_REAM_PACKAGE_DEPENDS "adduser, fonts-inter")
set(CPACK_DEBIAN_REAM_PACKAGE_RECOMMENDS pocl-opencl-icd)
set(CPACK_DEBIAN_REAM_PACKAGE_SUGGESTS "ream-doc, postgresql")
set(CPACK_DEBIAN_REAM_PACKAGE_CONTROL_EXTRA
    "${CMAKE_SOURCE_DIR}/packaging/postinst;${CMAKE_SOURCE_DIR}/packaging/prerm;${CMAKE_SOURCE_DIR}/packaging/postrm;${CMAKE_SOURCE_DIR}/packaging/conffiles")
set(CPACK_DEBIAN_REAM_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENT_REAM_DESCRIPTION "training simulator for glenoid reaming
Trains the machining of the glenoid in total shoulder replacement: bone from a
patient's CT is reamed in a browser or with a haptic device, and each session
is recorded, scored and reviewed. For research and training; not a medical
device.")
set(CPACK_DEBIAN_DOC_PACKAGE_NAME ream-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_COMPONENT_DOC_DESCRIPTION "training simulator for glenoid reaming - guides
Guides for trainees, instructors, administrators and researchers of ream, as
pages for a browser.")
if(TARGET ream_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_minor "${REAM_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-ream)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "ream (= ${PROJECT_VERSION}), python3-numpy (<< 1:2), python3 (>= 3.${REAM_PYTHON_MINOR}), python3 (<< 3.${next_minor})")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-flatbuffers, python3-h5py, python3-matplotlib, python3-websockets, jupyter-notebook")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      "${CMAKE_SOURCE_DIR}/packaging/python/postinst;${CMAKE_SOURCE_DIR}/packaging/python/prerm")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "training simulator for glenoid reaming - Python module
Steps reamings tick by tick from Python, with the bits of the program, and
gives recordings, bone and voxels as NumPy arrays.")
endif()
include(CPack)
