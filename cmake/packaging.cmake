# Man pages (target man-pages, needs help2man), completion of command lines, and the Debian package that cpack makes.

set(man_pages ${CMAKE_BINARY_DIR}/man)
add_custom_target(man-pages
  COMMAND ${PROJECT_SOURCE_DIR}/packaging/man-pages.sh ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${man_pages}
  DEPENDS mpfem pack-gen postproc
  COMMENT "Man pages from --help"
  VERBATIM)
install(DIRECTORY ${man_pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN "*.1")

# Completions for all shells read the words from --help with the same awk program.
set(completions ${CMAKE_BINARY_DIR}/completions)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS packaging/help-words.awk)
file(READ packaging/help-words.awk help_words)
foreach(shell bash zsh fish)
  configure_file(packaging/completion.${shell}.in ${completions}/completion.${shell} @ONLY)
endforeach()
foreach(program mpfem pack-gen postproc)
  install(FILES ${completions}/completion.bash RENAME ${program}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${completions}/completion.fish RENAME ${program}.fish
          DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endforeach()
foreach(folder site-functions vendor-completions) # the latter for Debian's zsh
  install(FILES ${completions}/completion.zsh RENAME _mpfem DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder})
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
