// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "perimode/core/sink.hpp"
#include "perimode/linalg/operator.hpp"
#include "perimode/linalg/sparse.hpp"

namespace perimode {

class CholeskyFactor;

/// K x = lambda M x with symmetric K >= 0 and M = diag(mass) > 0.
/// `known` (n x r, M-orthonormal) spans a part of the null space of K that the caller has found
/// (rigid modes): it is deflated, and the solvers return only modes orthogonal to it.
/// `node_of_dof` groups dofs of one particle for the fill-reducing ordering (non-decreasing).
/// `action` is K as an operator; the engines that need no factor need nothing else, the others the matrix.
struct EigenProblem {
  const Csr* stiffness = nullptr;
  const Eigen::VectorXd* mass = nullptr;
  std::span<const Index> node_of_dof = {};
  const Eigen::MatrixXd* known = nullptr;
  /// Places of the nodes (dimension x nodes), for an order of elimination from geometry; null: METIS.
  const Eigen::MatrixXd* position = nullptr;
  const LinearOperator* action = nullptr;
  /// inverse: approximates (K + a little M)^-1 for conjugate gradients; null: none.
  const LinearOperator* preconditioner = nullptr;
  /// lanczos, arpack, lowest modes: a factor of K - negative_shift M at hand, which is then not made; the
  /// shift has to be given. `stiffness` gives the number of rows, and the matrix where inertia is asked for.
  const CholeskyFactor* factor = nullptr;
};

/// lanczos, arpack: a factor of K - sigma M. dense: LAPACK. chebyshev: block Lanczos on a Chebyshev
/// polynomial of K. inverse: block Lanczos on (K - sigma M)^-1 by conjugate gradients. The last two find
/// lowest modes only. slepc needs a library built with PERIMODE_WITH_SLEPC; else Error(environment).
/// automatic: dense for small problems, lanczos where there is a matrix, else chebyshev.
enum class EigenEngine { automatic, lanczos, arpack, dense, chebyshev, inverse, slepc };
enum class CompletenessCheck { automatic, inertia, restart, none };

struct EigenOptions {
  /// What is wanted: the `count` lowest; or, with has_range, all with lower <= lambda <= upper;
  /// or, with has_shift, the `count` nearest to `shift`. `known` vectors are never counted.
  int count = 20;
  bool has_range = false;
  double lower = 0.0, upper = 0.0;
  bool has_shift = false;
  double shift = 0.0;

  EigenEngine engine = EigenEngine::automatic;
  CompletenessCheck check = CompletenessCheck::automatic;
  /// Stop when |K x - lambda M x|_{M^-1} <= tolerance * lambda (estimated by the iteration).
  double tolerance = 1e-10;
  /// Shift of the lowest-modes search; NaN: 0 if there is no known null space and K is
  /// positive definite, else negative and chosen from `scale`.
  double negative_shift = std::numeric_limits<double>::quiet_NaN();
  /// Estimate of the first elastic eigenvalue (rad/s)^2, > 0; sets the shift of free bodies.
  double scale = 0.0;
  /// chebyshev: a guess of an eigenvalue somewhat above those wanted; it only steers. 0: none.
  double edge = 0.0;
  /// No |eigenvalue| lies above (stiffness_bound / least mass); 0: unknown. chebyshev filters by it; lanczos
  /// looks below zero down to it where K turns out indefinite.
  double top = 0.0;
  int block_size = 0;     ///< 0: 4, and 8 from 20,000 dofs on with a factor
  int dense_limit = 600;  ///< automatic: dense below this many dofs
  std::uint64_t seed = 1;
};

/// How completeness was shown and what it cost.
struct Certificate {
  bool asked = true;
  bool complete = false;
  std::string method;  ///< "inertia", "restart", "all modes", "none"
  Offset count = 0;    ///< eigenvalues (known ones included) counted at or below `at`
  double at = 0.0;     ///< eigenvalue up to which completeness is shown
  double seconds = 0.0;
  int solves = 0;
};

enum class EigenStatus { converged, not_converged, not_certified };

struct EigenResult {
  EigenStatus status = EigenStatus::not_converged;
  Eigen::VectorXd value;   ///< ascending
  Eigen::MatrixXd vector;  ///< columns, x^T M x = 1
  Certificate certificate;
  std::string engine;   ///< "lanczos", "arpack", "dense", "chebyshev", "inverse", "slepc"
  std::string message;  ///< why, when not converged or not certified
  double shift = 0.0;   ///< used
  int solves = 0;       ///< single right-hand sides
  Offset products = 0;  ///< with K, of single vectors, by the engines without a factor
  int restarts = 0;
  Offset factor_nonzeros = 0;
  double seconds_analyse = 0.0, seconds_factor = 0.0, seconds_iterate = 0.0;
};

/// Bytes that the engines chebyshev and inverse hold at their peak: the basis, what a restart keeps beside
/// it, the modes, and vectors of their own; without the operator and its preconditioner.
[[nodiscard]] double factor_free_bytes(double dofs, double modes);

/// Lowest, in-range or nearest eigenpairs of a symmetric problem with a completeness certificate.
[[nodiscard]] EigenResult solve_eigen(const EigenProblem& problem, const EigenOptions& options,
                                      const Sink& sink = {});

/// A general (unsymmetric) pencil: complex eigenvalues, right and left vectors.
struct UnsymmetricEigenResult {
  EigenStatus status = EigenStatus::not_converged;
  Eigen::VectorXcd value;  ///< ascending by real part
  Eigen::MatrixXcd right;  ///< K x = lambda M x, x^* M x = 1
  Eigen::MatrixXcd left;   ///< y^* K = lambda y^* M, y^* M x = 1
  double largest = 0.0;    ///< max |lambda| of K (all modes: exact; else an estimate)
  double imaginary = 0.0;  ///< max |Im lambda| / max |lambda| over the returned ones
  Certificate certificate;
  std::string engine, message;
  int solves = 0;
  double seconds_factor = 0.0, seconds_iterate = 0.0;
};
[[nodiscard]] UnsymmetricEigenResult solve_unsymmetric(const EigenProblem& problem,
                                                       const EigenOptions& options, const Sink& sink = {});

}  // namespace perimode
