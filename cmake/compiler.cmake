# Flags shared by all targets, through mpfem::options.
add_library(mpfem_options INTERFACE)
add_library(mpfem::options ALIAS mpfem_options)

target_compile_options(mpfem_options INTERFACE
  # Packs wider than the target's registers are passed between inlined functions only: no ABI to keep.
  -Wno-psabi
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor -Wold-style-cast)
# gcc 12 takes the deliberately undefined values in its own AVX-512 header for mistakes where it inlines them (gcc bug
# 105593); any edit can bring that about.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(mpfem_options INTERFACE -Wno-maybe-uninitialized -Wno-uninitialized)
endif()
if(MPFEM_WARNINGS_AS_ERRORS)
  target_compile_options(mpfem_options INTERFACE -Werror)
endif()

# -ffp-contract=fast lets the compiler fuse multiply and add; -fno-math-errno and -fno-trapping-math cost no accuracy.
# Nothing that reorders sums or assumes finite values (-ffast-math) is used: results must not depend on chance.
target_compile_options(mpfem_options INTERFACE -ffp-contract=fast -fno-math-errno -fno-trapping-math)
if(MPFEM_PORTABLE)
  # A target's property X86_64_LEVEL (v3, v4) requires more than x86-64-v2, which every machine since about 2009 has.
  set(level $<TARGET_PROPERTY:X86_64_LEVEL>)
  target_compile_options(mpfem_options INTERFACE -march=x86-64-$<IF:$<BOOL:${level}>,${level},v2>)
else()
  target_compile_options(mpfem_options INTERFACE -march=${MPFEM_MARCH})
endif()
if(MPFEM_SCALAR)
  target_compile_options(mpfem_options INTERFACE -DMPFEM_SCALAR -fno-tree-vectorize)
endif()
if(MPFEM_SANITIZE)
  # -O2: the vector types cost a factor of fifty where nothing is inlined.
  target_compile_options(mpfem_options INTERFACE -O2 -fsanitize=${MPFEM_SANITIZE}
                                                 -fno-omit-frame-pointer -fno-sanitize-recover=all
                                                 -DMPFEM_FLATTEN=)
  target_link_options(mpfem_options INTERFACE -fsanitize=${MPFEM_SANITIZE})
endif()
if(MPFEM_FUZZ)
  target_compile_options(mpfem_options INTERFACE
    -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tests/fuzz/ignored.txt)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g")
