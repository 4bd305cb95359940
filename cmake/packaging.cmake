# Man pages (target man-pages, needs help2man), bash completion, and the Debian package that cpack makes.

set(man_pages ${CMAKE_BINARY_DIR}/man)
add_custom_target(man-pages
  COMMAND ${PROJECT_SOURCE_DIR}/packaging/man-pages.sh ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${man_pages}
  DEPENDS mpfem pack-gen postproc
  COMMENT "Man pages from --help"
  VERBATIM)
install(DIRECTORY ${man_pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN "*.1")
foreach(program mpfem pack-gen postproc)
  install(FILES packaging/completion.bash RENAME ${program}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endforeach()

set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # tests are not part of the package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The mpfem authors <mpfem@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "make") # the studies' rules
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox") # their plots
if(NOT MPFEM_PORTABLE) # a package travels: one whose programs stop at the first unknown instruction is not made
  set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/refuse-native.cmake)
endif()
include(CPack)
