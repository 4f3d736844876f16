// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "spectral_transform.hpp"

namespace perimode {

/// Ritz vectors of Op outside a deflated space and what they are coupled to outside themselves:
/// Op vector = vector diag(theta) + newest tail. All columns are orthonormal and orthogonal to what is
/// deflated.
struct Neighbourhood {
  Eigen::MatrixXd vector;
  Eigen::VectorXd theta;
  Eigen::MatrixXd newest;  ///< no columns: an invariant space
  Eigen::MatrixXd tail;    ///< newest.cols() x vector.cols()
};

/// Orthonormal columns built block by block with Op V = V H + F E^T, everything orthogonalised
/// twice against everything and against the columns of `deflated` (orthonormal, never returned).
/// H is kept in full: with complete orthogonalisation a thick restart and random columns put in
/// for dependent ones need no special case [Baglama, Calvetti & Reichel, irbleigs 2003].
class BlockKrylov {
 public:
  /// `start` (n x s, any columns, may be empty) is filled up with random columns to `block`.
  BlockKrylov(SpectralTransform& op, const Eigen::MatrixXd& deflated, const Eigen::MatrixXd& start, int block,
              int most_columns, std::uint64_t seed);

  /// Goes on from `held` with `extra` random columns beside its newest block.
  BlockKrylov(SpectralTransform& op, const Eigen::MatrixXd& deflated, const Neighbourhood& held, int extra,
              int more_columns, std::uint64_t seed);

  /// Applies Op to the newest block and takes in what is new. False when the space is used up:
  /// then H is the whole of Op outside `deflated`.
  bool step();

  /// Ritz pairs of H, largest |theta| first.
  struct Ritz {
    Eigen::VectorXd theta;
    Eigen::MatrixXd coefficient;  ///< columns() x columns()
    Eigen::VectorXd residual;     ///< |Op y - theta y|
  };
  [[nodiscard]] Ritz ritz() const;
  /// Largest |Ritz value| of the space without its first `first` basis columns.
  [[nodiscard]] double radius_beyond(Eigen::Index first) const;

  /// Columns of the basis with H known (the newest block is not yet among them).
  [[nodiscard]] Eigen::Index columns() const { return known_; }
  [[nodiscard]] bool full() const { return known_ + 2 * block_ > most_columns_; }
  [[nodiscard]] bool used_up() const { return next_ == 0; }
  [[nodiscard]] int block() const { return block_; }

  /// Op Y / theta for the first `count` Ritz vectors, from what is stored ("purified": one more
  /// inverse iteration for the price of a product).
  [[nodiscard]] Eigen::MatrixXd purified(const Ritz& ritz, Eigen::Index count) const;
  /// Ritz vectors [first, first + count) as they stand.
  [[nodiscard]] Eigen::MatrixXd vectors(const Ritz& ritz, Eigen::Index first, Eigen::Index count) const;
  /// Ritz vectors [first, first + count) with their coupling.
  [[nodiscard]] Neighbourhood neighbourhood(const Ritz& ritz, Eigen::Index first, Eigen::Index count) const;
  /// The block that Op has not been applied to.
  [[nodiscard]] Eigen::MatrixXd newest() const { return basis_.middleCols(known_, next_); }

  /// Thick restart: keep the first `count` Ritz vectors and the newest block.
  void restart(const Ritz& ritz, Eigen::Index count);

 private:
  /// Makes `fresh` orthonormal and orthogonal to everything; returns its triangular factor.
  /// Dependent columns are replaced by random ones while there is room in the space.
  Eigen::MatrixXd take_in(const Eigen::MatrixXd& fresh, Eigen::Index used, double scale);
  void project_out(Eigen::Ref<Eigen::MatrixXd> fresh, Eigen::Index used) const;

  SpectralTransform& op_;
  const Eigen::MatrixXd& deflated_;
  int block_;
  int most_columns_;
  std::mt19937_64 random_;
  Eigen::MatrixXd basis_;  ///< n x (most_columns + block); [0, known_) with H, then the newest block
  Eigen::MatrixXd h_;      ///< known_ x known_
  Eigen::MatrixXd tail_;   ///< next_ x known_: Op V = V H + newest * tail
  Eigen::Index known_ = 0, next_ = 0;
  Eigen::Index coupled_ = 0;  ///< first column that the newest block is coupled to, tail_ being zero before
};

/// n x count standard normal numbers.
[[nodiscard]] Eigen::MatrixXd random_columns(Eigen::Index rows, Eigen::Index count, std::mt19937_64& random);

}  // namespace perimode
