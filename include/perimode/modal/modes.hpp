// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "perimode/assembly/body.hpp"
#include "perimode/core/sink.hpp"
#include "perimode/linalg/eigen.hpp"
#include "perimode/modal/options.hpp"
#include "perimode/modal/solver_choice.hpp"

namespace perimode {

enum class ModeKind { elastic, rigid };

/// Modes of a body, ascending by eigenvalue, rigid ones first.
struct ModalResult {
  EigenStatus status = EigenStatus::not_converged;
  std::string message;  ///< why, when not converged or not certified
  std::string solver;   ///< "lanczos", "arpack", "dense", "dense unsymmetric", "chebyshev", ...
  SolverChoice choice;  ///< and why
  Certificate certificate;

  std::vector<ModeKind> kind;
  Eigen::VectorXd eigenvalue;         ///< omega^2, (rad/s)^2; exactly 0 for rigid modes
  Eigen::VectorXd angular_frequency;  ///< rad/s
  Eigen::VectorXd frequency_hz;
  /// |K x - lambda M x| / (lambda |M x|); rigid modes |K x| / (|K| |x|) with the infinity norm of K.
  Eigen::VectorXd residual;
  Eigen::MatrixXd shape;  ///< free dofs x modes, x^T M x = 1, the largest component positive
  Eigen::MatrixXd left;   ///< unsymmetric problems: left vectors, y^T M x = 1; else empty
  /// modes x Dim, kg: (x^T M r_a)(y^T M r_a) with r_a the unit translation of all free dofs (y = x if
  /// symmetric).
  Eigen::MatrixXd effective_mass;

  int rigid_modes = 0;
  int mechanisms = 0;  ///< zero-energy modes that are not rigid motions (listed as rigid)
  /// Modes of negative eigenvalue, which bonds of negative stiffness can bring about: motions that grow as
  /// exp(sqrt(-lambda) t). Their frequency is given as 0, and a warning says so.
  int unstable = 0;
  double asymmetry = 0.0;  ///< max |K - K^T| / max |K|
  double imaginary = 0.0;  ///< max |Im lambda| / max |lambda|, unsymmetric problems
  double largest = 0.0;    ///< bound of (dense: the) largest eigenvalue, (rad/s)^2
  double shift = 0.0;
  int solves = 0;
  Offset products = 0;  ///< with K, by the engines without a factor
  Offset nonzeros = 0;  ///< of K over the free dofs, where it was assembled
  Offset factor_nonzeros = 0;
  double seconds_assemble = 0.0, seconds_analyse = 0.0, seconds_factor = 0.0, seconds_iterate = 0.0;

  [[nodiscard]] Eigen::Index count() const { return eigenvalue.size(); }
};

/// Throws invalid_input when a body of so many free dofs has nothing to solve or fewer modes than asked for.
void check_request(Index dofs, const ModalOptions& options);

/// Modes of K x = omega^2 M x over the free dofs of a body. Rigid modes are found first and deflated;
/// eigenvalues of symmetric bodies are Rayleigh quotients summed bond by bond. Unsymmetric problems (surface
/// nodes, odd and even walls in 2D and 3D) are found out and solved as such.
/// Throws invalid_input as check_request, and when K or M overflow.
template <int Dim>
[[nodiscard]] ModalResult solve_modes(const Body<Dim>& body, const ModalOptions& options,
                                      const Sink& sink = {});

/// Modal assurance criterion |x_a^T M x_b|^2 / ((x_a^T M x_a)(x_b^T M x_b)), modes of a x modes of b.
/// @pre the same free dofs and masses.
[[nodiscard]] Eigen::MatrixXd modal_assurance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                              const Eigen::VectorXd& mass);

}  // namespace perimode
