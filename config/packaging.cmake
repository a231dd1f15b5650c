# cpack: a Debian package of what `cmake --install` puts below /usr (preset "package").
include(GNUInstallDirs)
set(debian ${PROJECT_SOURCE_DIR}/config/debian)
# Without name and time inside, so that it is the same bytes each time. The licence stands in copyright.
set(changelog ${PROJECT_BINARY_DIR}/changelog.gz)
add_custom_command(OUTPUT ${changelog} COMMAND sh -c "gzip -9nc ${debian}/changelog >${changelog}"
  DEPENDS ${debian}/changelog VERBATIM)
add_custom_target(gyrocal_changelog ALL DEPENDS ${changelog})
# Whatever an installation takes from the build: what make demo and make install wait for.
add_custom_target(gyrocal_release
  DEPENDS gyrocal gyrocald gyrocal_manual gyrocal_changelog)
install(FILES README.md ${debian}/copyright ${changelog} DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gyrocal)
set(CPACK_PACKAGE_VENDOR gyrocal)
set(CPACK_PACKAGE_CONTACT "the gyrocal developers <gyrocal@example.org>")
set(CPACK_PACKAGE_DESCRIPTION "Drives a climate chamber, logs gyro boards at each setpoint into SQLite, fits\ndrift models with honest errors and writes them as firmware files; holds each\nsession against a simulation and names the physical effect that it lacks.")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "systemd")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, sqlite3")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
    ${debian}/conffiles ${debian}/postinst ${debian}/prerm ${debian}/postrm)
include(CPack)
