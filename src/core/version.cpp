// SPDX-License-Identifier: BSD-3-Clause
#include "perimode/core/version.hpp"

#include <cholmod.h>
#include <dmumps_c.h>
#include <exodusII.h>
#include <fftw3.h>
#include <fmt/core.h>
#include <openblas_config.h>
#include <spdlog/version.h>
#include <umfpack.h>

#include <Eigen/Core>
#include <array>
#include <nanoflann.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/build_info.hpp"

extern "C" char* openblas_get_config();

namespace perimode {
namespace {

std::string dotted(int major, int minor, int patch) { return fmt::format("{}.{}.{}", major, minor, patch); }

std::string cholmod_text() {
  std::array<int, 3> number{};
  cholmod_version(number.data());
  return dotted(number[0], number[1], number[2]);
}

// "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH NO_AFFINITY Haswell MAX_THREADS=64": the version and the
// kernels chosen for this processor.
std::string openblas_text() {
  std::istringstream words(openblas_get_config());
  std::string word;
  std::string number;
  std::string kernels;
  words >> word >> number;
  while (words >> word)
    if (word.rfind("MAX_THREADS", 0) == std::string::npos) kernels = word;
  return number + " (" + kernels + ")";
}

// "fftw-3.3.10-sse2-avx": the version and the instructions it was built for.
std::string fftw_text() {
  const std::string name = static_cast<const char*>(fftw_version);
  return name.starts_with("fftw-") ? name.substr(5) : name;
}

}  // namespace

std::string version() { return build_info::version; }

std::vector<Component> components() {
  std::vector<Component> all = {
      {"compiler", build_info::compiler},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"CHOLMOD", cholmod_text()},
      {"UMFPACK", dotted(UMFPACK_MAIN_VERSION, UMFPACK_SUB_VERSION, UMFPACK_SUBSUB_VERSION)},
      {"ARPACK", build_info::arpack},
      {"MUMPS", MUMPS_VERSION},
      {"LAPACKE", build_info::lapacke},
      {"OpenBLAS", openblas_text()},
      {"Exodus II", fmt::format("{:.2f}", EX_API_VERS)},
      {"FFTW", fftw_text()},
      {"yaml-cpp", build_info::yaml_cpp},
      {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"spdlog", dotted(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
      {"nlohmann-json",
       dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"nanoflann", dotted(NANOFLANN_VERSION >> 8, NANOFLANN_VERSION >> 4 & 0xf, NANOFLANN_VERSION & 0xf)},
  };
  if (*build_info::clp != '\0') all.push_back({"Clp", build_info::clp});
  return all;
}

}  // namespace perimode
