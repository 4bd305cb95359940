# Man pages, completion of command lines, and the Debian package that cpack makes.

# Man pages are part of the whole build where help2man is found. They need all programs, so a build of single programs,
# as ./bootstrap does for studies, makes none.
set(man_pages ${CMAKE_BINARY_DIR}/man)
find_program(HELP2MAN help2man)
mark_as_advanced(HELP2MAN)
set(in_whole_build)
if(HELP2MAN)
  set(in_whole_build ALL)
endif()
add_custom_command(OUTPUT ${man_pages}/made
  COMMAND ${PROJECT_SOURCE_DIR}/packaging/man-pages.sh ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${man_pages}
  COMMAND ${CMAKE_COMMAND} -E touch ${man_pages}/made
  DEPENDS mpfem pack-gen postproc ${PROJECT_SOURCE_DIR}/packaging/man-pages.sh
    ${PROJECT_SOURCE_DIR}/packaging/man-text.awk $<$<TARGET_EXISTS:postproc-picture>:postproc-picture>
  COMMENT "Man pages from --help"
  VERBATIM)
add_custom_target(man-pages ${in_whole_build} DEPENDS ${man_pages}/made)
install(DIRECTORY ${man_pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN "*.1")
install(CODE "
  if(NOT EXISTS \"${man_pages}/made\")
    message(STATUS \"Man pages are left out: they need help2man; cmake --build ${CMAKE_BINARY_DIR} --target man-pages \"
      \"makes them\")
  endif()")

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
