# What the Debian packages hold, which scripts/package makes: program and page as `ream`, papers as `ream-doc`. The page (web/dist), man pages, completion and papers are made before; they lie in build/package.
set(REAM_PACKAGE_CONTACT "the authors of ream <ream@example.org>" CACHE STRING "Who keeps the packages, as Debian wants it")
set(made ${CMAKE_BINARY_DIR}/package)
install(TARGETS ream RUNTIME DESTINATION bin COMPONENT ream)
install(TARGETS ream-reader RUNTIME DESTINATION lib/ream COMPONENT ream)
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
include(CPack)
