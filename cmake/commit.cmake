# cmake -DSOURCE=DIR -DHEADER=FILE -P commit.cmake: writes what the sources' commit is, so that results name the build
# they come from. Empty where the sources stand in no git repository. The file changes only when the commit does:
# nothing is rebuilt otherwise.
set(commit "")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --short=10 HEAD
    OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  execute_process(COMMAND ${GIT} -C ${SOURCE} diff --quiet HEAD -- . ":!docs" ":!studies"
    RESULT_VARIABLE changed ERROR_QUIET)
  if(commit AND changed EQUAL 1)
    string(APPEND commit " and changes")
  endif()
endif()
set(text "#define MPFEM_COMMIT \"${commit}\"\n")
if(EXISTS ${HEADER})
  file(READ ${HEADER} before)
endif()
if(NOT before STREQUAL text)
  file(WRITE ${HEADER} ${text})
endif()
