# Every package that the toolkit uses, found once. Debian's names are listed in ./bootstrap.
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
if(MPFEM_MPI)
  find_package(MPI REQUIRED COMPONENTS CXX)
endif()
# Debian's plain hdf5 becomes the one with MPI as soon as something (VTK) brings that in.
pkg_search_module(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial hdf5)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
# Only its headers: common/toml.cpp compiles it, with a fault corrected (common/toml.hpp). An assertion of toml++ that
# fails for "[[/" stands before the code that refuses the same; the library as Debian builds it has no assertions.
set_target_properties(PkgConfig::TOMLPLUSPLUS PROPERTIES INTERFACE_LINK_LIBRARIES ""
  INTERFACE_COMPILE_OPTIONS "-DTOML_HEADER_ONLY=0;-DTOML_ASSERT(expression)=static_cast<void>(expression)")

find_path(GMSH_INCLUDE_DIR gmsh.h REQUIRED)
find_library(GMSH_LIBRARY gmsh REQUIRED)
add_library(gmsh_api INTERFACE IMPORTED)
target_include_directories(gmsh_api INTERFACE ${GMSH_INCLUDE_DIR})
target_link_libraries(gmsh_api INTERFACE ${GMSH_LIBRARY})

# Pictures in three dimensions (postproc picture) are built where VTK is there; ./bootstrap pictures installs it.
find_package(VTK 9 QUIET COMPONENTS CommonCore CommonDataModel FiltersCore FiltersSources IOImage RenderingCore
             RenderingFreeType RenderingOpenGL2 OPTIONAL_COMPONENTS IOXML)
find_package(OpenGL QUIET COMPONENTS EGL)
find_package(GLEW QUIET)
set(MPFEM_PICTURES OFF)
if(VTK_FOUND AND TARGET OpenGL::EGL AND TARGET GLEW::GLEW)
  set(MPFEM_PICTURES ON)
endif()
