// SPDX-License-Identifier: BSD-3-Clause
// The only place that sees SLEPc and PETSc; a module of its own, see docs/adr/0010-slepc.md.
#include "slepc_module.hpp"

#include <slepceps.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <limits>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace {

using perimode::slepc_module::Matrix;
using perimode::slepc_module::TakePair;
using perimode::slepc_module::Vectors;

struct Failure {
  PetscErrorCode code;
};

void require(PetscErrorCode code) {
  if (code != 0) throw Failure{code};
}

/// A program may hold the C++ streams itself (copy relocation). The module and its libraries then see those
/// of libstdc++, which nobody made: all bytes zero. One of the libraries flushes std::cout at exit. It gets a
/// stream that writes nowhere.
void make_unmade_streams() {
  for (std::ostream* stream : {&std::cout, &std::cerr, &std::clog}) {
    const void* table = nullptr;
    std::memcpy(&table, static_cast<const void*>(stream), sizeof table);
    if (table == nullptr) new (stream) std::ostream(nullptr);
  }
}

/// What PETSc said when the last error arose.
std::string& last_words() {
  static std::string text;
  return text;
}

PetscErrorCode remember(MPI_Comm /*communicator*/, int /*line*/, const char* function, const char* /*file*/,
                        PetscErrorCode code, PetscErrorType type, const char* text, void* /*context*/) {
  if (type == PETSC_ERROR_INITIAL)
    last_words() = std::string(function) + ": " + (text != nullptr ? text : "");
  return code;
}

/// Starts MPI, PETSc and SLEPc at the first call, silently, without signal handlers, and ends them with the
/// process
/// - unless the process had started them itself.
void start() {
  PetscBool running = PETSC_FALSE;
  require(SlepcInitialized(&running));
  if (running == PETSC_TRUE) return;
  // One process: no network, no launcher to look for.
  constexpr int keep = 0;
  setenv("OMPI_MCA_btl", "self", keep);
  setenv("OMPI_MCA_plm", "isolated", keep);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", keep);
  // MUMPS: 100 percent of room for delayed pivots; null pivots counted, as the inertia asks for; the root
  // front by MUMPS itself.
  for (const auto& [name, value] :
       {std::pair{"-no_signal_handler", "true"}, std::pair{"-skip_petscrc", "true"},
        std::pair{"-mat_mumps_icntl_14", "100"}, std::pair{"-mat_mumps_icntl_24", "1"},
        std::pair{"-mat_mumps_icntl_13", "1"}})
    require(PetscOptionsSetValue(nullptr, name, value));
  require(SlepcInitializeNoArguments());
  require(PetscPushErrorHandler(remember, nullptr));
  std::atexit([] {
    (void)PetscPopErrorHandler();
    (void)SlepcFinalize();
  });
}

/// Runs `work` and says what went wrong.
template <typename Work>
const char* guarded(Work work) {
  static std::string message;
  try {
    start();
    work();
    return nullptr;
  } catch (const Failure& failure) {
    message = "PETSc error " + std::to_string(failure.code) + " in " + last_words();
  } catch (const std::exception& error) {
    message = error.what();
  }
  return message.c_str();
}

/// A matrix of PETSc over the arrays of the caller. PETSc's indices have 32 bits.
class PetscMatrix {
 public:
  explicit PetscMatrix(const Matrix& a) : start_(a.row_start, a.row_start + a.rows + 1) {
    if (a.row_start[a.rows] > std::numeric_limits<PetscInt>::max()) throw Failure{PETSC_ERR_INT_OVERFLOW};
    require(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, a.rows, a.rows, start_.data(),
                                      const_cast<PetscInt*>(a.column), const_cast<PetscScalar*>(a.value),
                                      &mat_));
    require(MatSetOption(mat_, MAT_SYMMETRIC, PETSC_TRUE));
  }
  ~PetscMatrix() { (void)MatDestroy(&mat_); }
  PetscMatrix(const PetscMatrix&) = delete;
  PetscMatrix& operator=(const PetscMatrix&) = delete;
  [[nodiscard]] Mat get() const { return mat_; }

 private:
  std::vector<PetscInt> start_;
  Mat mat_ = nullptr;
};

/// Krylov-Schur on (A - target I)^-1 by MUMPS's LDL^T.
class Solver {
 public:
  Solver(const PetscMatrix& a, double tolerance) {
    require(EPSCreate(PETSC_COMM_SELF, &eps_));
    require(EPSSetOperators(eps_, a.get(), nullptr));
    require(EPSSetProblemType(eps_, EPS_HEP));
    require(EPSSetType(eps_, EPSKRYLOVSCHUR));
    constexpr PetscInt most_restarts = 1000;
    require(EPSSetTolerances(eps_, tolerance, most_restarts));
    ST transform = nullptr;
    require(EPSGetST(eps_, &transform));
    require(STSetType(transform, STSINVERT));
    KSP direct = nullptr;
    require(STGetKSP(transform, &direct));
    require(KSPSetType(direct, KSPPREONLY));
    PC factor = nullptr;
    require(KSPGetPC(direct, &factor));
    require(PCSetType(factor, PCCHOLESKY));
    require(PCFactorSetMatSolverType(factor, MATSOLVERMUMPS));
  }
  ~Solver() {
    (void)EPSDestroy(&eps_);
    if (!deflated_.empty()) (void)VecDestroyVecs(static_cast<PetscInt>(deflated_.size()), &first_);
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  [[nodiscard]] EPS get() const { return eps_; }

  void deflate(const Mat& a, const Vectors& vectors) {
    if (vectors.count == 0) return;
    PetscInt rows = 0;
    require(MatGetSize(a, &rows, nullptr));
    Vec model = nullptr;
    require(MatCreateVecs(a, &model, nullptr));
    require(VecDuplicateVecs(model, vectors.count, &first_));
    require(VecDestroy(&model));
    deflated_.assign(first_, first_ + vectors.count);
    for (std::int32_t j = 0; j < vectors.count; ++j) {
      PetscScalar* entry = nullptr;
      require(VecGetArray(deflated_[j], &entry));
      std::copy_n(vectors.value + static_cast<std::ptrdiff_t>(j) * rows, rows, entry);
      require(VecRestoreArray(deflated_[j], &entry));
    }
    require(EPSSetDeflationSpace(eps_, vectors.count, deflated_.data()));
  }

  void solve(const Mat& a, TakePair take, void* context) {
    require(EPSSolve(eps_));
    PetscInt converged = 0;
    require(EPSGetConverged(eps_, &converged));
    Vec x = nullptr;
    require(MatCreateVecs(a, &x, nullptr));
    for (PetscInt i = 0; i < converged; ++i) {
      PetscScalar value = 0.0;
      require(EPSGetEigenpair(eps_, i, &value, nullptr, x, nullptr));
      const PetscScalar* entry = nullptr;
      require(VecGetArrayRead(x, &entry));
      take(context, value, entry);
      require(VecRestoreArrayRead(x, &entry));
    }
    require(VecDestroy(&x));
  }

 private:
  EPS eps_ = nullptr;
  Vec* first_ = nullptr;
  std::vector<Vec> deflated_;
};

const char* nearest(const Matrix* a, const Vectors* deflated, std::int32_t count, double target,
                    double tolerance, TakePair take, void* context) {
  return guarded([&] {
    const PetscMatrix matrix(*a);
    Solver solver(matrix, tolerance);
    // A wide space: narrow ones lose copies of repeated eigenvalues more often.
    constexpr PetscInt least_space = 60;
    const PetscInt space =
        std::min<PetscInt>(a->rows - deflated->count, std::max(least_space, 2 * count + 20));
    require(EPSSetDimensions(solver.get(), count, space, PETSC_DEFAULT));
    require(EPSSetWhichEigenpairs(solver.get(), EPS_TARGET_MAGNITUDE));
    require(EPSSetTarget(solver.get(), target));
    solver.deflate(matrix.get(), *deflated);
    solver.solve(matrix.get(), take, context);
  });
}

const char* between(const Matrix* a, double lower, double upper, double tolerance, TakePair take,
                    void* context) {
  return guarded([&] {
    const PetscMatrix matrix(*a);
    Solver solver(matrix, tolerance);
    require(EPSSetWhichEigenpairs(solver.get(), EPS_ALL));
    require(EPSSetInterval(solver.get(), lower, upper));
    solver.solve(matrix.get(), take, context);
  });
}

const char* below(const Matrix* a, double sigma, std::int64_t* count) {
  return guarded([&] {
    const PetscMatrix matrix(*a);
    Mat shifted = nullptr, factor = nullptr;
    require(MatDuplicate(matrix.get(), MAT_COPY_VALUES, &shifted));
    require(MatSetOption(shifted, MAT_SYMMETRIC, PETSC_TRUE));
    require(MatShift(shifted, -sigma));
    require(MatGetFactor(shifted, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor));
    MatFactorInfo info;
    require(MatFactorInfoInitialize(&info));
    IS row = nullptr, column = nullptr;  // MUMPS finds its own order
    require(MatGetOrdering(shifted, MATORDERINGNATURAL, &row, &column));
    require(MatCholeskyFactorSymbolic(factor, shifted, row, &info));
    require(ISDestroy(&row));
    require(ISDestroy(&column));
    require(MatCholeskyFactorNumeric(factor, shifted, &info));
    PetscInt negative = 0, zero = 0, positive = 0;
    require(MatGetInertia(factor, &negative, &zero, &positive));
    *count = negative;
    require(MatDestroy(&factor));
    require(MatDestroy(&shifted));
  });
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const perimode::slepc_module::Functions*
perimode_slepc_functions() {
  make_unmade_streams();
  static const perimode::slepc_module::Functions functions = {nearest, between, below};
  return &functions;
}
