# What cpack runs first in a build for this machine's processor alone.
message(FATAL_ERROR "This build runs only on processors like this machine's. "
  "Make the package with './bootstrap package', or with cmake --preset portable.")
