# What Perimode stands on. Debian 12 holds every one of these (scripts/install_deps.sh). Packages
# without a CMake package of their own are found by the Find modules beside this file.
find_package(Eigen3 3.4 REQUIRED CONFIG)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(CHOLMOD REQUIRED)
find_package(UMFPACK REQUIRED)
find_package(ARPACK REQUIRED)
find_package(MUMPS REQUIRED)
find_package(OpenBLAS REQUIRED)
find_package(LAPACKE REQUIRED)
find_package(Exodus REQUIRED)
find_package(HDF5Serial REQUIRED)
if(PERIMODE_WITH_CLP)
  find_package(Clp REQUIRED)
endif()
find_package(FFTW3 3.3 REQUIRED)
find_package(muparser REQUIRED CONFIG)
find_package(yaml-cpp REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(spdlog REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_package(nanoflann REQUIRED CONFIG)
find_package(CLI11 REQUIRED CONFIG)

# Linked into the library, so whoever links the static library needs them again (perimode-config.cmake.in).
set(perimode_linked
  OpenMP::OpenMP_CXX CHOLMOD::CHOLMOD UMFPACK::UMFPACK ARPACK::ARPACK MUMPS::dmumps_seq Exodus::Exodus
  LAPACKE::LAPACKE OpenBLAS::OpenBLAS HDF5Serial::HDF5 FFTW3::FFTW3 muparser::muparser yaml-cpp fmt::fmt
  spdlog::spdlog)
if(PERIMODE_WITH_CLP)
  list(APPEND perimode_linked Clp::Clp)
endif()
# Headers alone: nobody downstream meets them.
set(perimode_header_only nlohmann_json::nlohmann_json nanoflann::nanoflann)

# For the program, and for tests and benchmarks, which use these libraries directly. Never installed.
add_library(perimode_dependencies INTERFACE)
target_link_libraries(perimode_dependencies INTERFACE
  Eigen3::Eigen ${perimode_linked} ${perimode_header_only} CLI11::CLI11)

include(FeatureSummary)
set_package_properties(Eigen3 PROPERTIES DESCRIPTION "dense and sparse matrices (public headers)")
set_package_properties(OpenMP PROPERTIES DESCRIPTION "threads")
set_package_properties(CHOLMOD PROPERTIES DESCRIPTION "supernodal Cholesky, METIS order")
set_package_properties(UMFPACK PROPERTIES DESCRIPTION "sparse LU")
set_package_properties(ARPACK PROPERTIES DESCRIPTION "Lanczos and Arnoldi")
set_package_properties(MUMPS PROPERTIES DESCRIPTION "sequential indefinite factorisation, inertia")
set_package_properties(OpenBLAS PROPERTIES DESCRIPTION "dense kernels")
set_package_properties(LAPACKE PROPERTIES DESCRIPTION "dense eigenproblems")
set_package_properties(Exodus PROPERTIES DESCRIPTION "result files")
set_package_properties(HDF5Serial PROPERTIES DESCRIPTION "checkpoints")
if(PERIMODE_WITH_CLP)
  set_package_properties(Clp PROPERTIES DESCRIPTION "linear programmes")
endif()
set_package_properties(FFTW3 PROPERTIES DESCRIPTION "Fourier transforms of runs")
set_package_properties(muparser PROPERTIES DESCRIPTION "expressions in case files")
set_package_properties(yaml-cpp PROPERTIES DESCRIPTION "case files")
set_package_properties(fmt PROPERTIES DESCRIPTION "text")
set_package_properties(spdlog PROPERTIES DESCRIPTION "log lines of the program")
set_package_properties(nlohmann_json PROPERTIES DESCRIPTION "summaries")
set_package_properties(nanoflann PROPERTIES DESCRIPTION "neighbour search in clouds")
set_package_properties(CLI11 PROPERTIES DESCRIPTION "command line of the program")
