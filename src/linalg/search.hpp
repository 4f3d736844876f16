// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "block_krylov.hpp"
#include "perimode/core/sink.hpp"

namespace perimode {

/// Which eigenvalues theta of Op are wanted: the `count` largest in magnitude with the whole
/// cluster of the last one; or, with floor > 0, all with |theta| >= floor.
struct Wanted {
  Eigen::Index count = 0;
  double floor = 0.0;
};

struct SearchSettings {
  int block = 4;
  double tolerance = 1e-10;
  std::uint64_t seed = 1;
  int most_restarts = 300;
  int columns = 0;  ///< basis of block_lanczos at most; 0: as many as 20 to 60 modes need without a restart
  /// Asked with the Ritz values, largest first, whenever they are looked at: true ends block_lanczos at once.
  std::function<bool(const Eigen::VectorXd& theta)> give_up = {};
};

/// Converged eigenpairs of Op outside a deflated space, largest |theta| first.
struct EigenPairs {
  Eigen::VectorXd theta;
  Eigen::MatrixXd vector;  ///< orthonormal to the accuracy of the iteration
  double next = 0.0;       ///< no further |theta| was seen above this; 0: there is none
  Neighbourhood rest;      ///< what else the iteration holds
  bool converged = false;
  int restarts = 0;
};

/// A method that finds the wanted pairs of Op outside `deflated` (orthonormal columns), beginning
/// with `start`. It may miss copies of repeated eigenvalues; search() does not.
using Method = std::function<EigenPairs(SpectralTransform& op, const Eigen::MatrixXd& deflated,
                                        const Eigen::MatrixXd& start, const Wanted& wanted,
                                        const SearchSettings& settings)>;

[[nodiscard]] EigenPairs block_lanczos(SpectralTransform& op, const Eigen::MatrixXd& deflated,
                                       const Eigen::MatrixXd& start, const Wanted& wanted,
                                       const SearchSettings& settings);
[[nodiscard]] EigenPairs arpack(SpectralTransform& op, const Eigen::MatrixXd& deflated,
                                const Eigen::MatrixXd& start, const Wanted& wanted,
                                const SearchSettings& settings);

/// Are two distances |lambda - sigma| = 1/|theta| copies of one eigenvalue? Apart by less than 1e-6
/// of themselves (or 1e-9 of |sigma|, the round-off of a shift inside the spectrum): yes.
[[nodiscard]] bool same_cluster(const SpectralTransform& op, double theta, double other);

/// Is a Ritz pair good: |K x - lambda M x|_{M^-1} = |r| / slope (Op y = theta y + r, y purified; a shift and
/// invert has the slope theta^2) at most tolerance * lambda, or as far down as round-off lets the iteration
/// go? Where Op does not damp what is rough (op.top > 0), also |r| <= 10 tolerance lambda |theta| / top.
[[nodiscard]] bool is_converged(const SpectralTransform& op, double theta, double residual, double largest,
                                double tolerance);

/// Looks for an eigenvalue |theta| >= cut of Op outside `deflated` with a random block of at least
/// four columns. If there were one, a random block of p columns would have less than `shy`/sqrt(n) of
/// it in every column with a probability of about (0.8 shy)^p only; the iteration runs until a
/// component of that size must have shown: T_j(x)^2 >= n / shy^2 * rho / (cut - rho), T_j the Chebyshev
/// polynomial for the spectrum seen, rho its largest Ritz value [Kuczynski & Wozniakowski 1992, the
/// same argument].
///
/// The vectors W of `held` need not be looked for again, but they are not eigenvectors: a missing one
/// may lie half in W and half outside. With t = held.tail and B = Op outside W the rest of Op is
/// [[Theta, t^T v^T], [v t, B]], v = held.newest, which has nothing at or above the cut as long as
///   |B| < cut - |t (cut - |Theta|)^-1 t^T|   (the Schur complement),
/// and that is what is asked of B. Where it cannot be shown the iteration goes on from W and v
/// themselves, with random columns beside them.
struct Probe {
  bool clean = false;
  Eigen::MatrixXd found;  ///< approximate eigenvectors with |theta| >= cut
};
/// Neither clean nor anything found: undecided, and `held` is a better one to try again with.
[[nodiscard]] Probe probe(SpectralTransform& op, const Eigen::MatrixXd& deflated, Neighbourhood& held,
                          double cut, int block, std::uint64_t seed);

/// All wanted pairs: the method first, then random blocks deflated against everything found, until
/// one finds nothing at or above the cut, which lies in the gap after the last wanted cluster.
struct SearchResult {
  EigenPairs pairs;            ///< the wanted ones and the rest of the last cluster
  double cut = 0.0;            ///< |theta| above which all are found
  bool clean = false;          ///< the last random block found nothing
  double probe_seconds = 0.0;  ///< taken by that block
  Offset probe_columns = 0;    ///< that Op was applied to for it
  std::string message;
};
[[nodiscard]] SearchResult search(SpectralTransform& op, const Eigen::MatrixXd& known, const Wanted& wanted,
                                  const SearchSettings& settings, const Method& method, const Sink& sink);

/// The second half of search(): extends `result.pairs` until a random block is clean.
void complete(SpectralTransform& op, const Eigen::MatrixXd& known, const Wanted& wanted,
              const SearchSettings& settings, SearchResult& result, const Sink& sink);

/// [a b]
[[nodiscard]] Eigen::MatrixXd beside(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace perimode
